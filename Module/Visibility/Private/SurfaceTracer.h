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

#include <cstdint>
#include <optional>
#include <vector>

class vtkPolyData;

namespace measuredbrdf
{
class SurfaceTracer
{
public:
  /// Where a ray meets a surface.
  struct Hit
  {
    double T;                // position = origin + T * direction
    int Surface;             // as AddSurface returned
    vtkIdType Cell;          // of that surface, as vtkPolyData counts cells
    vtkIdType Points[3];     // of that surface: the triangle's corners
    glm::dvec3 Corners[3];   // where they are
    glm::dvec3 Barycentrics; // their weights, which sum to 1
    glm::dvec3 Normal;       // unit, of the triangle, right-handed about the corners in their order
                             // (a mirroring matrix turns it over); either side may face the ray
  };

  /**
   * Copy the polygons and strips of a surface; larger polygons are triangulated. matrix16: 4 x 4,
   * row after row, as vtkMatrix4x4's elements; null: none. It must be affine. Returns the surface's
   * number, 0, 1, 2...; -1, nothing added, where all surfaces together would have more than 2^32 -
   * 2 points or cells. Not after Build.
   */
  int AddSurface(vtkPolyData* surface, const double* matrix16 = nullptr);

  /// Once, after the last surface and before the first ray.
  void Build();

  ///@{
  /**
   * Whether anything is met at 0 < t < farthest of origin + t * direction (any length but 0; t
   * counts in its lengths), and the nearest of it. farthest may be infinite. A ray that is not
   * finite meets nothing. Thread-safe.
   */
  bool IsOccluded(const glm::dvec3& origin, const glm::dvec3& direction, double farthest) const;
  std::optional<Hit> Intersect(
    const glm::dvec3& origin, const glm::dvec3& direction, double farthest) const;
  ///@}

  /**
   * How far from a point of a surface, along its triangle's (not the interpolated) normal, a ray
   * begins that leaves it, so that it does not meet that surface itself by rounding: 2^-20 (1e-6)
   * of the largest coordinate relative to the scene's middle, so half of the longest extent, 16
   * units in the last place of the single precision in which the triangles are kept, and 2^-48 of
   * the largest absolute coordinate, for positions that are computed in double precision. Waechter,
   * Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", move by as many units
   * of each coordinate; one length for the whole scene is as good here and keeps the direction of
   * the shift. Slits and steps that are less than twice as wide as the offset are not seen.
   */
  double GetOffset() const { return this->Offset; }

  ///@{
  /// After Build: what can hide, and what was left out (no area, not finite).
  vtkIdType GetNumberOfTriangles() const { return static_cast<vtkIdType>(this->Triangles.size()); }
  vtkIdType GetNumberOfSkippedTriangles() const { return this->Skipped; }
  ///@}

  /// After Build: xmin, xmax, ymin...; returns false where there is no triangle.
  bool GetBounds(double bounds[6]) const;

private:
  static constexpr std::size_t Width = 4; // children of a node of the tree

  /// Where a surface's points and cells begin in the counts over all surfaces.
  struct Start
  {
    std::uint32_t Point;
    std::uint32_t Cell;
  };

  /// 16 bytes. Corners count over all surfaces' points, cells over all surfaces' cells.
  struct Triangle
  {
    std::uint32_t Corners[3];
    std::uint32_t Cell;
  };

  /// Four boxes, each with a node below it or a run of triangles. Absent children have boxes that
  /// no ray meets.
  struct Node
  {
    float Bounds[2][3][Width]; // low and high of x, y, z
    std::uint32_t First[Width];
    std::uint32_t Count[Width]; // of triangles from First on; 0: First is a node
  };

  /// A ray in own coordinates; t is as in those of the scene.
  struct Ray
  {
    glm::dvec3 Origin;
    glm::dvec3 Direction;
    double Most;            // t, of the nearest hit so far
    glm::dvec3 Shares = {}; // of its triangle's corners
  };

  class Builder;

  glm::dvec3 GetPoint(std::uint32_t corner) const { return this->Points[corner]; }
  glm::dvec3 GetNormal(const Triangle& triangle) const; // times twice the area
  bool Meets(const Triangle& triangle, Ray& ray) const;
  const Triangle* Trace(
    const glm::dvec3& origin, const glm::dvec3& direction, bool any, Ray& ray) const;

  std::vector<Start> Starts;
  std::vector<glm::dvec3> Positions; // until Build
  std::vector<glm::vec3> Points;     // in own coordinates
  std::vector<Triangle> Triangles;
  std::vector<Node> Nodes;
  std::uint64_t Cells = 0;
  vtkIdType Skipped = 0;

  /// Own coordinates: (position - Middle) * Scale, a power of two. All lie in [-1,1], whatever the
  /// unit of length, so products of single precision numbers neither overflow nor vanish.
  glm::dvec3 Middle = glm::dvec3(0.0);
  double Scale = 1.0;
  glm::dvec3 Low = glm::dvec3(0.0); // of all triangles
  glm::dvec3 High = glm::dvec3(0.0);
  double Offset = 0.0;
};
} // namespace measuredbrdf

#endif
