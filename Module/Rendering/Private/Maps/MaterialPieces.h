// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A surface's polygons, each with the materials of a map that meet in it.
 *
 * Polygons are cut so that the weights of materials are linear in each piece: along the borders
 * between classes of points, and where values of points reach a material's place on the scale.
 */

#ifndef MaterialPieces_h
#define MaterialPieces_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkBRDF;
class vtkMaterialMap;
class vtkPolyData;

namespace measuredbrdf
{
/// Whether an array is among those that the map reads of a surface.
bool IsReadByMap(vtkPolyData* input, vtkMaterialMap* map, vtkAbstractArray* array);

/// The materials have numbers here: 0 stands for the material of places of which the map says
/// nothing, which may be none. Equal materials have one number, but in images, where each component
/// has its own.
class MaterialPieces
{
public:
  using Set = std::vector<int>; // numbers of materials, sorted

  struct Piece
  {
    std::size_t Begin; // of its corners
    std::size_t End;
    vtkIdType Cell; // the input's
    std::size_t Set;
  };

  /// others: the material number 0, may be null. Throws a MapProblem.
  MaterialPieces(vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others);

  std::vector<vtkBRDF*> BRDFs; // the material of each number; null: VTK's class draws
  std::vector<Set> Sets;
  std::vector<Piece> Pieces;
  std::vector<vtkIdType> Corners;
  vtkSmartPointer<vtkPolyData> Points; // no cells: the input's points and their data, then new ones
  std::vector<double> ImageShares;     // TEXTURES: mean weights of numbers 0, 1, ...
  std::string Warning;                 // what is odd about the data, or ""

  /// Whether pieces of several materials differ in weight at a point that they share.
  bool AreWeightsOfPieces() const { return !this->CellValues.empty(); }

  /// A material's weight at a corner of a piece; those of all materials sum to 1. Not in images.
  double GetWeight(const Piece& piece, vtkIdType corner, int material) const;

  /// About the share of a piece that is of a material.
  double GetShare(const Piece& piece, int material) const;

  /// Of a set, the materials of the largest weights on all of the surface.
  Set GetHeaviest(const Set& set, std::size_t most) const;

private:
  // A point of a cut: shares of two or three of the input's points, the third -1 where there are
  // two.
  struct NewPoint
  {
    std::array<vtkIdType, 3> Parents;
    std::array<double, 3> Shares;
  };

  int Number(vtkBRDF* brdf);
  void AddPiece(const std::vector<vtkIdType>& corners, vtkIdType cell, const Set& set);
  vtkIdType AddPoint(const NewPoint& point);
  vtkIdType FindPoint(vtkIdType a, vtkIdType b, vtkIdType which, double shareOfLarger);

  void FindClasses(vtkMaterialMap* map);
  void CutBorders(const std::array<vtkIdType, 3>& triangle, vtkIdType cell);
  void FindValues(vtkMaterialMap* map);
  void CutBands(const std::vector<vtkIdType>& polygon, vtkIdType cell);
  Set GetBand(std::size_t band) const;
  std::vector<vtkIdType> AddCuts(const std::vector<vtkIdType>& polygon);
  void FindWeights(vtkMaterialMap* map);
  void FindImages(vtkMaterialMap* map);
  void MakePoints();

  vtkPolyData* Input;
  std::map<vtkBRDF*, int> Numbers;
  std::map<Set, std::size_t> KnownSets;
  std::vector<NewPoint> NewPoints;
  std::map<std::array<vtkIdType, 3>, vtkIdType> PointsOfEdges; // two points, and which cut
  std::vector<int> Classes;                                    // CLASSES of points: numbers
  std::vector<double> Values;      // VALUES of points, new ones, too: the scale is from 0 to 1
  std::vector<double> CellValues;  // VALUES of cells, the same
  std::vector<double> Knots;       // VALUES: the materials' places on the scale, rising
  std::vector<int> KnotNumbers;    // of the materials there
  std::vector<float> PointWeights; // WEIGHTS: a row for each point, one for each number
};
} // namespace measuredbrdf

#endif
