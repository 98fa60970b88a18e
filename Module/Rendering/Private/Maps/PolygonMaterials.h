// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which materials of a map meet in each polygon of a surface, and with which weights.
 */

#ifndef PolygonMaterials_h
#define PolygonMaterials_h

#include "vtkType.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkBRDF;
class vtkCellArray;
class vtkMaterialMap;
class vtkPolyData;

namespace measuredbrdf
{
/// Whether an array is among those that the map reads of a surface.
bool IsReadByMap(vtkPolyData* input, vtkMaterialMap* map, vtkAbstractArray* array);

/// The weight of a material on a scale of values: a hat that rises from the material before to 1 at
/// its own place, and falls to the next one. At the ends of the scale it stays at 1. At a place v
/// it is min(a + b v, c + d v), clamped to [0, 1], of the numbers a, b, c and d that are returned.
std::array<float, 4> MakeHat(const std::vector<double>& knots, std::size_t k);

/// The materials have numbers of their own here: 0 stands for the material of places of which the
/// map says nothing, which may be the superclass's colors.
struct PolygonMaterials
{
  using Set = std::vector<int>; // numbers of materials, sorted

  /// What a map is applied to.
  struct Surface
  {
    vtkPolyData* Input;
    vtkCellArray* Polygons;              // of the input, strips as triangles
    const std::vector<vtkIdType>& Cells; // the input's cell of each polygon
  };

  /// Fill all members. others: the material number 0, may be null. Returns why the map cannot be
  /// used, or "". warning: what is odd about the data, or "".
  std::string Find(
    const Surface& surface, vtkMaterialMap* map, vtkBRDF* others, std::string& warning);

  /// From now on each polygon is of one class, and the points are of none.
  void SetClasses(const std::vector<int>& ofPolygons);

  /// Whether points have weights (CLASSES, WEIGHTS): their sum is 1.
  bool HasPointWeights() const { return this->Columns > 0 || !this->PointClasses.empty(); }
  float GetWeight(vtkIdType point, int material) const;

  /// The materials of a polygon.
  const Set& GetSet(vtkIdType polygon) const
  {
    return this
      ->Sets[static_cast<std::size_t>(this->SetOfPolygon[static_cast<std::size_t>(polygon)])];
  }

  /// Of a set, the materials of the largest weights on all of the surface, not more than most.
  Set GetHeaviest(int set, std::size_t most) const;

  /// About the share of a polygon that is of a material.
  double GetShare(vtkIdType polygon, vtkIdType count, const vtkIdType* points, int material) const;

  /// The material of each number; null: the superclass's colors. Numbers of the same material are
  /// one, but on a scale of values and in images.
  std::vector<vtkBRDF*> BRDFs;
  std::vector<Set> Sets;
  std::vector<int> SetOfPolygon;
  std::vector<int> PointClasses;    // CLASSES of points: numbers
  std::vector<float> PointValues;   // VALUES of points: 0 at the map's first and 1 at its last
  std::vector<float> PolygonValues; // VALUES of cells: the same
  std::vector<double> Knots;        // VALUES: places of numbers 1, 2, ... on the scale, 0 to 1
  std::vector<double> ImageShares;  // TEXTURES: mean weights of numbers 0, 1, ...

private:
  int Number(vtkBRDF* brdf);
  void AddPolygon(const Set& set);
  std::string FindClasses(const Surface& surface, vtkMaterialMap* map);
  std::string FindValues(const Surface& surface, vtkMaterialMap* map);
  std::string FindWeights(const Surface& surface, vtkMaterialMap* map, std::string& warning);
  std::string FindImages(const Surface& surface, vtkMaterialMap* map, std::string& warning);

  std::map<vtkBRDF*, int> Numbers;
  std::map<Set, int> KnownSets;
  std::vector<float> PointWeights; // WEIGHTS: Columns at each point, one for each number
  std::size_t Columns = 0;
};
} // namespace measuredbrdf

#endif
