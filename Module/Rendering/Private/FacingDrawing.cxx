// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FacingDrawing.h"

#include "DrawsColor.h"
#include "HiddenSky.h"
#include "OcclusionArrays.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"

#include <cstdint>
#include <string>

namespace measuredbrdf
{
namespace
{
// Mesa's, which shade points by the processor.
bool IsSoftwareRenderer(vtkRenderWindow* window)
{
  const std::string report = window->ReportCapabilities();
  return report.find("llvmpipe") != std::string::npos ||
         report.find("softpipe") != std::string::npos;
}

glm::dmat4 GetToClip(vtkRenderer* renderer, vtkActor* actor)
{
  vtkMatrix4x4* toClip = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0);
  vtkMatrix4x4* toWorld = actor->GetMatrix();
  glm::dmat4 product(0.0);
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      for (int k = 0; k < 4; ++k)
      {
        product[column][row] += toClip->GetElement(row, k) * toWorld->GetElement(k, column);
      }
    }
  }
  return product;
}

std::vector<glm::dvec3> GetNormals(const OcclusionArrays& arrays)
{
  std::vector<glm::dvec3> normals;
  vtkFloatArray* first = arrays.Front[0];
  normals.reserve(static_cast<std::size_t>(first->GetNumberOfTuples()));
  for (vtkIdType k = 0; k < first->GetNumberOfTuples(); ++k)
  {
    const auto packed = static_cast<std::uint32_t>(first->GetTypedComponent(k, 0));
    const std::uint8_t bytes[3] = { static_cast<std::uint8_t>(packed & 255u),
      static_cast<std::uint8_t>(packed >> 8u & 255u), static_cast<std::uint8_t>(packed >> 16u) };
    normals.push_back(HiddenSky::UnpackNormal(bytes));
  }
  return normals;
}
}

bool FacingDrawing::IsWorth(vtkRenderer* renderer, vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  vtkCamera* camera = renderer->GetActiveCamera();
  if (!DrawsColor(renderer, actor) || property->GetRepresentation() != VTK_SURFACE ||
      property->GetEdgeVisibility() || property->GetFrontfaceCulling() ||
      actor->HasTranslucentPolygonalGeometry() || camera->GetUserTransform() ||
      actor->GetShaderProperty()->GetNumberOfShaderReplacements() > 0 ||
      renderer->GetRenderWindow()->GetStereoRender())
  {
    return false;
  }
  if (this->Window != renderer->GetRenderWindow())
  {
    this->Window = renderer->GetRenderWindow();
    this->IsSoftware = IsSoftwareRenderer(this->Window);
  }
  return this->IsSoftware;
}

void FacingDrawing::LeaveOut(vtkRenderer* renderer, vtkActor* actor, vtkPolyData* surface,
  const OcclusionArrays& arrays, vtkOpenGLIndexBufferObject* indices)
{
  const glm::dmat4 toClip = GetToClip(renderer, actor);
  if (!IsBeyondNearPlane(toClip, surface->GetBounds()))
  {
    this->PutBack(indices);
    return;
  }
  if (this->Arrays != &arrays)
  {
    this->PutBack(indices);
    this->Triangles = FacingTriangles(surface, GetNormals(arrays));
    this->Arrays = &arrays;
  }
  const glm::dvec4 eye = FindEye(toClip);
  if (this->Triangles.IsEmpty() || (this->IsPartial && eye == this->Eye))
  {
    return;
  }
  this->Triangles.Find(eye, this->Corners);
  indices->Upload(this->Corners, vtkOpenGLIndexBufferObject::ElementArrayBuffer);
  indices->Release();
  indices->IndexCount = this->Corners.size();
  this->Eye = eye;
  this->IsPartial = true;
}

void FacingDrawing::PutBack(vtkOpenGLIndexBufferObject* indices)
{
  if (this->IsPartial)
  {
    indices->Upload(this->Triangles.GetCorners(), vtkOpenGLIndexBufferObject::ElementArrayBuffer);
    indices->Release();
    indices->IndexCount = this->Triangles.GetCorners().size();
    this->IsPartial = false;
  }
}

void FacingDrawing::Forget()
{
  this->Triangles = FacingTriangles();
  this->Arrays = nullptr;
  this->IsPartial = false;
  this->Window = nullptr;
}
} // namespace measuredbrdf
