// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Double to single precision without infinity.
 */

#ifndef FiniteFloat_h
#define FiniteFloat_h

#include <algorithm>
#include <limits>

namespace measuredbrdf
{
/// The nearest float, the largest one for values beyond it.
inline float ToFloat(double value)
{
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -largest, largest));
}
} // namespace measuredbrdf

#endif
