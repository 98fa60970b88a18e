// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The kernel f(i,o) cos(theta_i) of one view as a set of cells of the hemisphere, small where it is
 * large: sum over cells of weight x mean radiance of the cell is the outgoing radiance.
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
} // namespace measuredbrdf

#endif
