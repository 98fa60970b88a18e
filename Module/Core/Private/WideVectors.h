// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Whether the compiler has vectors of numbers of its own (__attribute__((vector_size)), target) for
 * this processor. Private to the module.
 */

#ifndef WideVectors_h
#define WideVectors_h

#if defined(__GNUC__) && defined(__x86_64__)
#define MEASUREDBRDF_HAS_VECTORS
#define MEASUREDBRDF_INLINE inline __attribute__((always_inline))
#else
#define MEASUREDBRDF_INLINE inline
#endif

#endif
