// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes.h"

#include "ParallelFor.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkDataArrayRange.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkFramebufferPass.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLTexture.h"
#include "vtkPBRIrradianceTexture.h"
#include "vtkPBRLUTTexture.h"
#include "vtkPBRPrefilterTexture.h"
#include "vtkPixelBufferObject.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"
#include "vtkTextureObject.h"

#include <Eigen/Core>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>

namespace tool
{
namespace
{
// The mapper puts out radiance^(1/2.2), as VTK's own physically based shading does.
constexpr double OutputGamma = 2.2;

//------------------------------------------------------------------------------
Eigen::Map<const Eigen::Array3Xd> ToArray(const std::vector<double>& rgb)
{
  return { rgb.data(), 3, static_cast<Eigen::Index>(rgb.size() / 3) };
}
}

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
void OffscreenScene::SetView(const View& view, double fill)
{
  this->Seen = view;
  this->Fill = fill;
}

//------------------------------------------------------------------------------
void OffscreenScene::SetCamera(vtkCamera* camera) { this->Camera = camera; }

//------------------------------------------------------------------------------
void OffscreenScene::PlaceCamera(int width, int height)
{
  vtkCamera* active = this->Renderer->GetActiveCamera();
  if (!this->Camera)
  {
    this->StageMapper->Update(); // a filter may make the mesh
    tool::PlaceCamera(active, this->StageMapper->GetInput(), this->Seen, this->Fill,
      static_cast<double>(width) / height);
    return;
  }
  active->DeepCopy(this->Camera);
  this->Renderer->ResetCameraClippingRange();
}

//------------------------------------------------------------------------------
void PlaceCamera(vtkCamera* camera, vtkPolyData* mesh, const View& view, double fill, double aspect)
{
  glm::dvec3 center;
  mesh->GetCenter(&center.x);
  double radius = 0.0;
  for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k)
  {
    radius = std::max(radius, vtkMath::Distance2BetweenPoints(mesh->GetPoint(k), &center.x));
  }
  radius = radius > 0.0 ? std::sqrt(radius) : 1.0;

  const double azimuth = vtkMath::RadiansFromDegrees(view.Azimuth);
  const double elevation = vtkMath::RadiansFromDegrees(view.Elevation);
  // A sphere seen under the angle a has the apparent radius tan(a) = R / sqrt(d^2 - R^2).
  const double share =
    fill * std::min(1.0, aspect) * std::tan(vtkMath::RadiansFromDegrees(0.5 * view.Angle));
  const double distance = radius * std::sqrt(1.0 + 1.0 / (share * share));
  const glm::dvec3 eye =
    center + distance * glm::dvec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                          std::cos(elevation) * std::cos(azimuth));
  camera->SetViewAngle(view.Angle);
  camera->SetFocalPoint(&center.x);
  camera->SetPosition(&eye.x);
  // Straight from above or below, up is where the azimuth looks to.
  const double sign = view.Elevation > 0.0 ? -1.0 : 1.0;
  std::abs(view.Elevation) < 89.9
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
glm::dvec3 OffscreenScene::GetRay(double x, double y, int width, int height) const
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  glm::dvec3 forward, up;
  camera->GetDirectionOfProjection(&forward.x);
  camera->GetViewUp(&up.x);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
  const double scale = std::tan(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle())) / height;
  return glm::normalize(forward + scale * (2.0 * x - width) * right +
                        scale * (2.0 * y - height) * glm::cross(right, forward));
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

namespace
{
constexpr int NumberOfAlbedos = 200; // that are tried for each channel
constexpr std::size_t HalfBytes = 2;
}

//------------------------------------------------------------------------------
StockLight::StockLight(vtkEnvironment* environment)
  : Image(vtkSmartPointer<vtkImageData>::Take(environment->NewImageData()))
{
  double total[3];
  environment->GetTotal(total);
  const double mean = vtkEnvironment::GetLuminance(total) / (4.0 * vtkMath::Pi());
  this->Unit = mean > 0.0 ? std::exp2(std::round(std::log2(mean))) : 1.0;
  auto* radiance = vtkFloatArray::SafeDownCast(this->Image->GetPointData()->GetScalars());
  for (float& value : vtk::DataArrayValueRange(radiance))
  {
    value = static_cast<float>(static_cast<double>(value) / this->Unit);
  }
}

//------------------------------------------------------------------------------
StockScene::StockScene()
  : OffscreenScene(vtkSmartPointer<vtkOpenGLPolyDataMapper>::New())
{
  this->Actor->GetProperty()->SetInterpolationToPBR();
}

