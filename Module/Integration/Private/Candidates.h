// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The rungs of a planner's ladder that are tables, alone or within hybrids, and what a pixel costs.
 */

#ifndef Candidates_h
#define Candidates_h

#include "vtkType.h"

#include <functional>
#include <vector>

class vtkEnvironment;

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

/// How many lights the environment's suns and lamps are, at most PlannedLights; 0 where there is no
/// environment, or goOn said no.
int CountPlannedLights(
  vtkEnvironment* environment, double degrees, const std::function<bool()>& goOn);

/// Rows, view angles, azimuths of tables alone. lamps: whether tables beside lamps take over from
/// there.
std::vector<std::vector<int>> GetTableCandidates(bool lamps);

/// Rows, view angles, azimuths, maps of tables beside lamps.
std::vector<std::vector<int>> GetHybridCandidates();

/// Rows, view angles, azimuths, the view's azimuths of tables of anisotropic materials.
std::vector<std::vector<int>> GetAnisotropicCandidates();

/// Of a table's textures.
vtkIdType GetTableBytes(int rows, int viewAngles, int azimuths);
} // namespace measuredbrdf

#endif
