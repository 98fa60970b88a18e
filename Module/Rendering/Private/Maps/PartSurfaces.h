// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The surfaces of a surface's parts.
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
#include <string>
#include <vector>

class vtkBRDF;
class vtkCellArray;
class vtkPolyData;

namespace measuredbrdf
{
struct MaterialPartition;
struct PolygonMaterials;

/// Names of the point arrays of a surface's parts, and of the vertex attributes that they become.
namespace partarrays
{
/// Weights in an array: components of a vertex attribute.
constexpr int WeightsPerGroup = 4;

/// The weights of slots from WeightsPerGroup times group on.
inline std::string GetWeights(int group) { return "brdfWeights" + std::to_string(group); }

/// The place on a map's scale of values: 0 is its first, 1 its last.
constexpr const char* Value = "brdfValue";

/// Texture coordinates of weights in images.
constexpr const char* Coordinates = "brdfCoordinates";
} // namespace partarrays

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
  void CutBorders(PolygonMaterials& materials);

  /// Decompose polygons in which more than so many materials meet into triangles. Returns whether
  /// there are any: the materials of polygons are to be found anew then.
  bool SplitPolygons(const PolygonMaterials& materials, std::size_t most);

  /// The area of each material.
  std::map<vtkBRDF*, double> GetAreas(const PolygonMaterials& materials) const;

  /// The surface of each group of the partition.
  std::vector<vtkSmartPointer<vtkPolyData>> Distribute(
    const PolygonMaterials& materials, const MaterialPartition& partition);

  /// The input's vertices and lines, which no material draws; null: it has none.
  vtkSmartPointer<vtkPolyData> MakeVerticesAndLines() const;

private:
  // Number the corners as parts have them: doubled points come after the input's.
  void NumberCorners(const PolygonMaterials& materials, const MaterialPartition& partition);
  void CopyPoints();
  void AddWeights(const PolygonMaterials& materials, const MaterialPartition& partition);
  void AddValues(const PolygonMaterials& materials);

  vtkSmartPointer<vtkPolyData> Input;
  vtkNew<vtkCellArray> Polygons;
  std::vector<vtkIdType> Cells;
  std::vector<vtkIdType> Corners;   // the polygons' points, numbered as the parts have them
  std::vector<vtkIdType> Originals; // the input's point of each of the parts' points
  // Whose weights a point of the parts has: those of a group, a slot or a polygon, by its number.
  std::vector<std::size_t> Owners;
  vtkNew<vtkPolyData> Base; // the parts' points and point data
};
} // namespace measuredbrdf

#endif