//------------------------------------------------------------------------------
void StockScene::SetLight(vtkEnvironment* environment)
{
  const StockLight light(environment);
  this->Unit = light.Unit;
  vtkNew<vtkTexture> texture;
  texture->SetInputData(light.Image);
  texture->SetColorModeToDirectScalars();
  texture->MipmapOn();
  texture->InterpolateOn();
  this->Renderer->UseImageBasedLightingOn();
  this->Renderer->SetEnvironmentTexture(texture);
  double rows[9]; // of a rotation from the world: where the environment's axes point
  environment->GetWorldToEnvironment(rows);
  this->Renderer->SetEnvironmentRight(rows);
  this->Renderer->SetEnvironmentUp(rows + 3);
}

//------------------------------------------------------------------------------
void StockScene::SetMaterial(const StockMaterial& material)
{
  vtkProperty* property = this->Actor->GetProperty();
  property->SetRoughness(material.Roughness);
  property->SetMetallic(material.Metallic);
  RGB color = glm::pow(glm::make_vec3(material.Albedo.data()), RGB(1.0 / this->ColorExponent));
  property->SetColor(&color.x);
}

//------------------------------------------------------------------------------
double StockScene::FitAlbedo(StockMaterial& material, const Surface& surface, const Size& size,
  const std::vector<double>& reference)
{
  // Radiance is a quadratic function of the albedo: that of 0, 1/2 and 1 gives all others.
  Eigen::Array3Xd samples[3];
  for (int k = 0; k < 3; ++k)
  {
    material.Albedo.fill(0.5 * k);
    this->SetMaterial(material);
    samples[k] = ToArray(Pick(this->Render(size.Width, size.Height), surface));
  }
  const Eigen::Array3Xd wanted = ToArray(reference);
  Eigen::Array3d least = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  for (int k = 0; k <= NumberOfAlbedos; ++k)
  {
    const double a = static_cast<double>(k) / NumberOfAlbedos;
    const Eigen::Array3d sums =
      ((1.0 - a) * (1.0 - 2.0 * a) * samples[0] + 4.0 * a * (1.0 - a) * samples[1] +
        a * (2.0 * a - 1.0) * samples[2] - wanted)
        .abs()
        .rowwise()
        .sum();
    for (int c = 0; c < 3; ++c)
    {
      material.Albedo[c] = sums[c] < least[c] ? a : material.Albedo[c];
    }
    least = least.min(sums);
  }
  return least.sum();
}

//------------------------------------------------------------------------------
StockMaterial StockScene::Fit(
  const Surface& surface, const Size& size, const std::vector<double>& reference)
{
  // Without a metallic part radiance is linear in the albedo: half of it shows half of the light,
  // or 0.22 where this VTK takes a color as the display's.
  this->ColorExponent = 1.0;
  Eigen::Array3d sums;
  for (int k = 0; k < 3; ++k)
  {
    this->SetMaterial({ 0.5, 0.0, { 0.5 * k, 0.5 * k, 0.5 * k } });
    sums[k] = ToArray(Pick(this->Render(size.Width, size.Height), surface)).sum();
  }
  this->ColorExponent = (sums[1] - sums[0]) / (sums[2] - sums[0]) < 0.35 ? 2.2 : 1.0;

  StockMaterial best;
  double least = std::numeric_limits<double>::infinity();
  ProgressBar bar("fitting VTK's material");
  // On a grid of the whole range, then twice around the best so far.
  for (const double step : { 0.2, 0.1, 0.05 })
  {
    const bool whole = step == 0.2;
    const StockMaterial center = whole ? StockMaterial{ 0.5, 0.5, {} } : best;
    const double steps = whole ? 2.5 : 1.0;
    for (double r = -steps; r <= steps; ++r)
    {
      for (const double m : { -1.0, 0.0, 1.0 })
      {
        StockMaterial material{ center.Roughness + r * step, center.Metallic + 2.5 * m * step, {} };
        if ((!whole && r == 0.0 && m == 0.0) || std::abs(material.Roughness - 0.5) > 0.5 ||
            std::abs(material.Metallic - 0.5) > 0.5)
        {
          continue;
        }
        Interruptible::Check();
        const double error = this->FitAlbedo(material, surface, size, reference);
        if (error < least)
        {
          least = error;
          best = material;
        }
      }
    }
    bar.Update(whole ? 0.6 : 0.8);
  }
  this->SetMaterial(best);
  return best;
}

