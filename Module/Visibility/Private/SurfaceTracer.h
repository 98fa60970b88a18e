// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Rays against surfaces: what hides what.
 *
 * Add surfaces, build once, then ask from any number of threads. Triangles are kept with
 * coordinates in single precision relative to the middle of the scene, in a tree of boxes with four
 * children each. Whether a ray meets a triangle is computed in double precision and is watertight:
 * no ray passes between two triangles that share an edge.
 *
 * All triangles hide from both sides. Vertices and lines hide nothing. Triangles without area and
 * those with coordinates that are not finite are left out and counted.
 */

#ifndef SurfaceTracer_h
#define SurfaceTracer_h

#include "vtkType.h" // for vtkIdType

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>

class vtkPolyData;

namespace measuredbrdf
{
class SurfaceTracer
{
public:
  /// Where a ray meets a surface.
  struct Hit
  {
    double T;               // position = origin + T * direction
    int Surface;            // as AddSurface returned
    vtkIdType Cell;         // of that surface, as vtkPolyData counts cells
    vtkIdType Points[3];    // of that surface: the triangle's corners
    double Barycentrics[3]; // their weights, which sum to 1
    double Normal[3];       // unit, of the triangle, right-handed about the corners in their order
                            // (a mirroring matrix turns it over); either side may face the ray
  };

  SurfaceTracer();
  ~SurfaceTracer();
  SurfaceTracer(const SurfaceTracer&) = delete;
  void operator=(const SurfaceTracer&) = delete;

  /**
   * Copy the polygons and strips of a surface; larger polygons are triangulated. matrix16: 4 x 4,
   * row after row, as vtkMatrix4x4's elements; null: none. It must be affine. Returns the surface's
   * number, 0, 1, 2...; -1, nothing added, where all surfaces together would have more than 2^32 -
   * 2 points or cells. Not after Build.
   */
  int AddSurface(vtkPolyData* surface, const double* matrix16 = nullptr);

  /// Once, after the last surface and before the first ray.
  void Build();

  /**
   * Whether anything is met at tMin < t < tMax of origin + t * direction (any length but 0; t
   * counts in its lengths). tMax may be infinite. A ray that is not finite meets nothing.
   * Thread-safe.
   */
  bool IsOccluded(
    const double origin[3], const double direction[3], double tMin, double tMax) const;

  /// The same for the nearest one, described in hit (unchanged where there is none). Thread-safe.
  bool Intersect(
    const double origin[3], const double direction[3], double tMin, double tMax, Hit& hit) const;

  /// Of a hit's triangle, in Hit::Points' order.
  void GetCorners(const Hit& hit, glm::dvec3 corners[3]) const;

  /**
   * Where a ray begins that leaves a point of a surface, so that it does not meet that surface
   * itself by rounding: the point moved by GetOffset along the triangle's (not the interpolated)
   * normal, to the side of the direction. Pass tMin = 0 with it.
   *
   * Rule: the offset is 2^-20 (1e-6) of the largest coordinate relative to the scene's middle, so
   * half of the longest extent, 16 units in the last place of the single precision in which the
   * triangles are kept, and 2^-48 of the largest absolute coordinate, for positions that are
   * computed in double precision. Waechter, Binder 2019, "A Fast and Robust Method for Avoiding
   * Self-Intersection", move by as many units of each coordinate; one length for the whole scene is
   * as good here and keeps the direction of the shift. Slits and steps that are less than twice as
   * wide as the offset are not seen.
   */
  void OffsetOrigin(const double point[3], const double normal[3], const double direction[3],
    double origin[3]) const;
  double GetOffset() const;

  ///@{
  /// After Build: what can hide, what was left out (no area, not finite), and memory in bytes.
  vtkIdType GetNumberOfTriangles() const;
  vtkIdType GetNumberOfSkippedTriangles() const;
  std::size_t GetBytes() const;
  ///@}

  /// After Build: xmin, xmax, ymin...; returns false where there is no triangle.
  bool GetBounds(double bounds[6]) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Data;
};
} // namespace measuredbrdf

#endif
