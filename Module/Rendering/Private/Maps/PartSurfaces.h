// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The surfaces of a surface's parts. Private to the rendering room.
 *
 * All parts share one array of points: they get one vertex buffer, and where they meet their edges
 * are the same to the last bit. A point where several parts need weights of their own stands in
 * it several times.
 */

#ifndef PartSurfaces_h
#define PartSurfaces_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <map>
#include <vector>

class vtkBRDF;
class vtkCellArray;
class vtkPolyData;

namespace measuredbrdf
{
class CellMaterials;
class PartSets;

class PartSurfaces
{
public:
  explicit PartSurfaces(vtkPolyData* input);
  ~PartSurfaces();
  PartSurfaces(const PartSurfaces&) = delete;
  void operator=(const PartSurfaces&) = delete;

  ///@{
  /// The polygons, with strips as triangles; and the input's cell of each.
  vtkCellArray* GetPolygons() const { return this->Polygons; }
  const std::vector<vtkIdType>& GetCells() const { return this->Cells; }
  ///@}

  /// Cut the polygons along the borders between classes of points, so that each is of one class.
  void CutBorders(CellMaterials& cells);

  /// Decompose polygons in which more than so many materials meet into triangles. Returns whether
  /// there are any: the materials of polygons are to be found anew then.
  bool SplitPolygons(const CellMaterials& cells, std::size_t most);

  /// The area of each material.
  std::map<vtkBRDF*, double> GetAreas(const CellMaterials& cells) const;

  /// Make the surfaces.
  void Distribute(const CellMaterials& cells, const PartSets& sets);

  /// That of a set, after Distribute.
  vtkPolyData* GetSurface(std::size_t set) const { return this->Surfaces[set]; }

  /// Which of all polygons it has, after Distribute.
  const std::vector<vtkIdType>& GetPolygonsOf(std::size_t set) const
  {
    return this->PolygonsOf[set];
  }

  /// The input's vertices and lines, which no material draws; null: it has none.
  vtkPolyData* GetVerticesAndLines() const { return this->Others; }

private:
  void DecomposeStrips();
  void NumberCorners(const CellMaterials& cells, const PartSets& sets);
  void CopyPoints();
  void AddClasses(const CellMaterials& cells);
  void AddWeights(const CellMaterials& cells, const PartSets& sets);
  void AddValues(const CellMaterials& cells);
  void AddCoordinates();
  void MakeVerticesAndLines();

  vtkSmartPointer<vtkPolyData> Input;
  vtkNew<vtkCellArray> Polygons;
  std::vector<vtkIdType> Cells;
  std::vector<vtkIdType> Corners;       // the polygons' points, numbered as the parts have them
  std::vector<vtkIdType> Originals;     // the input's point of each added one
  std::vector<std::size_t> Owners;      // the set, slot or polygon that an added point belongs to
  std::vector<std::size_t> FirstOwners; // the same for the input's points
  vtkNew<vtkPolyData> Base;             // the parts' points and point data
  std::vector<vtkSmartPointer<vtkPolyData>> Surfaces;
  std::vector<std::vector<vtkIdType>> PolygonsOf;
  vtkSmartPointer<vtkPolyData> Others;
};
} // namespace measuredbrdf

#endif
