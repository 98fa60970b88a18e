// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Arguments made of two numbers: picture sizes, view angles, zones.
 */

#ifndef Sizes_h
#define Sizes_h

#include <string>

namespace tool
{
struct Size
{
  int Width;
  int Height;
};

struct View
{
  double Azimuth;      // degrees
  double Elevation;    // degrees, in [-90, 90]
  double Angle = 30.0; // vertical angle of view in degrees, in [1, 120]
};

struct Range
{
  double Begin; // degrees
  double End;
};

/// "800x600" -> size, each side in [1, largest]. Throws UsageError that names the option.
Size ParseSize(const std::string& option, const std::string& text, int largest);

/// "30,-20" or, with the angle of view, "30,-20,50" -> view. Throws UsageError.
View ParseView(const std::string& text);

/// "9,57" -> polar angles, 0 <= begin < end <= 90, at least vtkBasisBRDF::MinimumZoneWidth apart.
/// Throws UsageError.
Range ParseZone(const std::string& option, const std::string& text);
} // namespace tool

#endif
