// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Profiles over theta_o as shaders and their C++ twins read them: the nearest of many values, by
 * one fetch.
 */

#ifndef ShaderProfile_h
#define ShaderProfile_h

#include "LobePlacement.h" // for ProfileTexels

#include <array>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
struct RadianceTable;

/// Of a table: in three floats of a texel two numbers each, of 13 and 11 bits. An integral part, of
/// 0 to HighSteps, times Share is the root of the share; the fraction times Lambert that of the
/// Lambert part. So small values keep more of their digits. The fourth float is by how much the
/// sine of the axis' angle exceeds that of the view's: what mirrors has no steps.
struct ShaderProfile
{
  static constexpr std::size_t Size = ProfileTexels;
  static constexpr double HighSteps = 8191.0;
  static constexpr double LowSteps = 2048.0;

  explicit ShaderProfile(const RadianceTable& table);

  std::vector<float> Texels; // RGBA
  std::array<float, 3> Share{};
  std::array<float, 3> Lambert{};

  /// Where profiles are read for it.
  static double GetTexelPosition(std::size_t texel)
  {
    return static_cast<double>(texel) / (Size - 1.0);
  }
};
} // namespace measuredbrdf

#endif
