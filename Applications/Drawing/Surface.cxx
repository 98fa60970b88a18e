// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Surface.h"

#include "Progress.h"
#include "Scenes.h"
#include "Tool.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

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

//------------------------------------------------------------------------------
/// A square of quads that face the camera, each with one normal.
class PairStage : public tool::OffscreenScene
{
public:
  static constexpr int Side = 32;         // quads
  static constexpr int PixelsPerQuad = 2; // so that no quad's edge meets a pixel's center

  explicit PairStage(vtkMeasuredBRDFMapper* mapper)
    : OffscreenScene(mapper)
  {
    this->Renderer->GetActiveCamera()->ParallelProjectionOn();
    this->Renderer->GetActiveCamera()->SetParallelScale(1.0);
    this->Renderer->GetActiveCamera()->SetClippingRange(1.0, 3.0);
  }

  /// Radiance of normals under one unit view; at most Side^2 of them.
  std::vector<tool::RGB> Draw(const glm::dvec3& view, const std::vector<const double*>& normals)
  {
    glm::dvec3 right;
    vtkMath::Perpendiculars(&view.x, &right.x, nullptr, 0.0);
    const glm::dvec3 up = glm::cross(view, right);
    const glm::dvec3 eye = 2.0 * view;
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetPosition(&eye.x);
    camera->SetViewUp(&up.x);
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkFloatArray> vectors;
    vectors->SetNumberOfComponents(3);
    for (int k = 0; k < static_cast<int>(normals.size()); ++k)
    {
      vtkIdType corners[4];
      for (int corner = 0; corner < 4; ++corner)
      {
        const double x = 2.0 * (k % Side + (corner == 1 || corner == 2)) / Side - 1.0;
        const double y = 2.0 * (k / Side + corner / 2) / Side - 1.0;
        const glm::dvec3 point = x * right + y * up;
        corners[corner] = points->InsertNextPoint(&point.x);
        vectors->InsertNextTuple(normals[k]);
      }
      cells->InsertNextCell(4, corners);
    }
    vtkNew<vtkPolyData> quads;
    quads->SetPoints(points);
    quads->SetPolys(cells);
    quads->GetPointData()->SetNormals(vectors);
    this->SetMesh(quads);
    tool::Picture picture = this->Capture(Side * PixelsPerQuad, Side * PixelsPerQuad);
    Decode(picture);
    std::vector<tool::RGB> radiance;
    for (int k = 0; k < static_cast<int>(normals.size()); ++k)
    {
      radiance.emplace_back(picture.At(k % Side * PixelsPerQuad, k / Side * PixelsPerQuad));
    }
    return radiance;
  }
};
}

namespace tool
{
//------------------------------------------------------------------------------
Surface FindSurface(vtkPolyData* mesh, const View& view, double fill, const Size& size, int largest)
{
  NormalStage stage;
  stage.SetMesh(mesh);
  stage.SetView(view.Azimuth, view.Elevation, fill, view.Angle);
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

//------------------------------------------------------------------------------
std::vector<double> DrawPairs(vtkRadianceIntegrator* integrator, const std::vector<double>& normals,
  const std::vector<double>& views)
{
  std::map<std::array<double, 3>, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < normals.size(); k += 3)
  {
    std::array<double, 3> view = { views[k], views[k + 1], views[k + 2] };
    if (vtkMath::Dot(&normals[k], view.data()) > 0.0)
    {
      vtkMath::Normalize(view.data());
      groups[view].push_back(k);
    }
  }

  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetBRDF(integrator->GetBRDF());
  mapper->SetEnvironment(integrator->GetEnvironment());
  mapper->SetIntegrator(integrator);
  PairStage stage(mapper);
  ProgressBar bar("drawing");
  std::vector<double> radiance(normals.size(), 0.0);
  std::size_t done = 0;
  constexpr std::size_t most = PairStage::Side * PairStage::Side;
  for (const auto& [view, pairs] : groups)
  {
    for (std::size_t begin = 0; begin < pairs.size(); begin += most)
    {
      Interruptible::Check();
      std::vector<const double*> part;
      for (std::size_t k = begin; k < std::min(begin + most, pairs.size()); ++k)
      {
        part.push_back(&normals[pairs[k]]);
      }
      const std::vector<RGB> drawn = stage.Draw(glm::make_vec3(view.data()), part);
      for (std::size_t k = 0; k < drawn.size(); ++k)
      {
        std::copy_n(&drawn[k].x, 3, &radiance[pairs[begin + k]]);
      }
      done += drawn.size();
      bar.Update(3.0 * static_cast<double>(done) / static_cast<double>(normals.size()));
    }
  }
  return radiance;
}
} // namespace tool
