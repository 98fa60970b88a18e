// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Whether the compiler has vectors of numbers of its own (__attribute__((vector_size)), target) for
 * this processor, and which of them the processor has. Private to the module.
 */

#ifndef WideVectors_h
#define WideVectors_h

#if defined(__GNUC__) && defined(__x86_64__)
#define MEASUREDBRDF_HAS_VECTORS
#define MEASUREDBRDF_INLINE inline __attribute__((always_inline))
#else
#define MEASUREDBRDF_INLINE inline
#endif

namespace measuredbrdf
{
/// Several forms of one calculation; each processor has all up to one of them.
enum class VectorForm
{
  None, // one number at a time
  Narrow,
  Wide // 32 bytes, and multiplication with addition
};

inline VectorForm GetWidestForm()
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? VectorForm::Wide
                                                                         : VectorForm::Narrow;
#else
  return VectorForm::None;
#endif
}
} // namespace measuredbrdf

#endif
