// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the processes of a parallel server know of each other, and their surfaces.
 */

#ifndef Ranks_h
#define Ranks_h

#include "vtkMultiProcessController.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace measuredmaterials
{
/// Null with one process. With more, what they draw must agree.
vtkMultiProcessController* GetController();

struct GatheredSurfaces
{
  std::vector<vtkSmartPointer<vtkPolyData>> Others;
  std::string Error; // the same on all processes; "": none
};

/// The polygons of all other processes' surfaces, without data; none, and an error, where all
/// processes together have more than so many bytes. Collective.
GatheredSurfaces GatherOthers(
  const std::vector<vtkPolyData*>& own, vtkIdType mostBytes, vtkMultiProcessController* controller);
} // namespace measuredmaterials

#endif
