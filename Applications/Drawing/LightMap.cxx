// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightMap.h"

#include "vtkEnvironment.h"
#include "vtkLightSet.h"

#include <algorithm>
#include <cmath>

namespace
{
// Drawn at this multiple and averaged: smooth edges.
constexpr int MapSmooth = 2;
constexpr tool::RGB Dark = { 0.0, 0.0, 0.0 };
constexpr tool::RGB Bright = { 1.0, 1.0, 1.0 };

//------------------------------------------------------------------------------
// The map as a picture: its typical brightness (mean of the logarithm) becomes mid gray.
tool::Picture ToneMap(vtkEnvironment* environment, int width, int height)
{
  double logarithms = 0.0;
  double weights = 0.0;
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    const double weight = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      double rgb[3];
      environment->GetPixel(x, y, rgb);
      const double luminance = vtkEnvironment::GetLuminance(rgb);
      if (luminance > 0.0)
      {
        logarithms += weight * std::log(luminance);
        weights += weight;
      }
    }
  }
  const double scale = weights > 0.0 ? 0.18 / std::exp(logarithms / weights) : 1.0;

  tool::Picture picture(width, height);
  const tool::Backdrop backdrop(environment);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      std::array<double, 3> direction;
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, direction.data());
      const tool::RGB rgb = backdrop.Look(direction);
      float* pixel = picture.At(x, y);
      for (int c = 0; c < 3; ++c)
      {
        pixel[c] = static_cast<float>(1.0 - std::exp(-scale * rgb[c]));
      }
      pixel[3] = 1.0f;
    }
  }
  return picture;
}

//------------------------------------------------------------------------------
void FillBox(tool::Picture& picture, int x0, int y0, int x1, int y1, const tool::RGB& rgb, double a)
{
  for (int y = std::max(0, y0); y < std::min(picture.Height, y1); ++y)
  {
    for (int x = std::max(0, x0); x < std::min(picture.Width, x1); ++x)
    {
      picture.Blend(x, y, rgb, a);
    }
  }
}

//------------------------------------------------------------------------------
// A frame of the given thickness inside the box.
void DrawFrame(tool::Picture& picture, const int box[4], int inset, int thickness,
  const tool::RGB& rgb, double a)
{
  const int x0 = box[0] + inset;
  const int y0 = box[1] + inset;
  const int x1 = box[2] - inset;
  const int y1 = box[3] - inset;
  if (x1 - x0 < 2 * thickness || y1 - y0 < 2 * thickness)
  {
    return; // no room: neighbors' frames do
  }
  FillBox(picture, x0, y0, x1, y0 + thickness, rgb, a);
  FillBox(picture, x0, y1 - thickness, x1, y1, rgb, a);
  FillBox(picture, x0, y0 + thickness, x0 + thickness, y1 - thickness, rgb, a);
  FillBox(picture, x1 - thickness, y0 + thickness, x1, y1 - thickness, rgb, a);
}

//------------------------------------------------------------------------------
// A dot of the light's color in a bright ring in a dark one: seen on any ground.
void DrawDot(tool::Picture& picture, double x, double y, double radius, const tool::RGB& color)
{
  const double outer = radius + 2.0 * MapSmooth;
  for (int py = static_cast<int>(y - outer); py <= static_cast<int>(y + outer + 1.0); ++py)
  {
    for (int px = static_cast<int>(x - outer); px <= static_cast<int>(x + outer + 1.0); ++px)
    {
      const double distance = std::hypot(px + 0.5 - x, py + 0.5 - y);
      const int wrapped = (px % picture.Width + picture.Width) % picture.Width;
      if (distance < radius)
      {
        picture.Blend(wrapped, py, color, 1.0);
      }
      else if (distance < radius + MapSmooth)
      {
        picture.Blend(wrapped, py, Bright, 1.0);
      }
      else if (distance < outer)
      {
        picture.Blend(wrapped, py, Dark, 0.8);
      }
    }
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
Picture DrawLightMap(vtkEnvironment* environment, vtkLightSet* lights, bool regions,
  int previewWidth, int largestHeight)
{
  const double aspect = static_cast<double>(environment->GetHeight()) / environment->GetWidth();
  const int width = previewWidth * MapSmooth;
  const int height =
    MapSmooth * std::clamp(static_cast<int>(std::lround(previewWidth * aspect)), 16, largestHeight);
  Picture picture = ToneMap(environment, width, height);

  const int n = lights->GetNumberOfLights();
  for (int k = 0; regions && k < n; ++k)
  {
    int region[4];
    if (lights->GetRegion(k, region))
    {
      const int columns = environment->GetSubdivided()->GetWidth();
      const int rows = environment->GetSubdivided()->GetHeight();
      const int box[4] = { region[0] * width / columns, region[1] * height / rows,
        region[2] * width / columns, region[3] * height / rows };
      DrawFrame(picture, box, 0, MapSmooth / 2, Bright, 0.85);
      DrawFrame(picture, box, MapSmooth / 2, MapSmooth / 2, Dark, 0.7);
    }
  }

  const double radius = MapSmooth * std::clamp(40.0 / std::sqrt(std::max(1, n)), 1.0, 4.0);
  for (int k = 0; k < n; ++k)
  {
    double direction[3];
    double irradiance[3];
    lights->GetDirection(k, direction);
    lights->GetIrradiance(k, irradiance);
    double u;
    double v;
    vtkEnvironment::GetCoordinates(direction, u, v);
    const double peak = std::max({ irradiance[0], irradiance[1], irradiance[2], 1e-300 });
    DrawDot(picture, u * width, v * height, radius,
      { irradiance[0] / peak, irradiance[1] / peak, irradiance[2] / peak });
  }
  return Downsample(picture, MapSmooth);
}
} // namespace tool
