// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sRGB transfer function (IEC 61966-2-1) and the luminance of its primaries.
 */

#ifndef SRGB_h
#define SRGB_h

#include <cmath>

namespace measuredbrdf
{
/// Encoded value in [0,1] to linear.
inline double DecodeSRGB(double value)
{
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Linear value in [0,1] to encoded.
inline double EncodeSRGB(double linear)
{
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// Luminance of linear sRGB (Rec. ITU-R BT.709).
template <typename Color>
double GetLuminance(const Color& rgb)
{
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}
} // namespace measuredbrdf

#endif
