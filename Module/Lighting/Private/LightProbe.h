// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Light probes: images of all directions in the usual projections, which vtkEnvironmentReader
 * describes, and their conversion to lat-long images.
 */

#ifndef LightProbe_h
#define LightProbe_h

#include "RadianceValues.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class vtkEnvironment;

namespace measuredbrdf
{
/// vtkEnvironmentReader::ProjectionType, by the same numbers. Images have row 0 at the bottom;
/// coordinates (u,v) in [0,1]^2 go to the right and up.
enum class Projection
{
  LatLong,
  AngularMap,
  MirrorBall,
  HorizontalCross,
  VerticalCross,
  HorizontalStrip,
  VerticalStrip
};

///@{
/// A projection's name ("angular map"); the size that it needs, in words; whether a size fits.
std::string GetProjectionName(Projection projection);
std::string GetExpectedSize(Projection projection);
bool FitsProjection(Projection projection, int width, int height);
///@}

///@{
/// The map of a projection other than lat-long. The unit direction at (u,v): false, and zeros,
/// where the image shows none. (u,v) of a direction of any length but 0. The solid angle per area,
/// dOmega/(du dv): 0 beside crosses; beyond a disc's rim its formula goes on.
bool MapToDirection(Projection projection, const glm::dvec2& uv, glm::dvec3& direction);
glm::dvec2 MapToImage(Projection projection, const glm::dvec3& direction);
double GetSolidAngleDensity(Projection projection, const glm::dvec2& uv);
///@}

/// Six cube faces together have at most as many, too.
constexpr std::int64_t MaximumProbeTexels = std::int64_t(1) << 28;

/**
 * The environment of a probe, RGB triples of a size that fits its projection other than lat-long.
 * rows: those of the environment, which has twice as many columns; 0: its texels get the mean solid
 * angle of the probe's. Returns what was repaired of the texels that show a direction; nothing
 * where the probe has too many texels or is not of this size.
 *
 * A texel takes the mean of the probe's texels at 8 x 8 points (of large maps 4 x 4), weighted by
 * solid angle. Constant probes stay constant, and the light of the whole sphere is kept for each
 * channel, whether the image grows or shrinks.
 */
std::optional<BadValues> ConvertProbe(Projection projection, int width, int height,
  std::vector<float> rgb, vtkEnvironment* output, int rows = 0);

/// The same of six cube faces of size x size texels, +x -x +y -y +z -z.
std::optional<BadValues> ConvertCubeFaces(
  int size, const std::vector<std::vector<float>>& faces, vtkEnvironment* output, int rows = 0);
} // namespace measuredbrdf

#endif
