// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Weights of a core's modes over theta_o as its shader reads them.
 */

#ifndef ShaderWeights_h
#define ShaderWeights_h

#include "LobePlacement.h" // for ProfileTexels

#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
struct RadianceCore;

/// Steps of RadianceCore, eight in a texel, two in each float: one is its integral part, and one
/// its fraction in units of 1 / Fractions. Both are stored MostSteps higher, so that none is
/// negative.
struct ShaderWeights
{
  static constexpr std::size_t Size = ProfileTexels;
  static constexpr int PerTexel = 8;
  static constexpr double Fractions = 4096.0;

  /// Of texels, for so many modes.
  static int CountRows(int modes) { return (3 * modes + PerTexel - 1) / PerTexel; }

  explicit ShaderWeights(const RadianceCore& core);

  /// GLSL: numbers of a row's texel at the view, in steps, as vec4 "low" and "high" with its
  /// number.
  static std::string GetUnpacking(int row);

  /// GLSL: where that puts a number, three for each mode.
  static std::string GetName(int number);

  int Rows;                  // of texels
  std::vector<float> Texels; // RGBA, Size x Rows
};
} // namespace measuredbrdf

#endif
