// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Display.h"

#include "Sheets.h"

#include "vtkActor.h"
#include "vtkEnvironment.h"
#include "vtkMath.h"
#include "vtkShaderProperty.h"
#include "vtkUniforms.h"

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
void ShowRadiance(vtkActor* actor)
{
  actor->GetShaderProperty()->AddFragmentShaderReplacement(
    "//VTK::Light::Impl", false, DisplayCode, false);
  SetExposure(actor, 1.0);
}

//------------------------------------------------------------------------------
void SetExposure(vtkActor* actor, double factor)
{
  actor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf(
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
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(display.Height - 1 - y));
    for (int x = 0; x < display.Width; ++x)
    {
      const float* pixel = display.At(x, y);
      line[x] = qRgb(ToByte(tool::EncodeSRGB(pixel[0])), ToByte(tool::EncodeSRGB(pixel[1])),
        ToByte(tool::EncodeSRGB(pixel[2])));
    }
  }
  return image;
}

//------------------------------------------------------------------------------
tool::Picture MakeBackdropPicture(vtkEnvironment* environment)
{
  const tool::Backdrop backdrop = tool::MakeQuietBackdrop(environment);
  tool::Picture picture(BackdropWidth, BackdropWidth / 2);
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      std::array<double, 3> direction;
      vtkEnvironment::GetDirection(
        (x + 0.5) / picture.Width, (y + 0.5) / picture.Height, direction.data());
      const tool::RGB rgb = backdrop.Look(direction);
      std::copy(rgb.begin(), rgb.end(), picture.At(x, y));
      picture.At(x, y)[3] = 1.0f;
    }
  }
  return picture;
}
} // namespace explorer
