// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sRGB transfer function (IEC 61966-2-1).
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
} // namespace measuredbrdf

#endif
