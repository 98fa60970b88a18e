// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An environment's texels as a binary tree: a list of splits whose first N - 1 make N cells, for
 * every N. The cell of largest variance is split next, at the least sum of both parts' variances.
 */

#ifndef LightTree_h
#define LightTree_h

#include "TexelChanges.h"

#include <glm/glm.hpp>

#include <climits>
#include <cstddef>
#include <functional>
#include <memory>
#include <queue>
#include <utility>
#include <vector>

class vtkEnvironment;
class vtkLightSet;

namespace measuredbrdf
{
struct TexelDirections;

/// A rectangle of an environment's texels, for which a light can stand.
struct LightCell
{
  // Texels [X0,X1) x [Y0,Y1).
  int X0, Y0, X1, Y1;
  double Luminance = 0.0;
  glm::dvec3 Moment = glm::dvec3(0.0); // luminance-weighted sum of directions
  glm::dvec3 Irradiance = glm::dvec3(0.0);
  double SolidAngle = 0.0;

  bool IsTexel() const { return this->X1 - this->X0 == 1 && this->Y1 - this->Y0 == 1; }

  /// Adds up what its texels send, with some of them changed.
  void Gather(
    vtkEnvironment* environment, const TexelChanges& changes, const TexelDirections& directions);

  /// Its light, of a map of that size; none where it is dark.
  void AddLight(int width, int height, vtkLightSet* output) const;
};

class LightTree
{
public:
  struct Node : LightCell
  {
    int Split = INT_MAX; // the set of this many cells is the first without this one
  };

  /// Tree of an environment with some texels changed where that is not null.
  explicit LightTree(
    vtkEnvironment* environment, std::shared_ptr<const TexelChanges> changes = nullptr);

  /// Split until there are `cells` cells or no cell can be split. Returns false if progress (called
  /// with this call's share in [0,1]) returned false; the tree must then not be used any more.
  bool Grow(vtkEnvironment* environment, int cells, const std::function<bool(double)>& progress);

  int GetNumberOfCells() const { return static_cast<int>(this->Residuals.size()); }
  bool IsComplete() const { return this->Queue.empty(); }

  /// Sum of the variances of that many cells over the energy.
  double GetResidual(int cells) const
  {
    return this->Residuals[static_cast<std::size_t>(cells) - 1];
  }

  /// One light for each of that many cells, or for all where there are fewer.
  void FillLightSet(int count, vtkLightSet* output) const;

private:
  class Cutter;

  /// Whether node k is one of the set of this many cells.
  bool IsIn(std::size_t k, int cells) const
  {
    return static_cast<int>((k + 1) / 2) < cells && cells < this->Nodes[k].Split;
  }

  void Push(std::size_t node, const glm::dvec4& sum);
  void Gather(vtkEnvironment* environment, std::size_t firstNode);
  struct Candidate
  {
    double Variance;
    std::size_t Node;
    bool operator<(const Candidate& other) const
    {
      return std::make_pair(this->Variance, other.Node) <
             std::make_pair(other.Variance, this->Node);
    }
  };

  int Width;
  int Height;
  std::shared_ptr<const TexelChanges> Changes;
  double Total = 0.0;            // luminance
  std::vector<Node> Nodes;       // in the order in which they were made: 1 + 2 splits
  std::vector<double> Residuals; // by number of cells, from 1
  std::priority_queue<Candidate> Queue;
};
} // namespace measuredbrdf

#endif
