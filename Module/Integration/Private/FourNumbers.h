// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Four numbers of single precision at a time. Private to the module.
 */

#ifndef FourNumbers_h
#define FourNumbers_h

#include "LaneVectors.h"

namespace measuredbrdf
{
struct Fours
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  Float4 Values; // SSE, which every x86-64 processor has
#else
  float Values[4];
#endif

  Fours() = default;
  Fours(float all)
  {
    for (int k = 0; k < 4; ++k)
    {
      this->Values[k] = all;
    }
  }
  float operator[](int k) const { return this->Values[k]; }
  void Set(int k, float value) { this->Values[k] = value; }
};

template <typename Function>
MEASUREDBRDF_INLINE Fours Combine(const Fours& a, const Fours& b, const Function& function)
{
  Fours result;
#ifdef MEASUREDBRDF_HAS_VECTORS
  result.Values = function(a.Values, b.Values);
#else
  for (int k = 0; k < 4; ++k)
  {
    result.Values[k] = function(a.Values[k], b.Values[k]);
  }
#endif
  return result;
}

inline Fours operator+(const Fours& a, const Fours& b)
{
  return Combine(a, b, [](const auto& x, const auto& y) { return x + y; });
}
inline Fours operator-(const Fours& a, const Fours& b)
{
  return Combine(a, b, [](const auto& x, const auto& y) { return x - y; });
}
inline Fours operator*(const Fours& a, const Fours& b)
{
  return Combine(a, b, [](const auto& x, const auto& y) { return x * y; });
}
inline Fours Larger(const Fours& a, const Fours& b)
{
  return Combine(a, b, [](const auto& x, const auto& y) { return x > y ? x : y; });
}
inline Fours Absolute(const Fours& a) { return Larger(a, Fours(0.0f) - a); }
/// a, but 0 where b is not positive.
inline Fours WherePositive(const Fours& a, const Fours& b)
{
  return Combine(a, b, [](const auto& x, const auto& y) { return y > 0.0f * y ? x : 0.0f * x; });
}
inline float Largest(const Fours& a)
{
  const float first = a[0] > a[1] ? a[0] : a[1];
  const float second = a[2] > a[3] ? a[2] : a[3];
  return first > second ? first : second;
}

/// Of four times four: rows become columns.
inline void Transpose(Fours rows[4])
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  _MM_TRANSPOSE4_PS(rows[0].Values, rows[1].Values, rows[2].Values, rows[3].Values);
#else
  for (int j = 0; j < 4; ++j)
  {
    for (int k = 0; k < j; ++k)
    {
      const float value = rows[j].Values[k];
      rows[j].Values[k] = rows[k].Values[j];
      rows[k].Values[j] = value;
    }
  }
#endif
}
} // namespace measuredbrdf

#endif
