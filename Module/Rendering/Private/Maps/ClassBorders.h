// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Cuts a surface's polygons along the borders between classes of points.
 *
 * A place of a triangle is of the class whose corners have the largest share of it (barycentric
 * coordinates, summed for each class). So borders are straight: between two classes from one edge's
 * middle to another's, and where three meet, from the middles to the centroid. Each piece is of one
 * class, and is drawn as a class of cells is. Polygons that share an edge's points cut it at the
 * same point: no gap shows. Where points are doubled (a seam) and their classes differ, single
 * pixels of what is behind can show through.
 */

#ifndef ClassBorders_h
#define ClassBorders_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <unordered_map>
#include <vector>

class vtkCellArray;
class vtkPolyData;

namespace measuredbrdf
{
class ClassBorders
{
public:
  /// Whether new points can have what drawing reads of the surface's points, as a rasterizer would
  /// interpolate it: positions, normals, tangents and texture coordinates that are float or double.
  static bool CanInterpolate(vtkPolyData* surface);

  /// polygons: of the surface; cells: the surface's cell of each; classes: of its points. Polygons
  /// of more than three corners are cut as VTK draws them, as triangles that share the first.
  ClassBorders(vtkPolyData* surface, vtkCellArray* polygons, const std::vector<vtkIdType>& cells,
    const std::vector<int>& classes);
  ~ClassBorders();
  ClassBorders(const ClassBorders&) = delete;
  void operator=(const ClassBorders&) = delete;

  // The pieces, and polygons that no border crosses; the surface's cell and the class of each.
  vtkNew<vtkCellArray> Polygons;
  std::vector<vtkIdType> Cells;
  std::vector<int> ClassOfPolygon;

  /// The surface without its cells, with the new points after its own. Of its point data it has
  /// those that CanInterpolate names.
  vtkSmartPointer<vtkPolyData> MakeSurface(vtkPolyData* surface) const;

private:
  // A new point is the mean of two of the surface's points, or three; else the third is -1.
  using Parents = std::array<vtkIdType, 3>;

  int GetClass(vtkIdType point) const { return this->Classes[static_cast<std::size_t>(point)]; }
  vtkIdType FindMiddle(vtkIdType a, vtkIdType b);
  vtkIdType AddPoint(const Parents& parents);
  void AddPiece(vtkIdType cell, const std::vector<vtkIdType>& corners, int cls);
  void Cut(vtkIdType cell, const Parents& triangle);

  const std::vector<int>& Classes;
  vtkIdType FirstNew;
  std::vector<Parents> NewPoints;
  std::unordered_map<long long, vtkIdType> Middles;
};
} // namespace measuredbrdf

#endif
