// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Surface.h"

#include "Scenes.h"
#include "Tool.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"

#include <glm/glm.hpp>

#include <cmath>

namespace
{
// The cosine that the shader lifts lower views to.
constexpr double LeastViewCosine = 0.02;

//------------------------------------------------------------------------------
/// Writes the stock mapper's normal in view coordinates instead of a color.
class NormalStage : public tool::OffscreenScene
{
public:
  NormalStage()
    : OffscreenScene(vtkSmartPointer<vtkOpenGLPolyDataMapper>::New())
  {
    vtkNew<vtkLight> light; // without one VTK interpolates no normals
    light->SetLightTypeToHeadlight();
    this->Renderer->AddLight(light);
    this->Actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", false,
      "//VTK::Light::Impl\n  gl_FragData[0] = vec4(normalVCVSOutput, 1.0);\n", false);
  }

  /// World normals, alpha 0 where there is no mesh.
  tool::Picture RenderNormals(const tool::Size& size)
  {
    this->PlaceCamera(size.Width, size.Height);
    tool::Picture picture = this->Capture(size.Width, size.Height);
    vtkMatrix4x4* matrix = this->Renderer->GetActiveCamera()->GetViewTransformMatrix();
    glm::dmat3 toWorld; // columns; the transpose of the view's rotation
    for (int k = 0; k < 9; ++k)
    {
      toWorld[k / 3][k % 3] = matrix->GetElement(k / 3, k % 3);
    }
    for (int k = 0; k < size.Width * size.Height; ++k)
    {
      glm::vec4& pixel = picture.At(k % size.Width, k / size.Width);
      pixel = glm::dvec4(toWorld * glm::dvec3(pixel), pixel.a);
    }
    return picture;
  }
};

//------------------------------------------------------------------------------
// As the shader's brdfLiftView: the same azimuth, at the least cosine.
glm::dvec3 LiftView(const glm::dvec3& n, const glm::dvec3& view)
{
  const double cosine = glm::dot(n, view);
  return cosine >= LeastViewCosine
           ? view
           : LeastViewCosine * n + std::sqrt(1.0 - LeastViewCosine * LeastViewCosine) *
                                     glm::normalize(view - cosine * n);
}

//------------------------------------------------------------------------------
std::vector<int> FindCovered(const tool::Picture& picture, int stride)
{
  std::vector<int> pixels;
  for (int y = stride / 2; y < picture.Height; y += stride)
  {
    for (int x = stride / 2; x < picture.Width; x += stride)
    {
      if (picture.At(x, y)[3] > 0.0f)
      {
        pixels.push_back(y * picture.Width + x);
      }
    }
  }
  return pixels;
}

//------------------------------------------------------------------------------
tool::Surface FindSurface(NormalStage& stage, const tool::Size& size, int largest)
{
  const tool::Picture normals = stage.RenderNormals(size);
  tool::Surface surface;
  surface.Pixels = FindCovered(normals, 1);
  surface.NumberOfCovered = static_cast<int>(surface.Pixels.size());
  if (surface.Pixels.empty())
  {
    throw tool::Error("--size: not a single pixel of the mesh shows");
  }
  while (static_cast<int>(surface.Pixels.size()) > largest)
  {
    surface.Pixels = FindCovered(normals, ++surface.Stride);
  }
  for (const int pixel : surface.Pixels)
  {
    const int x = pixel % size.Width;
    const int y = pixel / size.Width;
    const glm::dvec3 n = glm::normalize(glm::dvec3(normals.At(x, y)));
    const glm::dvec3 v = LiftView(n, -stage.GetRay(x + 0.5, y + 0.5, size.Width, size.Height));
    surface.Normals.insert(surface.Normals.end(), { n.x, n.y, n.z });
    surface.Views.insert(surface.Views.end(), { v.x, v.y, v.z });
  }
  return surface;
}
}

namespace tool
{
//------------------------------------------------------------------------------
Surface FindSurface(vtkPolyData* mesh, const View& view, double fill, const Size& size, int largest)
{
  NormalStage stage;
  stage.SetMesh(mesh);
  stage.SetView(view, fill);
  return FindSurface(stage, size, largest);
}

//------------------------------------------------------------------------------
Surface FindSurface(vtkPolyData* mesh, vtkCamera* camera, const Size& size, int largest)
{
  NormalStage stage;
  stage.SetMesh(mesh);
  stage.SetCamera(camera);
  return FindSurface(stage, size, largest);
}
} // namespace tool
