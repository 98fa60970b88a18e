// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Readings of a goniometer, listed in any order, as a material: vtkAngularTableBRDF.
 */

#ifndef GonioTable_h
#define GonioTable_h

#include "MaterialFormat.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace measuredbrdf
{
/// What was read under one light from one view. Angles are in degrees, polar ones in [0, 90].
struct GonioReading
{
  float ThetaI;
  float PhiI;
  float ThetaO;
  float PhiO;
  glm::dvec3 Color; // f, linear RGB
};

/**
 * Readings on a grid become the table's nodes, as they are. Holes in the grid are filled linearly
 * around the circle of the same polar angle, empty circles from their neighbors; what is not so
 * much as a quarter full is no grid. Then each light's views are interpolated onto even nodes,
 * 2 degrees apart, or more where there are many lights.
 *
 * Where PhiI is the same in all, the material is taken to be isotropic. One whose azimuths are all
 * in [0, 180] is mirrored. Its value for light or view along the normal is the mean over azimuths.
 * Angles less than 0.01 degrees apart are one; readings of the same directions are averaged. Beyond
 * the last polar angle the value is constant. Notes say where the readings are and what was filled.
 *
 * Throws FileError, "WHERE: what is wrong with the readings".
 */
void MakeGonioTable(
  std::vector<GonioReading> readings, const std::string& where, MaterialFile& result);
} // namespace measuredbrdf

#endif
