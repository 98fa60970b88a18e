// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Profiles over theta_o as shaders read them: the nearest of many values, by one fetch, where the
 * C++ forms interpolate between few. Private to the module.
 */

#ifndef ShaderProfile_h
#define ShaderProfile_h

#include <array>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
struct RadianceCore;
struct RadianceTable;

/// Of a table: in three floats of a texel two numbers each, of 13 and 11 bits. The integral parts,
/// of 0 to HighSteps, times Share are the share; the fractions, times Lambert, the Lambert part.
/// The fourth float is by how much the sine of the axis' angle exceeds that of the view's: what
/// mirrors has no steps.
struct ShaderProfile
{
  static constexpr std::size_t Size = 2048; // texels
  static constexpr double HighSteps = 8191.0;
  static constexpr double LowSteps = 2048.0;

  explicit ShaderProfile(const RadianceTable& table);

  std::vector<float> Texels; // RGBA
  std::array<float, 3> Share{};
  std::array<float, 3> Lambert{};

  /// Weights of a core's modes, four in a texel, so many rows of texels.
  static std::vector<float> PackWeights(const RadianceCore& core, int rows);
};
} // namespace measuredbrdf

#endif
