// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Colors of other primaries and another white as linear RGB of Rec. 709.
 */

#ifndef Chromaticities_h
#define Chromaticities_h

#include <glm/mat3x3.hpp>

#include <array>

namespace measuredbrdf
{
/// CIE 1931 x and y of red, green, blue and white, in this order: as in OpenEXR's attribute and in
/// Radiance's PRIMARIES.
using Chromaticities = std::array<double, 8>;

/// Rec. ITU-R BT.709: those of all colors in this library.
constexpr Chromaticities Rec709 = { 0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290 };

/// CIE XYZ as a color space: its white is X = Y = Z.
constexpr Chromaticities CieXyz = { 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0 };

/// Whether they are Rec. 709's, but for rounding.
bool IsRec709(const Chromaticities& chromaticities);

/// Whether they span colors: finite, not on a line, and a white within them.
bool SpanColors(const Chromaticities& chromaticities);

/// From RGB of chromaticities that span colors to RGB of Rec. 709, white to white.
glm::dmat3 GetToRec709(const Chromaticities& from);
} // namespace measuredbrdf

#endif
