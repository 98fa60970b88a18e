// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VisibleSurface.h"

#include "LowDiscrepancy.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr vtkIdType MostPolygons = 4096;
constexpr int Samples = 4096;           // of which those in view count
constexpr std::size_t FewestPairs = 16; // as the planner asks for
constexpr double FacingShare = 0.05;    // of the projected area: below, the surface is a room

struct Triangle
{
  std::array<glm::dvec3, 3> Points;  // in the world
  std::array<glm::dvec3, 3> Normals; // in the world, not unit
  double Area = 0.0;                 // projected, times the polygons that it stands for
  bool Facing = true;
};

glm::dmat4 GetMatrix(vtkMatrix4x4* matrix)
{
  return glm::transpose(glm::make_mat4(matrix->GetData()));
}

/// The camera, as far as pixels need it.
class Eye
{
public:
  Eye(vtkCamera* camera, int width, int height)
    : Projection(GetMatrix(camera->GetCompositeProjectionTransformMatrix(
        static_cast<double>(width) / height, -1.0, 1.0)))
    , Position(glm::make_vec3(camera->GetPosition()))
    , Back(-glm::make_vec3(camera->GetDirectionOfProjection()))
    , Parallel(camera->GetParallelProjection() != 0)
  {
  }

  glm::dvec3 GetView(const glm::dvec3& point) const
  {
    return this->Parallel ? this->Back : glm::normalize(this->Position - point);
  }

  /// In proportion to the pixels that a unit of area there takes, seen head-on.
  double GetPixels(const glm::dvec3& point) const
  {
    const glm::dvec3 away = this->Position - point;
    return this->Parallel ? 1.0 : 1.0 / std::max(glm::dot(away, away), 1e-30);
  }

  bool Sees(const glm::dvec3& point) const
  {
    const glm::dvec4 p = this->Projection * glm::dvec4(point, 1.0);
    return p.w > 0.0 && std::abs(p.x) <= p.w && std::abs(p.y) <= p.w;
  }

private:
  glm::dmat4 Projection;
  glm::dvec3 Position;
  glm::dvec3 Back;
  bool Parallel;
};

class Meshes
{
public:
  Meshes(const std::vector<vtkPolyData*>& surfaces, const glm::dmat4& toWorld, const Eye& eye)
    : ToWorld(toWorld)
    , NormalToWorld(glm::transpose(glm::inverse(glm::dmat3(toWorld))))
    , Camera(eye)
  {
    std::vector<Cells> all;
    vtkIdType total = 0;
    for (vtkPolyData* surface : surfaces)
    {
      const vtkIdType verts = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
      for (const Cells& cells : { Cells{ surface, surface->GetPolys(), verts, false },
             Cells{ surface, surface->GetStrips(), verts + surface->GetNumberOfPolys(), true } })
      {
        total += cells.Array->GetNumberOfCells();
        all.push_back(cells);
      }
    }
    const vtkIdType stride = (total + MostPolygons - 1) / MostPolygons;
    std::size_t at = 0;
    vtkIdType before = 0; // cells before those of all[at]
    for (vtkIdType start = 0; start < total; start += stride)
    {
      // Any of the stride's: meshes alternate, too.
      const auto index = static_cast<unsigned int>(start / stride + 1);
      const vtkIdType within = std::min(stride, total - start);
      const vtkIdType k = start + static_cast<vtkIdType>(RadicalInverse(index, 2) * within);
      for (; k - before >= all[at].Array->GetNumberOfCells(); ++at)
      {
        before += all[at].Array->GetNumberOfCells();
      }
      this->AddCell(all[at], k - before, static_cast<double>(within));
    }
  }

  std::vector<Triangle> Triangles;

private:
  struct Cells
  {
    vtkPolyData* Surface;
    vtkCellArray* Array;
    vtkIdType First; // the surface's index of the array's first
    bool Strips;
  };

