// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Readings of a goniometer, listed in any order, as a material: vtkAngularTableBRDF.
 */

#ifndef GonioTable_h
#define GonioTable_h

#include "MaterialFormat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
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

/**
 * Readings on a grid become the table's nodes, as they are. Holes in the grid are filled linearly
 * around the circle of the same polar angle, empty circles from their neighbors; what is not so
 * much as a quarter full is no grid. Then each light's views are interpolated onto even nodes,
 * about as dense as the readings.
 *
 * Where PhiI is the same in all, the material is taken to be isotropic. One whose azimuths are all
 * in [0, 180] is mirrored. Its value for light or view along the normal is the mean over azimuths.
 * Angles less than 0.01 degrees apart are one; readings of the same directions are averaged. Beyond
 * the last polar angle the value is constant. Notes are for people: angles, repairs, an albedo that
 * cannot be. Returns an empty string, or what is wrong with the readings.
 */
std::string MakeGonioTable(GonioReadings readings, MaterialFile& result);
} // namespace measuredbrdf

#endif
