// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The kernel f(i,o) cos(theta_i) of one view: as a set of cells of the hemisphere, small where it
 * is large, and in a few numbers, which come from these cells.
 */

#ifndef LobeQuadrature_h
#define LobeQuadrature_h

#include <glm/glm.hpp>

#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class LobeQuadrature
{
public:
  struct Cell
  {
    glm::dvec3 Direction; // unit, local frame
    glm::dvec3 Weight;    // integral of f cos(theta_i) over the cell, RGB
    double SolidAngle;    // sr
    double Cosine;        // integral of cos(theta_i) over the cell
  };

  /// About as many cells as asked for (at least 16), for a prepared BRDF and unit o above the
  /// horizon.
  LobeQuadrature(vtkBRDF* brdf, const glm::dvec3& o, int count);

  const std::vector<Cell>& GetCells() const { return this->Cells; }

  /// A cell's share of the albedo, all channels, less a Lambert part; never negative.
  static double GetEnergy(const Cell& cell, const glm::dvec3& floor)
  {
    const glm::dvec3 rest = glm::max(cell.Weight - floor * cell.Cosine, glm::dvec3(0.0));
    return rest.x + rest.y + rest.z;
  }

  /// Sum of the weights: the directional albedo.
  glm::dvec3 GetAlbedo() const;

  /// Least mean of f, per channel, over cells whose cosine is at least minimumCosine.
  glm::dvec3 GetFloor(double minimumCosine) const;

private:
  std::vector<Cell> Cells;
};

class LobeQuadrature;

/// Of a view o, which is (sin theta, 0, cos theta) for isotropic materials.
struct LobeMeans
{
  LobeMeans() = default;
  explicit LobeMeans(const LobeQuadrature& quadrature);

  /// For interpolation, which is a weighted sum.
  void Add(const LobeMeans& other, double weight);

  /// The Lambert part c in 1/sr: the least f up to 80 degrees.
  glm::dvec3 Floor = glm::dvec3(0.0);

  /// Directional albedo of the rest, which is 0 where it is rounding; never negative.
  glm::dvec3 Amplitude = glm::dvec3(0.0);

  ///@{
  /// The rest's mean direction, weighted by its cube so that the sharpest part of a kernel
  /// decides. Of an isotropic material it is (-sin delta, 0, cos delta); LobeViews then limits how
  /// fast its own deltas change from view to view.
  glm::dvec3 Axis = glm::dvec3(0.0);
  double Delta = 0.0;
  ///@}

  /// Directional albedo, the sum of all channels.
  double Albedo = 0.0;
};
} // namespace measuredbrdf

#endif