  void AddCell(const Cells& cells, vtkIdType k, double weight)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    cells.Array->GetCellAtId(k, size, ids);
    for (vtkIdType corner = 2; corner < size; ++corner)
    {
      const vtkIdType first = cells.Strips ? ids[corner - 2] : ids[0];
      this->AddTriangle(cells.Surface, { first, ids[corner - 1], ids[corner] }, cells.First + k,
        weight, cells.Strips && corner % 2 == 1);
    }
  }

  void AddTriangle(vtkPolyData* surface, const std::array<vtkIdType, 3>& ids, vtkIdType cell,
    double weight, bool turned)
  {
    vtkDataArray* pointNormals = surface->GetPointData()->GetNormals();
    vtkDataArray* cellNormals = surface->GetCellData()->GetNormals();
    Triangle triangle;
    for (std::size_t c = 0; c < 3; ++c)
    {
      double point[3];
      surface->GetPoint(ids[c], point);
      triangle.Points[c] = glm::dvec3(this->ToWorld * glm::dvec4(glm::make_vec3(point), 1.0));
    }
    const glm::dvec3 cross = 0.5 * glm::cross(triangle.Points[1] - triangle.Points[0],
                                     triangle.Points[2] - triangle.Points[0]);
    const double area = glm::length(cross);
    if (!(area > 0.0) || !std::isfinite(area))
    {
      return;
    }
    const glm::dvec3 middle = (triangle.Points[0] + triangle.Points[1] + triangle.Points[2]) / 3.0;
    glm::dvec3 mean(0.0);
    for (std::size_t c = 0; c < 3; ++c)
    {
      triangle.Normals[c] = turned ? -cross : cross;
      if (vtkDataArray* array = pointNormals ? pointNormals : cellNormals)
      {
        double normal[3];
        array->GetTuple(pointNormals ? ids[c] : cell, normal);
        triangle.Normals[c] = this->NormalToWorld * glm::make_vec3(normal);
      }
      mean += triangle.Normals[c];
    }
    const glm::dvec3 view = this->Camera.GetView(middle);
    triangle.Area = weight * std::abs(glm::dot(cross, view)) * this->Camera.GetPixels(middle);
    triangle.Facing = glm::dot(mean, view) > 0.0;
    if (triangle.Area > 0.0 && std::isfinite(triangle.Area))
    {
      this->Triangles.push_back(triangle);
    }
  }

  glm::dmat4 ToWorld;
  glm::dmat3 NormalToWorld;
  const Eye& Camera;
};
}

VisibleSurface::VisibleSurface(const std::vector<vtkPolyData*>& surfaces, vtkMatrix4x4* toWorld,
  vtkCamera* camera, int width, int height, const double toFrame[9])
{
  const Eye eye(camera, std::max(width, 1), std::max(height, 1));
  std::vector<Triangle> triangles = Meshes(surfaces, GetMatrix(toWorld), eye).Triangles;
  double sums[2] = { 0.0, 0.0 };
  for (const Triangle& triangle : triangles)
  {
    sums[triangle.Facing ? 1 : 0] += triangle.Area;
  }
  const bool room = sums[1] < FacingShare * (sums[0] + sums[1]);
  const double total = room ? sums[0] + sums[1] : sums[1];

  // As many samples for equal areas; those out of the picture are left out.
  const glm::dmat3 rotation = glm::transpose(glm::make_mat3(toFrame));
  double reached = 0.0;
  int next = 0;
  std::vector<glm::dvec3> normals;
  std::vector<glm::dvec3> views;
  for (const Triangle& triangle : triangles)
  {
    if (!triangle.Facing && !room)
    {
      continue;
    }
    reached += triangle.Area;
    for (; next < Samples && (next + 0.5) * total <= reached * Samples; ++next)
    {
      const auto index = static_cast<unsigned int>(next + 1);
      const double root = std::sqrt(RadicalInverse(index, 2));
      const double weights[3] = { 1.0 - root, root * (1.0 - RadicalInverse(index, 3)),
        root * RadicalInverse(index, 3) };
      glm::dvec3 point(0.0);
      glm::dvec3 normal(0.0);
      for (std::size_t c = 0; c < 3; ++c)
      {
        point += weights[c] * triangle.Points[c];
        normal += weights[c] * glm::normalize(triangle.Normals[c]);
      }
      const glm::dvec3 view = eye.GetView(point);
      if (!eye.Sees(point) || !(glm::length(normal) > 0.0) || !std::isfinite(view.x))
      {
        continue;
      }
      normal = glm::normalize(normal) * (glm::dot(normal, view) < 0.0 ? -1.0 : 1.0);
      normals.push_back(rotation * normal);
      views.push_back(rotation * view);
    }
  }
  if (normals.size() < FewestPairs)
  {
    return;
  }
  this->Normals = std::move(normals);
  this->Views = std::move(views);
}

VisibleSurface VisibleSurface::InView(
  const std::vector<vtkPolyData*>& surfaces, vtkRenderer* renderer, vtkActor* actor)
{
  double axes[9]; // rows: those of the renderer's environment
  renderer->GetEnvironmentRight(axes);
  renderer->GetEnvironmentUp(axes + 3);
  vtkMath::Cross(axes, axes + 3, axes + 6);
  const int* size = renderer->GetSize();
  return VisibleSurface(
    surfaces, actor->GetMatrix(), renderer->GetActiveCamera(), size[0], size[1], axes);
}

void VisibleSurface::CopyTo(vtkDataArray* normals, vtkDataArray* views) const
{
  const auto fill = [](vtkDataArray* array, const std::vector<glm::dvec3>& directions)
  {
    array->Initialize();
    array->SetNumberOfComponents(3);
    for (const glm::dvec3& direction : directions)
    {
      array->InsertNextTuple(&direction.x);
    }
  };
  fill(normals, this->Normals);
  fill(views, this->Views);
}
} // namespace measuredbrdf
