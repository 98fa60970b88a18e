// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An environment's texels in cells, for each of which a light can stand; and a binary tree of them:
 * a list of splits whose first N - 1 make N cells, for every N. The cell of largest variance is
 * split next, at the least sum of both parts' variances.
 */

#ifndef LightTree_h
#define LightTree_h

#include "TexelChanges.h"
#include "TexelTree.h"

#include <glm/glm.hpp>

#include <array>
#include <climits>
#include <cstddef>
#include <functional>
#include <vector>

class vtkLightSet;

namespace measuredbrdf
{
/// A rectangle of an environment's texels, for which a light can stand.
struct LightCell
{
  // Texels [X0,X1) x [Y0,Y1).
  int X0, Y0, X1, Y1;
  glm::dvec4 Moment = glm::dvec4(0.0); // sum of luminance times direction, and that of luminance
  glm::dvec3 Irradiance = glm::dvec3(0.0);
  double SolidAngle = 0.0;

  int GetWidth() const { return this->X1 - this->X0; }
  int GetHeight() const { return this->Y1 - this->Y0; }
  bool IsTexel() const { return this->GetWidth() == 1 && this->GetHeight() == 1; }

  /// Its first `at` columns, or rows, and the others, without their light.
  std::array<LightCell, 2> Cut(bool columns, int at) const;

  /// Adds up what its texels send, with some of them changed.
  void Gather(
    vtkEnvironment* environment, const TexelChanges& changes, const TexelDirections& directions);

  /// Its light, of a map of that size; none where it is dark.
  void AddLight(int width, int height, vtkLightSet* output) const;
};

/// What the columns and the rows of a cell send. They are summed anew for each cell: a table of all
/// sums would take 32 bytes a texel.
class CellSlices
{
public:
  CellSlices(vtkEnvironment* environment, const TexelChanges& changes)
    : Directions(environment->GetWidth(), environment->GetHeight())
    , Environment(environment)
    , Changes(changes)
  {
  }

  /// None of the columns, or of the rows, where they are not wanted.
  void Sum(const LightCell& cell, bool columns, bool rows);

  TexelDirections Directions;
  std::vector<glm::dvec4> Columns; // LightCell::Moment of each
  std::vector<glm::dvec4> Rows;

private:
  vtkEnvironment* Environment;
  const TexelChanges& Changes;
};

class LightTree
{
public:
  /// Splits an environment, with some texels changed, until there are `cells` cells or no cell can
  /// be split, or goOn, which is called now and then, says false.
  LightTree(vtkEnvironment* environment, const TexelChanges& changes, int cells,
    const std::function<bool()>& goOn);

  /// goOn said false: the tree must not be used.
  bool IsStopped() const { return this->Stopped; }

  /// One light for each of that many cells, or for all where there are fewer.
  void FillLightSet(int count, vtkLightSet* output) const;

private:
  struct Node : LightCell
  {
    int Split = INT_MAX; // the set of this many cells is the first without this one
  };

  int Width;
  int Height;
  bool Stopped = false;
  std::vector<Node> Nodes; // in the order in which they were made: 1 + 2 splits
};
} // namespace measuredbrdf

#endif
