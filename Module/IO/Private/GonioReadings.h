// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Readings of a goniometer, in any order. Private to the IO room.
 */

#ifndef GonioReadings_h
#define GonioReadings_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// Directions of light and view, in degrees.
struct GonioAngles
{
  float ThetaI = 0.0f; // [0, 90]
  float PhiI = 0.0f;
  float ThetaO = 0.0f; // [0, 90]
  float PhiO = 0.0f;

  static constexpr float Same = 0.01f; // angles that differ by less are one

  bool IsLightAlongNormal() const { return this->ThetaI < Same; }
  bool IsViewAlongNormal() const { return this->ThetaO < Same; }
};

struct GonioReadings
{
  std::vector<GonioAngles> Angles;
  std::vector<float> Values; // Channels for each; NaN: not read
  std::size_t Channels = 1;
  std::vector<std::array<double, 3>> Weights; // RGB = sum of Weights[channel] * value

  /// What a reading's channels add up to; those that were not read count as 0.
  std::array<double, 3> GetColor(std::size_t reading) const
  {
    std::array<double, 3> rgb = { 0.0, 0.0, 0.0 };
    for (std::size_t channel = 0; channel < this->Channels; ++channel)
    {
      const float value = this->Values[reading * this->Channels + channel];
      for (std::size_t c = 0; c < 3 && !std::isnan(value); ++c)
      {
        rgb[c] += this->Weights[channel][c] * value;
      }
    }
    return rgb;
  }

  bool IsComplete(std::size_t reading) const
  {
    const float* first = &this->Values[reading * this->Channels];
    return std::none_of(first, first + this->Channels, [](float v) { return std::isnan(v); });
  }
};
} // namespace measuredbrdf

#endif
