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

#include <array>
#include <vector>

namespace measuredbrdf
{
class ConservativeRemap
{
public:
  struct Image
  {
    int Projection;
    int Width;
    int Height;
  };

  /// Remaps RGB triples, row 0 at the bottom, to an image of another projection. The values must be
  /// finite and outlive this object.
  ConservativeRemap(const Image& source, const std::vector<float>& rgb, const Image& target);

  /// Mean over texel (x,y) of the target; black if the texel shows no direction. Thread safe.
  glm::dvec3 GetMean(int x, int y) const;

private:
  // The solid angle that has been covered so far, and the integral of radiance over it.
  struct Sum
  {
    double SolidAngle = 0.0;
    glm::dvec3 Radiance = glm::dvec3(0.0);
  };
  struct Polygon;
  struct Cell;
  // Cosine and sine of an angle at a lat-long texel's low and high side and its middle. They are
  // the same for a whole column or row, and computing them per texel would take most of the time.
  using Angles = std::array<glm::dvec2, 3>;

  static std::vector<Angles> Tabulate(int count, double range);
  bool GetDirection(const Cell& cell, int across, int up, glm::dvec3& direction) const;
  void AddCell(const Cell& cell, int depth, Sum& sum) const;
  bool MapOutline(const Cell& cell, Polygon& outline, bool& small) const;
  void AddPolygon(const Polygon& polygon, Sum& sum) const;
  void AddTexel(int x, int y, double solidAngle, Sum& sum) const;

  int Projection;
  int Width;
  int Height;
  Image Target;
  std::vector<Angles> Columns; // of a lat-long target: azimuths
  std::vector<Angles> Rows;    // latitudes
  const float* Pixels;
};
} // namespace measuredbrdf

#endif
