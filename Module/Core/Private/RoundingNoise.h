// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Tables of quantities that cannot be negative often contain slightly negative values: rounding in
 * sums of some hundred 32-bit values leaves at most 1e-5 of the largest (published RGL files:
 * -4e-10 beside 0.5).
 */

#ifndef RoundingNoise_h
#define RoundingNoise_h

#include <algorithm>
#include <vector>

namespace measuredbrdf
{
/// Size of rounding noise, as a share of a table's largest value.
constexpr float RoundingNoise = 1e-5f;

/// The least value that counts as 0 in a table whose values cannot be negative.
inline float GetNoiseFloor(const std::vector<float>& values)
{
  const auto largest = std::max_element(values.begin(), values.end());
  return largest == values.end() ? 0.0f : -RoundingNoise * std::max(*largest, 0.0f);
}

/// Set rounding noise (and -0) to 0. Returns false and changes nothing if a value is more negative
/// than that. For finite values.
inline bool ClearNoise(std::vector<float>& values)
{
  const float floor = GetNoiseFloor(values);
  if (std::any_of(values.begin(), values.end(), [floor](float v) { return v < floor; }))
  {
    return false;
  }
  std::replace_if(
    values.begin(), values.end(), [](float v) { return v <= 0.0f; }, 0.0f);
  return true;
}
} // namespace measuredbrdf

#endif
