// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Normals of meshes that come without, or with some that are none.
 */

#ifndef MeshNormals_h
#define MeshNormals_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace tool
{
/// The mesh with smooth normals; edges sharper than the angle in degrees stay sharp. Points at one
/// place count as one, whatever their texture coordinates.
vtkSmartPointer<vtkPolyData> AddNormals(vtkPolyData* mesh, double featureAngle);

/// Gives normals that are not finite or have no length those of the polygons around. Returns the
/// number of them.
vtkIdType RepairNormals(vtkPolyData* mesh);
} // namespace tool

#endif
