// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * First-order conservative remapping between two projections of the sphere (Jones 1999, "First- and
 * Second-Order Conservative Remapping Schemes for Grids in Spherical Coordinates"): the mean of a
 * piecewise constant image over a texel of another. Private to the lighting room.
 */

#ifndef ConservativeRemap_h
#define ConservativeRemap_h

#include <glm/glm.hpp>

#include <vector>

namespace measuredbrdf
{
class ConservativeRemap
{
public:
  /// From RGB triples, row 0 at the bottom, which must outlive this. Finite values only.
  ConservativeRemap(int projection, int width, int height, const std::vector<float>& rgb);

  /// Mean over texel (x,y) of a width x height image of another projection; black where that shows
  /// no direction. Thread safe.
  glm::dvec3 GetMean(int projection, int width, int height, int x, int y) const;

private:
  // Of what has been covered so far: solid angle, and its integral of radiance.
  struct Sum
  {
    double SolidAngle = 0.0;
    glm::dvec3 Radiance = glm::dvec3(0.0);
  };
  struct Polygon;
  struct Cell;

  void AddCell(int projection, const Cell& cell, int depth, Sum& sum) const;
  bool MapOutline(int projection, const Cell& cell, Polygon& outline, bool& small) const;
  void AddPolygon(const Polygon& polygon, Sum& sum) const;
  void AddTexel(int x, int y, double solidAngle, Sum& sum) const;

  int Projection;
  int Width;
  int Height;
  const float* Pixels;
};
} // namespace measuredbrdf

#endif
