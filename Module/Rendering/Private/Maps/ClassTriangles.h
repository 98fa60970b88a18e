// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles of a surface that is divided into classes, as ClassesMapper draws them. Private to
 * the rendering room.
 */

#ifndef ClassTriangles_h
#define ClassTriangles_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <functional>
#include <vector>

class vtkOpenGLIndexBufferObject;
class vtkPolyData;

namespace measuredbrdf
{
/// The cells of all parts, in their order; the points are the same.
vtkSmartPointer<vtkPolyData> JoinCells(const std::vector<vtkPolyData*>& surfaces);

/// Which polygons are to be drawn.
using PolygonChoice = std::function<bool(vtkIdType)>;

/// Their triangles only.
std::vector<unsigned int> GetTriangles(vtkPolyData* surface, const PolygonChoice& isDrawn);

/// All triangles in their places, those of the others without an area.
std::vector<unsigned int> GetNumberedTriangles(vtkPolyData* surface, const PolygonChoice& isDrawn);

/// As VTK draws them, which leaves out triangles of which two corners are in one place.
int CountTriangles(vtkPolyData* surface);

/// In the current context.
vtkSmartPointer<vtkOpenGLIndexBufferObject> MakeIndices(std::vector<unsigned int> triangles);
} // namespace measuredbrdf

#endif
