// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OffscreenScene.h"

#include "Progress.h"
#include "Tool.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkFramebufferPass.h"
#include "vtkMath.h"
#include "vtkPixelBufferObject.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace
{
// The mapper puts out radiance^(1/2.2), as VTK's own physically based shading does.
constexpr double OutputGamma = 2.2;
}

namespace tool
{
//------------------------------------------------------------------------------
OffscreenScene::OffscreenScene(vtkOpenGLPolyDataMapper* mapper)
  : StageMapper(mapper)
{
  mapper->ScalarVisibilityOff(); // the material alone, whatever else the mesh holds
  this->Actor->SetMapper(mapper);
  this->Renderer->AddActor(this->Actor);
  this->Renderer->AutomaticLightCreationOff(); // all light comes from the environment
  this->Renderer->SetBackground(0.0, 0.0, 0.0);
  this->Renderer->SetBackgroundAlpha(0.0);

  vtkNew<vtkRenderStepsPass> steps;
  this->Pass->SetDelegatePass(steps);
  this->Pass->SetColorFormat(vtkTextureObject::Float32);
  this->Pass->SetDepthFormat(vtkTextureObject::Float32);
  this->Renderer->SetPass(this->Pass);

  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->AddRenderer(this->Renderer);
}

//------------------------------------------------------------------------------
OffscreenScene::~OffscreenScene() = default;

//------------------------------------------------------------------------------
void OffscreenScene::SetMesh(vtkPolyData* mesh) { this->StageMapper->SetInputData(mesh); }

//------------------------------------------------------------------------------
void OffscreenScene::SetView(double azimuth, double elevation, double fill, double angle)
{
  this->Azimuth = azimuth;
  this->Elevation = elevation;
  this->Fill = fill;
  this->ViewAngle = angle;
}

//------------------------------------------------------------------------------
void OffscreenScene::SetCamera(vtkCamera* camera) { this->Camera = camera; }

//------------------------------------------------------------------------------
void OffscreenScene::PlaceCamera(int width, int height)
{
  if (this->Camera)
  {
    vtkCamera* active = this->Renderer->GetActiveCamera();
    active->SetPosition(this->Camera->GetPosition());
    active->SetFocalPoint(this->Camera->GetFocalPoint());
    active->SetViewUp(this->Camera->GetViewUp());
    active->SetViewAngle(this->Camera->GetViewAngle());
    this->ViewAngle = this->Camera->GetViewAngle();
    this->Renderer->ResetCameraClippingRange();
    return;
  }
  double bounds[6];
  this->StageMapper->GetBounds(bounds);
  double center[3];
  double radius = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    center[c] = 0.5 * (bounds[2 * c] + bounds[2 * c + 1]);
  }
  vtkPolyData* mesh = this->StageMapper->GetInput();
  for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k)
  {
    radius = std::max(radius, vtkMath::Distance2BetweenPoints(mesh->GetPoint(k), center));
  }
  radius = std::sqrt(radius);

  const double azimuth = vtkMath::RadiansFromDegrees(this->Azimuth);
  const double elevation = vtkMath::RadiansFromDegrees(this->Elevation);
  const double direction[3] = { std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
    std::cos(elevation) * std::cos(azimuth) };
  // A sphere seen under the angle a has the apparent radius tan(a) = R / sqrt(d^2 - R^2).
  const double share = this->Fill * std::min(1.0, static_cast<double>(width) / height) *
                       std::tan(vtkMath::RadiansFromDegrees(0.5 * this->ViewAngle));
  const double distance = radius * std::sqrt(1.0 + 1.0 / (share * share));

  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetViewAngle(this->ViewAngle);
  camera->SetFocalPoint(center);
  camera->SetPosition(center[0] + distance * direction[0], center[1] + distance * direction[1],
    center[2] + distance * direction[2]);
  // Straight from above or below, up is where the azimuth looks to.
  const double sign = this->Elevation > 0.0 ? -1.0 : 1.0;
  std::abs(this->Elevation) < 89.9
    ? camera->SetViewUp(0.0, 1.0, 0.0)
    : camera->SetViewUp(sign * std::sin(azimuth), 0.0, sign * std::cos(azimuth));
  camera->SetClippingRange(distance - 1.05 * radius, distance + 1.05 * radius);
}

