// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles of several surfaces, in single precision about the middle of the scene, and the
 * test of a ray against one of them. Private to the module.
 */

#ifndef TriangleSet_h
#define TriangleSet_h

#include "vtkType.h" // for vtkIdType

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

class vtkPolyData;

namespace measuredbrdf
{
class TriangleSet
{
public:
  /// 16 bytes. Corners count over all surfaces' points, cells over all surfaces' cells.
  struct Triangle
  {
    std::uint32_t Corners[3];
    std::uint32_t Cell;
  };

  /// See SurfaceTracer::AddSurface.
  int Add(vtkPolyData* surface, const double* matrix16);

  /// After the last surface: to single precision about the middle, and without triangles of no
  /// area.
  void Finish();

  /// Where a surface's points and cells begin in the counts over all surfaces.
  struct Start
  {
    std::uint32_t Point;
    std::uint32_t Cell;
  };
  int FindSurface(std::uint32_t corner) const;
  const Start& GetStart(int surface) const
  {
    return this->Starts[static_cast<std::size_t>(surface)];
  }

  std::vector<Triangle>& GetTriangles() { return this->Triangles; }
  const std::vector<Triangle>& GetTriangles() const { return this->Triangles; }

  /// x, y, z of every point in the set's own coordinates, and a padding number at the end for
  /// Embree.
  const std::vector<float>& GetPoints() const { return this->Points; }
  glm::dvec3 GetPoint(std::uint32_t corner) const
  {
    const float* p = &this->Points[3 * static_cast<std::size_t>(corner)];
    return glm::dvec3(p[0], p[1], p[2]);
  }

  /// Own coordinates: (position - middle) * scale, a power of two. All lie in [-1,1], whatever the
  /// unit of length, so products of single precision numbers neither overflow nor vanish.
  const glm::dvec3& GetMiddle() const { return this->Middle; }
  double GetScale() const { return this->Scale; }
  const glm::dvec3& GetLow() const { return this->Low; } // of all triangles
  const glm::dvec3& GetHigh() const { return this->High; }
  double GetOffset() const { return this->Offset; }
  vtkIdType GetNumberOfSkipped() const { return this->Skipped; }
  std::size_t GetBytes() const;

  /// A ray in own coordinates; t is as in those of the scene.
  struct Ray
  {
    glm::dvec3 Origin;
    glm::dvec3 Direction;
    double Least;
    double Most; // t, of the nearest hit so far
  };

  /**
   * Whether the ray meets the triangle between Least and Most; then its t and weights of corners.
   * By edge functions (Pluecker coordinates), as Embree's robust mode: exactly opposite for the two
   * triangles at an edge, so that no ray passes between them. In double precision.
   */
  bool Meets(const Triangle& triangle, const Ray& ray, double& t, glm::dvec3& weights) const;

private:
  void AddPoints(vtkPolyData* surface, const double* matrix16);
  void AddCells(vtkPolyData* surface, const Start& start);
  void AddTriangle(const Start& start, const vtkIdType corners[3], vtkIdType cell);

  std::vector<Start> Starts;
  std::vector<double> Positions; // until Finish
  std::vector<float> Points;
  std::vector<Triangle> Triangles;
  std::uint64_t Cells = 0;
  glm::dvec3 Middle = glm::dvec3(0.0);
  double Scale = 1.0;
  glm::dvec3 Low = glm::dvec3(0.0);
  glm::dvec3 High = glm::dvec3(0.0);
  double Offset = 0.0;
  vtkIdType Skipped = 0;
};

//------------------------------------------------------------------------------
inline bool TriangleSet::Meets(
  const Triangle& triangle, const Ray& ray, double& t, glm::dvec3& weights) const
{
  const glm::dvec3 a = this->GetPoint(triangle.Corners[0]) - ray.Origin;
  const glm::dvec3 b = this->GetPoint(triangle.Corners[1]) - ray.Origin;
  const glm::dvec3 c = this->GetPoint(triangle.Corners[2]) - ray.Origin;
  const double u = glm::dot(glm::cross(c + b, c - b), ray.Direction);
  const double v = glm::dot(glm::cross(a + c, a - c), ray.Direction);
  const double w = glm::dot(glm::cross(b + a, b - a), ray.Direction);
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0))
  {
    return false;
  }
  const double sum = u + v + w;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double slope = glm::dot(normal, ray.Direction);
  t = glm::dot(normal, a) / slope;
  if (sum == 0.0 || slope == 0.0 || !(t > ray.Least && t < ray.Most))
  {
    return false;
  }
  weights = glm::dvec3(u, v, w) / sum;
  return true;
}
} // namespace measuredbrdf

#endif
