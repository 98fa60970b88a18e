// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Colors: the sRGB transfer function (IEC 61966-2-1), the luminance of its primaries (ITU-R BT.709,
 * white D65), and CIE 1931 XYZ.
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

constexpr double RGBToXYZ[3][3] = { { 0.4123907993, 0.3575843394, 0.1804807884 },
  { 0.2126390059, 0.7151686788, 0.0721923154 }, { 0.0193308187, 0.1191947798, 0.9505321522 } };
constexpr double XYZToRGB[3][3] = { { 3.2409699419, -1.5373831776, -0.4986107603 },
  { -0.9692436363, 1.8759675015, 0.0415550574 }, { 0.0556300797, -0.2039769589, 1.0569715142 } };
} // namespace measuredbrdf

#endif
