// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Readings under scattered views, interpolated onto a grid. Private to the IO room.
 */

#ifndef GonioScatter_h
#define GonioScatter_h

#include "GonioGrid.h"

#include <cmath>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// A direction's vector; degrees.
inline void PointGonio(float theta, float phi, double d[3])
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  d[0] = std::sin(theta * degree) * std::cos(phi * degree);
  d[1] = std::sin(theta * degree) * std::sin(phi * degree);
  d[2] = std::cos(theta * degree);
}

/**
 * Give the grid even views, about as dense as the readings, and values there: on the plane through
 * each light's eight nearest readings (moving least squares, Lancaster and Salkauskas 1981), within
 * the range of these. Readings that lack a channel are left out. Returns an empty string, or what
 * is wrong.
 */
std::string ScatterGonioReadings(
  GonioGrid& grid, const GonioReadings& readings, std::vector<float>& rgb);
} // namespace measuredbrdf

#endif
