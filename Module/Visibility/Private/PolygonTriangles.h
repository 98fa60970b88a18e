// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles that rays meet where a surface has larger polygons. Private to the module.
 */

#ifndef PolygonTriangles_h
#define PolygonTriangles_h

#include "vtkType.h" // for vtkIdType

#include <vector>

class vtkPolyData;

namespace measuredbrdf
{
/// Corners of a polygon's triangles, three each, as points of the surface. Quads are cut where both
/// halves face the same way; other polygons, and quads where no cut does so, as VTK triangulates
/// them.
void TriangulatePolygon(
  vtkPolyData* surface, vtkIdType count, const vtkIdType* corners, std::vector<vtkIdType>& result);
} // namespace measuredbrdf

#endif
