// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VisibleSurface.h"

#include "LowDiscrepancy.h"
#include "ScopedErrorCapture.h"
#include "TextureEnvironment.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkTracedScene.h"
#include "vtkTracedSurfaces.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace measuredbrdf
{
namespace
{
constexpr int Rays = 16384;
constexpr vtkIdType FewestPairs = 16; // as the planner asks for

double GetAspect(vtkRenderer* renderer)
{
  const int* size = renderer->GetSize();
  return static_cast<double>(std::max(size[0], 1)) / std::max(size[1], 1);
}

// The part of the picture, whose corners are -1 and 1, that a box may be seen in.
void FindRectangle(
  const glm::dmat4& projection, const double box[6], glm::dvec2& low, glm::dvec2& high)
{
  low = glm::dvec2(1.0);
  high = glm::dvec2(-1.0);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec4 p = projection * glm::dvec4(box[corner & 1], box[2 + ((corner >> 1) & 1)],
                                        box[4 + (corner >> 2)], 1.0);
    if (!(p.w > 0.0)) // behind the camera
    {
      low = glm::dvec2(-1.0);
      high = glm::dvec2(1.0);
      return;
    }
    low = glm::min(low, glm::dvec2(p) / p.w);
    high = glm::max(high, glm::dvec2(p) / p.w);
  }
  low = glm::clamp(low, -1.0, 1.0);
  high = glm::clamp(high, -1.0, 1.0);
}
}

VisibleSurface::VisibleSurface(
  const std::vector<vtkPolyData*>& surfaces, vtkRenderer* renderer, vtkActor* actor)
  : VisibleSurface(surfaces, actor->GetMatrix(), renderer->GetActiveCamera(), GetAspect(renderer),
      GetWorldToEnvironment(renderer, nullptr))
{
}

VisibleSurface::VisibleSurface(const std::vector<vtkPolyData*>& surfaces, vtkMatrix4x4* toWorld,
  vtkCamera* camera, double aspect, const glm::dmat3& toFrame)
{
  this->Normals->SetNumberOfComponents(3);
  this->Views->SetNumberOfComponents(3);
  vtkNew<vtkTracedScene> scene;
  const ScopedErrorCapture error(scene); // of matrices that are not finite, which show nothing
  for (vtkPolyData* surface : surfaces)
  {
    scene->AddSurface(surface, toWorld);
  }
  double box[6];
  scene->GetBounds(box);
  if (scene->GetNumberOfTriangles() == 0)
  {
    return;
  }
  const glm::dvec3 center(
    0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]), 0.5 * (box[4] + box[5]));
  const double size = glm::distance(center, glm::dvec3(box[0], box[2], box[4]));
  const glm::dmat4 projection = glm::transpose(
    glm::make_mat4(camera->GetCompositeProjectionTransformMatrix(aspect, -1.0, 1.0)->GetData()));
  const glm::dmat4 back = glm::inverse(projection);
  glm::dvec2 low, high;
  FindRectangle(projection, box, low, high);
  for (int k = 0; k < Rays; ++k)
  {
    const glm::dvec2 shares((k + 0.5) / Rays, RadicalInverse(static_cast<unsigned int>(k + 1), 2));
    const glm::dvec2 place = glm::mix(low, high, shares);
    const glm::dvec4 ends[2] = { back * glm::dvec4(place, -1.0, 1.0),
      back * glm::dvec4(place, 0.0, 1.0) };
    const glm::dvec3 from = glm::dvec3(ends[0]) / ends[0].w;
    const glm::dvec3 direction = glm::normalize(glm::dvec3(ends[1]) / ends[1].w - from);
    // What is nearer than the clipping range counts: it is set anew before the picture is drawn.
    const glm::dvec3 origin =
      camera->GetParallelProjection()
        ? from + (glm::dot(center - from, direction) - 2.0 * size) * direction
        : glm::make_vec3(camera->GetPosition());
    SurfacePoint point;
    if (scene->GetSurfaces().Cast(origin, direction, point))
    {
      const glm::dvec3 normal =
        toFrame * (glm::dot(point.Normal, direction) > 0.0 ? -point.Normal : point.Normal);
      const glm::dvec3 view = toFrame * -direction;
      this->Normals->InsertNextTuple(&normal.x);
      this->Views->InsertNextTuple(&view.x);
    }
  }
  if (this->Normals->GetNumberOfTuples() < FewestPairs)
  {
    this->Normals->Initialize();
    this->Views->Initialize();
  }
}
} // namespace measuredbrdf
