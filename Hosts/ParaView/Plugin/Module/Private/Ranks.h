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

#include <vector>

class vtkDataObject;

namespace measuredmaterials
{
/// Null with one process. With more, what they draw must agree.
vtkMultiProcessController* GetController();

/// The polydata of this process: the data itself, or its blocks.
std::vector<vtkPolyData*> GetSurfaces(vtkDataObject* data);

/// The polygons of all other processes' surfaces, without data. Collective.
std::vector<vtkSmartPointer<vtkPolyData>> GatherOthers(
  const std::vector<vtkPolyData*>& own, vtkMultiProcessController* controller);
} // namespace measuredmaterials

#endif
