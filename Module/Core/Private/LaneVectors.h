// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Lanes of single precision for calculations of many things at once: loops are templates over float
 * or a vector of floats. Nothing takes a vector by value: without inlining that would depend on the
 * processor. Private to the module.
 */

#ifndef LaneVectors_h
#define LaneVectors_h

#include "WideVectors.h"

#include <cmath>
#include <cstring>

#ifdef MEASUREDBRDF_HAS_VECTORS
#include <immintrin.h>
#define MEASUREDBRDF_WIDE __attribute__((target("avx2,fma")))
#endif

namespace measuredbrdf
{
#ifdef MEASUREDBRDF_HAS_VECTORS
using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Int4 = int __attribute__((vector_size(16)));
using Int8 = int __attribute__((vector_size(32)));
#endif

/// The integers that go with a vector of floats.
template <typename Vector>
struct LaneIntegers;
template <>
struct LaneIntegers<float>
{
  using Type = int;
};
#ifdef MEASUREDBRDF_HAS_VECTORS
template <>
struct LaneIntegers<Float4>
{
  using Type = Int4;
};
template <>
struct LaneIntegers<Float8>
{
  using Type = Int8;
};
#endif

template <typename Number, typename Vector>
MEASUREDBRDF_INLINE void Load(const Number* values, Vector& vector)
{
  std::memcpy(&vector, values, sizeof(Vector));
}

template <typename Number, typename Vector>
MEASUREDBRDF_INLINE void Store(const Vector& vector, Number* values)
{
  std::memcpy(values, &vector, sizeof(Vector));
}

///@{
/// Rounded towards zero, and back.
MEASUREDBRDF_INLINE void Convert(const float& from, int& to) { to = static_cast<int>(from); }
MEASUREDBRDF_INLINE void Convert(const int& from, float& to) { to = static_cast<float>(from); }
#ifdef MEASUREDBRDF_HAS_VECTORS
template <typename From, typename To>
MEASUREDBRDF_INLINE void Convert(const From& from, To& to)
{
  to = __builtin_convertvector(from, To);
}
#endif
///@}

///@{
/// Square roots of n numbers in place, n a multiple of 8.
using LaneRoots = void (*)(float* values, int n);
inline void TakeLaneRootsOneByOne(float* values, int n)
{
  for (int k = 0; k < n; ++k)
  {
    values[k] = std::sqrt(values[k]);
  }
}
#ifdef MEASUREDBRDF_HAS_VECTORS
inline void TakeLaneRootsNarrow(float* values, int n)
{
  for (int k = 0; k < n; k += 4)
  {
    _mm_storeu_ps(values + k, _mm_sqrt_ps(_mm_loadu_ps(values + k)));
  }
}
MEASUREDBRDF_WIDE inline void TakeLaneRootsWide(float* values, int n)
{
  for (int k = 0; k < n; k += 8)
  {
    _mm256_storeu_ps(values + k, _mm256_sqrt_ps(_mm256_loadu_ps(values + k)));
  }
}
#endif
///@}
} // namespace measuredbrdf

#endif
