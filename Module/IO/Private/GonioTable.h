// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Readings of a goniometer, listed in any order, as a material: vtkAngularTableBRDF. Private to the
 * IO room.
 */

#ifndef GonioTable_h
#define GonioTable_h

#include "GonioReadings.h"
#include "vtkAngularTableBRDF.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
/**
 * Readings on a grid become the table's nodes, as they are. Holes in the grid are filled linearly
 * around the circle of the same polar angle, empty circles from their neighbors; what is not so
 * much as a quarter full is no grid. Then each light's views are interpolated onto even nodes,
 * about as dense as the readings (GonioScatter.h).
 *
 * Where PhiI is the same in all, the material is taken to be isotropic. One whose azimuths are all
 * in [0, 180] is mirrored. Its value for light or view along the normal is the mean over azimuths.
 * Angles less than 0.01 degrees apart are one; readings of the same directions are averaged. Beyond
 * the last polar angle the value is constant.
 */
class GonioTable
{
public:
  /// Empty, or what is wrong with the readings. The table has at most MaximumGonioNodes.
  std::string Make(GonioReadings readings);

  vtkSmartPointer<vtkAngularTableBRDF> BRDF;
  std::vector<std::string> Notes; // for people: angles, repairs, an albedo that cannot be
};
} // namespace measuredbrdf

#endif