//------------------------------------------------------------------------------
Picture OffscreenScene::Render(int width, int height)
{
  this->PlaceCamera(width, height);
  Picture picture = this->Capture(width, height);
  Decode(picture);
  return picture;
}

//------------------------------------------------------------------------------
Picture OffscreenScene::Capture(int width, int height)
{
  this->Window->SetSize(width, height);
  this->Window->Render();
  Interruptible::Check();
  const std::string errors = TakeErrorText();
  if (!errors.empty())
  {
    throw Error("rendering: " + errors);
  }

  vtkTextureObject* texture = this->Pass->GetColorTexture();
  if (!texture || static_cast<int>(texture->GetWidth()) != width ||
      static_cast<int>(texture->GetHeight()) != height)
  {
    throw Error("rendering: this graphics driver can't render " + std::to_string(width) + "x" +
                std::to_string(height) + " pixels");
  }
  Picture picture(width, height);
  unsigned int size[2] = { static_cast<unsigned int>(width), static_cast<unsigned int>(height) };
  vtkIdType increments[2] = { 0, 0 };
  const auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  if (!buffer || !buffer->Download2D(VTK_FLOAT, picture.Pixels.data(), size, 4, increments))
  {
    throw Error("rendering: the float picture can't be read back");
  }
  return picture;
}

//------------------------------------------------------------------------------
void OffscreenScene::Decode(Picture& picture) const
{
  const auto unit = static_cast<float>(this->Unit);
  for (std::size_t k = 0; k < picture.Pixels.size(); ++k)
  {
    if (k % 4 != 3)
    {
      picture.Pixels[k] =
        unit * std::pow(std::max(0.0f, picture.Pixels[k]), static_cast<float>(OutputGamma));
    }
  }
}

//------------------------------------------------------------------------------
double OffscreenScene::TimeFrame()
{
  const auto begin = std::chrono::steady_clock::now();
  this->Window->Render();
  this->Window->WaitForCompletion();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
    .count();
}

//------------------------------------------------------------------------------
void OffscreenScene::Open(int width, int height)
{
  this->Actor->VisibilityOff();
  this->Window->SetSize(width, height);
  this->PlaceCamera(width, height);
  this->TimeFrame();
  this->Actor->VisibilityOn();
}

//------------------------------------------------------------------------------
std::array<double, 3> OffscreenScene::GetEye() const
{
  std::array<double, 3> eye;
  this->Renderer->GetActiveCamera()->GetPosition(eye.data());
  return eye;
}

//------------------------------------------------------------------------------
std::array<double, 3> OffscreenScene::GetRay(double x, double y, int width, int height) const
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  double forward[3];
  double up[3];
  double right[3];
  camera->GetDirectionOfProjection(forward);
  camera->GetViewUp(up);
  vtkMath::Cross(forward, up, right);
  vtkMath::Normalize(right);
  vtkMath::Cross(right, forward, up);
  const double scale = std::tan(vtkMath::RadiansFromDegrees(0.5 * this->ViewAngle));
  const double a = scale * (2.0 * x - width) / height;
  const double b = scale * (2.0 * y - height) / height;
  std::array<double, 3> ray;
  for (int c = 0; c < 3; ++c)
  {
    ray[c] = forward[c] + a * right[c] + b * up[c];
  }
  vtkMath::Normalize(ray.data());
  return ray;
}

//------------------------------------------------------------------------------
std::string OffscreenScene::GetRendererName()
{
  return this->GetCapability("OpenGL renderer string");
}

//------------------------------------------------------------------------------
std::string OffscreenScene::GetCapability(const std::string& name)
{
  std::istringstream lines(this->Window->ReportCapabilities());
  const std::string key = name + ":";
  for (std::string line; std::getline(lines, line);)
  {
    if (line.compare(0, key.size(), key) == 0)
    {
      const std::size_t begin = line.find_first_not_of(' ', key.size());
      return begin == std::string::npos ? "" : line.substr(begin);
    }
  }
  return "unknown";
}
} // namespace tool
