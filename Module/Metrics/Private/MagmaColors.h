// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colors of error maps.
 */

#ifndef MagmaColors_h
#define MagmaColors_h

#include <array>

namespace measuredbrdf
{
/**
 * Magma (van der Walt and Smith 2015), which FLIP's error maps have: black, purple, orange, pale
 * yellow. A value in [0,1], clamped, to sRGB bytes. Linear between 18 of the 256 published colors:
 * at most 3 of 255 off.
 */
std::array<unsigned char, 3> GetMagmaColor(double value);
} // namespace measuredbrdf

#endif
