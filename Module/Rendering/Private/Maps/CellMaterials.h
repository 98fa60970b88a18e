// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which materials of a map meet in each polygon of a surface. Private to the rendering room.
 */

#ifndef CellMaterials_h
#define CellMaterials_h

#include "vtkType.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

class vtkBRDF;
class vtkCellArray;
class vtkDataArray;
class vtkMaterialMap;
class vtkPolyData;

namespace measuredbrdf
{
class CellMaterials
{
public:
  /// One of the map's materials, by a number of its own: 0 stands for the material of places that
  /// the map says nothing of.
  using Set = std::vector<int>; // sorted

  /// Returns why the map cannot be used, or "". warning: what is odd about the data. others: the
  /// material number 0, may be null. polygons: of the input, strips decomposed; cells: the input's
  /// cell of each.
  std::string Find(vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others, vtkCellArray* polygons,
    const std::vector<vtkIdType>& cells, std::string& warning);

  /// Of each number; null: the superclass's colors. Numbers of the same material are one, but on a
  /// scale of values.
  const std::vector<vtkBRDF*>& GetBRDFs() const { return this->BRDFs; }

  ///@{
  /// The sets that there are, and the one of each polygon.
  const std::vector<Set>& GetSets() const { return this->Sets; }
  const std::vector<int>& GetSetOfPolygon() const { return this->SetOfPolygon; }
  ///@}

  ///@{
  /// Weights at points (CLASSES, WEIGHTS): their sum is 1.
  bool HasPointWeights() const { return this->Columns > 0 || !this->PointClasses.empty(); }
  float GetWeight(vtkIdType point, int material) const;
  ///@}

  ///@{
  /// Classes of points, as numbers; empty: there are none. From SetClasses on each polygon is of
  /// one class, and the points are of none.
  const std::vector<int>& GetPointClasses() const { return this->PointClasses; }
  void SetClasses(const std::vector<int>& ofPolygons);
  ///@}

  ///@{
  /// Values at points, or of polygons, 0 at the map's first and 1 at its last; empty: there are
  /// none.
  const std::vector<float>& GetPointValues() const { return this->PointValues; }
  const std::vector<float>& GetPolygonValues() const { return this->PolygonValues; }
  ///@}

  /// Places on the scale of numbers 1, 2, ..., from 0 to 1 (VALUES).
  const std::vector<double>& GetKnots() const { return this->Knots; }

  /// Of a set, the materials of the largest weights on all of the surface, not more than most.
  Set GetHeaviest(int set, std::size_t most) const;

  /// The material of a set's slot, -1 beyond them: those with a BRDF in their order, then the one
  /// without.
  int GetMember(const Set& set, int slot) const;

  /// Whether the map's weights are in images.
  bool HasImages() const { return !this->ImageShares.empty(); }

  /// About the share of a polygon that is of a material.
  double GetShare(vtkIdType polygon, vtkIdType count, const vtkIdType* points, int material) const;

private:
  int Number(vtkBRDF* brdf);
  int AddSet(const Set& set);
  std::string FindClasses(vtkPolyData* input, vtkMaterialMap* map, vtkCellArray* polygons,
    const std::vector<vtkIdType>& cells);
  std::string FindValues(vtkPolyData* input, vtkMaterialMap* map, vtkCellArray* polygons,
    const std::vector<vtkIdType>& cells);
  std::string FindWeights(
    vtkPolyData* input, vtkMaterialMap* map, vtkCellArray* polygons, std::string& warning);
  std::string FindImages(
    vtkPolyData* input, vtkMaterialMap* map, vtkCellArray* polygons, std::string& warning);
  Set FindRange(vtkMaterialMap* map, double least, double largest) const;

  std::vector<vtkBRDF*> BRDFs;
  std::map<vtkBRDF*, int> Numbers;
  std::vector<Set> Sets;
  std::map<Set, int> KnownSets;
  std::vector<int> SetOfPolygon;
  std::vector<int> PointClasses;   // numbers
  std::vector<float> PointWeights; // Columns at each point, one for each number
  std::size_t Columns = 0;
  std::vector<float> PointValues;
  std::vector<float> PolygonValues;
  std::vector<int> Order;          // VALUES: the map's materials by value
  std::vector<double> Knots;       // their values, from 0 to 1
  std::vector<double> ImageShares; // mean weights of numbers 0, 1, ...
};
} // namespace measuredbrdf

#endif