//------------------------------------------------------------------------------
std::size_t StockScene::GetTextureBytes()
{
  auto* renderer = vtkOpenGLRenderer::SafeDownCast(this->Renderer);
  if (!renderer)
  {
    return 0;
  }
  constexpr std::size_t faces = 6;
  const auto count = [](vtkOpenGLTexture* texture, std::size_t bytesPerTexel)
  {
    vtkTextureObject* object = texture ? texture->GetTextureObject() : nullptr;
    return object ? bytesPerTexel * object->GetWidth() * object->GetHeight() : 0;
  };
  const auto withLevels = [](std::size_t bytes) { return bytes * 4 / 3; };
  const std::size_t environment = withLevels(count(
    vtkOpenGLTexture::SafeDownCast(this->Renderer->GetEnvironmentTexture()), 3 * sizeof(float)));
  const std::size_t table = count(renderer->GetEnvMapLookupTable(), 2 * HalfBytes);
  const std::size_t prefiltered =
    withLevels(faces * count(renderer->GetEnvMapPrefiltered(), 3 * HalfBytes));
  const std::size_t irradiance = renderer->GetUseSphericalHarmonics()
                                   ? 0
                                   : faces * count(renderer->GetEnvMapIrradiance(), 3 * HalfBytes);
  return environment + table + prefiltered + irradiance;
}

//------------------------------------------------------------------------------
std::vector<double> Pick(const Picture& picture, const Surface& surface)
{
  std::vector<double> rgb;
  for (const int pixel : surface.Pixels)
  {
    const float* value = &picture.Pixels[4 * static_cast<std::size_t>(pixel)];
    rgb.insert(rgb.end(), value, value + 3);
  }
  return rgb;
}

//------------------------------------------------------------------------------
Scene::Scene()
  : OffscreenScene(vtkSmartPointer<vtkMeasuredBRDFMapper>::New())
  , Mapper(vtkMeasuredBRDFMapper::SafeDownCast(this->StageMapper))
{
  this->Mapper->AddObserver(vtkCommand::ProgressEvent, this, &Scene::OnProgress);
}

//------------------------------------------------------------------------------
Scene::~Scene() = default;

//------------------------------------------------------------------------------
// VTK's mappers raise it at the end of each frame, too, with 1.
void Scene::OnProgress(vtkObject*, unsigned long, void* share)
{
  const double done = share ? *static_cast<double*>(share) : 1.0;
  if (done >= 1.0)
  {
    this->Bar.reset();
    return;
  }
  if (!this->Bar)
  {
    this->Bar = std::make_unique<ProgressBar>("planning");
  }
  this->Bar->Update(done);
  if (Interruptible::IsInterrupted())
  {
    this->Mapper->SetAbortPlanning(true);
  }
}

//------------------------------------------------------------------------------
void Scene::SetLight(vtkEnvironment* environment, vtkRadianceIntegrator* integrator)
{
  this->Mapper->SetEnvironment(environment);
  this->Mapper->SetIntegrator(integrator);
}

//------------------------------------------------------------------------------
void Scene::Begin(Method& method, vtkEnvironment* environment, const PlanOptions& options)
{
  if (!method.Integrator)
  {
    this->Mapper->SetErrorTolerance(options.Tolerance);
    this->Mapper->SetMaximumCost(options.MaximumCost);
    this->Mapper->SetPlanForView(options.ForView);
  }
  this->Mapper->SetBRDF(method.BRDF);
  this->SetLight(environment, method.Integrator);
  this->TimeFrame();
  if (method.Integrator)
  {
    return;
  }
  method.Integrator = this->Mapper->GetCurrentIntegrator();
  method.Planner = this->Mapper->GetCurrentPlanner();
  if (!method.Planner)
  {
    throw Error("planning: " + TakeErrorText());
  }
}

//------------------------------------------------------------------------------
void Scene::Look(int width, int height, VisiblePairs& seen)
{
  this->Open(width, height);
  this->PlaceCamera(width, height);
  this->Mapper->GetVisiblePairs(this->Renderer, this->Actor, seen.Normals, seen.Views);
}

//------------------------------------------------------------------------------
void Scene::HoldPlan(const Method& method, vtkEnvironment* environment)
{
  if (this->Mapper->GetOcclusionMode() == vtkMeasuredBRDFMapper::OCCLUSION_AUTO &&
      this->Mapper->GetPlan().find(", modeled") != std::string::npos)
  {
    this->Mapper->SetOcclusionModeToOn(); // which a method that is not planned does not find
  }
  this->SetLight(environment, method.Integrator);
}

//------------------------------------------------------------------------------
void ComposeOver(
  Picture& picture, const OffscreenScene& scene, const Backdrop& backdrop, double exposure)
{
  measuredbrdf::ParallelFor(0, picture.Height,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int y = static_cast<int>(begin); y < end; ++y)
      {
        for (int x = 0; x < picture.Width; ++x)
        {
          glm::vec4& pixel = picture.At(x, y);
          const double alpha = std::clamp<double>(pixel.a, 0.0, 1.0);
          const RGB behind =
            alpha < 1.0
              ? backdrop.Look(scene.GetRay(x + 0.5, y + 0.5, picture.Width, picture.Height))
              : RGB(0.0);
          pixel = glm::dvec4(exposure * glm::mix(behind, RGB(pixel), alpha), 1.0);
        }
      }
    });
}
} // namespace tool
