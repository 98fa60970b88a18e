// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Display.h"

#include "LocalFrame.h"
#include "Methods.h"
#include "ParallelFor.h"

#include "vtkActor.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkShaderProperty.h"
#include "vtkUniforms.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace
{
// The mapper writes radiance^(1/2.2), so a factor of radiance is a power of that factor here.
const char* const DisplayCode = R"(//VTK::Light::Impl
  gl_FragData[0].rgb *= explorerExposure;
)";

constexpr int BackdropWidth = 512;

//------------------------------------------------------------------------------
unsigned char ToByte(double value)
{
  return static_cast<unsigned char>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}
}

namespace explorer
{
//------------------------------------------------------------------------------
void SetExposure(vtkActor* actor, double factor)
{
  vtkShaderProperty* shader = actor->GetShaderProperty();
  if (shader->GetNumberOfShaderReplacements() == 0)
  {
    shader->AddFragmentShaderReplacement("//VTK::Light::Impl", false, DisplayCode, false);
  }
  shader->GetFragmentCustomUniforms()->SetUniformf(
    "explorerExposure", static_cast<float>(tool::EncodeGamma(factor)));
}

//------------------------------------------------------------------------------
double FindExposure(vtkEnvironment* environment, double stops)
{
  return (environment ? 1.0 : 0.7 * vtkMath::Pi()) * std::exp2(stops);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeImage(const tool::Picture& radiance, double factor)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(radiance.Width, radiance.Height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  for (std::size_t k = 0; k < radiance.Pixels.size(); ++k)
  {
    const double value = radiance.Pixels[k];
    bytes[k] = ToByte(k % 4 == 3 ? value : tool::EncodeGamma(std::max(0.0, factor * value)));
  }
  return image;
}

//------------------------------------------------------------------------------
QImage MakeQImage(const tool::Picture& display)
{
  QImage image(display.Width, display.Height, QImage::Format_RGB32);
  for (int y = 0; y < display.Height; ++y)
  {
    for (int x = 0; x < display.Width; ++x)
    {
      const glm::vec4& pixel = display.At(x, y);
      image.setPixel(x, display.Height - 1 - y,
        qRgb(ToByte(tool::EncodeSRGB(pixel[0])), ToByte(tool::EncodeSRGB(pixel[1])),
          ToByte(tool::EncodeSRGB(pixel[2]))));
    }
  }
  return image;
}

//------------------------------------------------------------------------------
tool::Picture MakeBackdropPicture(vtkEnvironment* environment)
{
  return tool::MakeQuietBackdrop(environment).Draw(BackdropWidth, BackdropWidth / 2);
}

//------------------------------------------------------------------------------
glm::dvec3 GetDirection(const LightState& light)
{
  const double theta = glm::radians(light.Theta);
  const double phi = glm::radians(light.Phi);
  return { std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi) };
}

//------------------------------------------------------------------------------
void PlaceLight(vtkLight* light, const LightState& state)
{
  const glm::dvec3 direction = GetDirection(state);
  light->SetLightTypeToSceneLight();
  light->PositionalOff();
  light->SetColor(1.0, 1.0, 1.0);
  light->SetIntensity(state.Irradiance);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetPosition(&direction.x);
}

//------------------------------------------------------------------------------
std::vector<double> DrawDirectional(
  vtkBRDF* brdf, const tool::Surface& surface, const LightState& light)
{
  const glm::dvec3 direction = GetDirection(light);
  const auto tangents = tool::MakeTangents(surface.Normals);
  brdf->Prepare();
  std::vector<double> radiance(surface.Normals.size());
  measuredbrdf::ParallelFor(0, tangents->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType at = 3 * begin; at < 3 * end; at += 3)
      {
        const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(
          glm::make_vec3(&surface.Normals[at]), glm::make_vec3(tangents->GetPointer(at)));
        const glm::dvec3 i = measuredbrdf::ToLocal(frame, direction);
        const glm::dvec3 o = measuredbrdf::ToLocal(frame, glm::make_vec3(&surface.Views[at]));
        glm::dvec3 f;
        brdf->Evaluate(&i.x, &o.x, &f.x);
        f *= light.Irradiance * std::max(0.0, i.z);
        std::copy_n(&f.x, 3, &radiance[at]);
      }
    });
  return radiance;
}
} // namespace explorer
