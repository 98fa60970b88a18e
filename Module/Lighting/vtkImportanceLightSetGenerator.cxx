// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImportanceLightSetGenerator.h"

#include "Distribution.h"
#include "LowDiscrepancy.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

vtkStandardNewMacro(vtkImportanceLightSetGenerator);

//------------------------------------------------------------------------------
bool vtkImportanceLightSetGenerator::Generate(
  vtkEnvironment* environment, int count, vtkLightSet* output)
{
  if (!this->CheckArguments(environment, count, output))
  {
    return false;
  }

  environment = environment->GetSubdivided();
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  std::vector<double> weights;
  weights.reserve(environment->GetPixels().size() / 3);
  const float* pixel = environment->GetPixels().data();
  for (int y = 0; y < height; ++y)
  {
    const double solidAngle = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < width; ++x, pixel += 3)
    {
      const double rgb[3] = { pixel[0], pixel[1], pixel[2] };
      weights.push_back(solidAngle * vtkEnvironment::GetLuminance(rgb));
    }
  }
  const measuredbrdf::Distribution2D distribution(
    weights, static_cast<std::size_t>(width), static_cast<std::size_t>(height));

  output->RemoveAllLights();
  if (distribution.IsZero())
  {
    return true;
  }

  // The engine's bits are fixed by the standard; its distributions are not.
  std::mt19937 engine(this->Seed);
  const auto random = [&engine]() { return static_cast<double>(engine()) * 0x1p-32; };
  const double shift = random();
  const double share = distribution.GetTotal() / count;
  for (int k = 0; k < count; ++k)
  {
    const double v = (k + random()) / count;
    const double u =
      measuredbrdf::Wrap01(measuredbrdf::RadicalInverse(static_cast<std::uint32_t>(k), 2) + shift);
    std::size_t x;
    std::size_t y;
    double inX;
    double inY;
    distribution.Invert(u, v, x, y, inX, inY);

    // Uniform in solid angle inside the texel: linear in the sine of the latitude.
    double bottom[3];
    double top[3];
    vtkEnvironment::GetDirection(0.5, static_cast<double>(y) / height, bottom);
    vtkEnvironment::GetDirection(0.5, static_cast<double>(y + 1) / height, top);
    const double sine = bottom[1] + inY * (top[1] - bottom[1]);
    const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
    double direction[3];
    vtkEnvironment::GetDirection((static_cast<double>(x) + inX) / width, 0.5, direction);
    direction[0] *= cosine;
    direction[1] = sine;
    direction[2] *= cosine;

    // L / (N p) with p = luminance(L) / total: luminance total / N in the texel's color.
    double rgb[3];
    environment->GetPixel(static_cast<int>(x), static_cast<int>(y), rgb);
    const double solidAngle = share / vtkEnvironment::GetLuminance(rgb);
    for (double& channel : rgb)
    {
      channel *= solidAngle;
    }
    output->AddLight(direction, rgb, solidAngle);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkImportanceLightSetGenerator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Seed: " << this->Seed << "\n";
}
