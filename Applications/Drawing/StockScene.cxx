// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StockScene.h"

#include "Progress.h"

#include "vtkActor.h"
#include "vtkDataArrayRange.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLTexture.h"
#include "vtkPBRIrradianceTexture.h"
#include "vtkPBRLUTTexture.h"
#include "vtkPBRPrefilterTexture.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"
#include "vtkTextureObject.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace
{
// Albedos that are tried for each channel.
constexpr int NumberOfAlbedos = 200;
constexpr std::size_t HalfBytes = 2;

/// Radiance of one channel of the pixels under albedos 0, 1/2 and 1.
using Samples = std::array<std::vector<double>, 3>;

//------------------------------------------------------------------------------
// Least sum |x - r| of a channel over albedos in [0,1], and that albedo.
double FitAlbedo(
  const Samples& samples, const std::vector<double>& reference, std::size_t channel, double& best)
{
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= NumberOfAlbedos; ++k)
  {
    const double a = static_cast<double>(k) / NumberOfAlbedos;
    const double weights[3] = { (1.0 - a) * (1.0 - 2.0 * a), 4.0 * a * (1.0 - a),
      a * (2.0 * a - 1.0) };
    double sum = 0.0;
    for (std::size_t p = channel; p < reference.size(); p += 3)
    {
      sum += std::abs(weights[0] * samples[0][p] + weights[1] * samples[1][p] +
                      weights[2] * samples[2][p] - reference[p]);
    }
    if (sum < least)
    {
      least = sum;
      best = a;
    }
  }
  return least;
}
}

namespace tool
{
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
  const double power = 1.0 / this->ColorExponent;
  property->SetColor(std::pow(material.Albedo[0], power), std::pow(material.Albedo[1], power),
    std::pow(material.Albedo[2], power));
}

//------------------------------------------------------------------------------
void StockScene::FindColorExponent(const Surface& surface, const Size& size)
{
  // Without a metallic part radiance is linear in the albedo.
  this->ColorExponent = 1.0;
  double sums[3] = {};
  for (int k = 0; k < 3; ++k)
  {
    StockMaterial material;
    material.Albedo.fill(0.5 * k);
    this->SetMaterial(material);
    const std::vector<double> rgb = Pick(this->Render(size.Width, size.Height), surface);
    sums[k] = std::accumulate(rgb.begin(), rgb.end(), 0.0);
  }
  const double share = (sums[1] - sums[0]) / (sums[2] - sums[0]);
  this->ColorExponent = share < 0.35 ? 2.2 : 1.0; // 0.22 or 0.5
}

//------------------------------------------------------------------------------
StockMaterial StockScene::Fit(
  const Surface& surface, const Size& size, const std::vector<double>& reference)
{
  this->FindColorExponent(surface, size);
  StockMaterial best;
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](double roughness, double metallic)
  {
    Interruptible::Check();
    StockMaterial material{ roughness, metallic, {} };
    Samples samples;
    for (int k = 0; k < 3; ++k)
    {
      material.Albedo.fill(0.5 * k);
      this->SetMaterial(material);
      samples[k] = Pick(this->Render(size.Width, size.Height), surface);
    }
    double error = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      error += FitAlbedo(samples, reference, c, material.Albedo[c]);
    }
    if (error < least)
    {
      least = error;
      best = material;
    }
  };
  ProgressBar bar("fitting VTK's material");
  for (int k = 0; k <= 5; ++k)
  {
    for (const double metallic : { 0.0, 0.5, 1.0 })
    {
      attempt(0.2 * k, metallic);
    }
    bar.Update((k + 1) / 8.0);
  }
  for (const double step : { 0.1, 0.05 })
  {
    const StockMaterial center = best;
    for (const double r : { -step, 0.0, step })
    {
      for (const double m : { -2.5 * step, 0.0, 2.5 * step })
      {
        const double roughness = center.Roughness + r;
        const double metallic = center.Metallic + m;
        if ((r != 0.0 || m != 0.0) && roughness >= 0.0 && roughness <= 1.0 && metallic >= 0.0 &&
            metallic <= 1.0)
        {
          attempt(roughness, metallic);
        }
      }
    }
    bar.Update(step == 0.1 ? 7.0 / 8.0 : 1.0);
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
} // namespace tool
