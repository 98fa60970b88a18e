// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How shader text names the parts of a point's code (HiddenSky.h). Private to the rendering room.
 */

#ifndef SkyCodeText_h
#define SkyCodeText_h

#include "HiddenSky.h"

#include "NumberText.h"

#include <cmath>
#include <string>

namespace measuredbrdf
{
inline std::string Number(double value) { return FixedText(value, 9); }

inline std::string Along(int sector)
{
  const double azimuth = 2.0 * 3.14159265358979323846 * sector / HiddenSky::Sectors;
  return "vec2(" + Number(std::cos(azimuth)) + ", " + Number(std::sin(azimuth)) + ")";
}

// Byte k of a point's code.
inline std::string Byte(int k) { return "brdfCode" + std::to_string(k / 3) + "." + "xyz"[k % 3]; }

// A sector's bounds, the lower one first, 255 for 1. brdfSkyOpening: the sky is visible between
// them, not hidden.
inline std::string Bounds(int sector) { return "brdfSkyBounds" + std::to_string(sector); }
// Of a sector's bounds.
inline std::string Tangents(int sector) { return "brdfSkyTangents" + std::to_string(sector); }
} // namespace measuredbrdf

#endif
