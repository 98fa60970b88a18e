// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The rungs of a planner's ladder that are tables, alone or within hybrids, and what a pixel costs.
 */

#ifndef Candidates_h
#define Candidates_h

#include "EnvironmentPrecomputation.h"
#include "vtkEnvironment.h"
#include "vtkMath.h"

#include <functional>
#include <memory>
#include <vector>

namespace measuredbrdf
{
namespace PixelCosts
{
constexpr double Table = 1.0;               // with the pixel itself
constexpr double Nanosecond = 1.0 / 107.0;  // of the 107 that it takes
constexpr double Pixel = 55.0 * Nanosecond; // without a table
constexpr double Light = 20.0 * Nanosecond; // each, and likewise
constexpr double Sample = 28.0 * Nanosecond;
constexpr double Function = 12.0 * Nanosecond;
constexpr double Tiles = 0.05; // of a table: a fetch more
constexpr double Map = 7.0 * Nanosecond;
} // namespace PixelCosts

/// Largest number of lamps that become lights in a plan.
constexpr int PlannedLights = 16;

/// Lamps up to this angle in degrees are one light each, unless a finer angle is asked for.
constexpr double LampAngle = 1.2;

/// The environment's suns and lamps as lights, found once and shared. Null where there is no
/// environment, or goOn said no.
inline std::shared_ptr<const EnvironmentPrecomputation::Lamps> FindLamps(
  vtkEnvironment* environment, double degrees, int maximum, const std::function<bool()>& goOn)
{
  return environment && !environment->GetPixels().empty()
           ? environment->GetParts().GetLamps(
               environment, vtkMath::RadiansFromDegrees(degrees), maximum, goOn)
           : nullptr;
}

/// How many they are, at most PlannedLights.
inline int CountPlannedLights(
  vtkEnvironment* environment, double degrees, const std::function<bool()>& goOn)
{
  const auto lamps = FindLamps(environment, degrees, PlannedLights, goOn);
  return lamps ? static_cast<int>(lamps->Lights.size()) : 0;
}

/// A planner's sizes of tables, alone or within hybrids: rows, view angles, azimuths, and maps or,
/// of anisotropic materials, the view's azimuths. Where there are lamps, hybrids take the place of
/// the larger tables. Chosen on nine materials under four maps, and
/// reported on others (docs/methods/planner.md). None is above 12 MB. More than 113 rows have tiles
/// (RadianceTable.h).
inline std::vector<std::vector<int>> GetTableCandidates(
  bool isIsotropic, bool isHybrid, bool hasLamps)
{
  if (isIsotropic && isHybrid)
  {
    return { { 33, 12, 16, 0 }, { 65, 20, 12, 0 }, { 81, 20, 8, 0 }, { 320, 12, 8, 8 } };
  }
  std::vector<std::vector<int>> sizes =
    isIsotropic
      ? std::vector<std::vector<int>>{ { 17, 8, 8 }, { 33, 12, 16 }, { 49, 12, 16 },
          { 201, 20, 16 } }
      : std::vector<std::vector<int>>{ { 17, 8, 16, 8 }, { 25, 8, 20, 8 }, { 33, 6, 24, 8 } };
  sizes.resize(isHybrid || !hasLamps ? sizes.size() : 2);
  return sizes;
}
} // namespace measuredbrdf

#endif
