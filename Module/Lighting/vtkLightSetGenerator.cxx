// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLightSetGenerator.h"

#include "Distribution.h"
#include "HalfVector.h" // for Pi
#include "LightTree.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "SRGB.h"
#include "Setters.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkLightSetGenerator);

namespace
{
//------------------------------------------------------------------------------
// Both halves of a region, across its longer side (Debevec 2005: the width shrinks with the cosine
// of the middle row's latitude), where they are nearest to equal luminance; a texel stays whole.
void Split(const LightCell& region, CellSlices& slices, int width, int height,
  std::vector<LightCell>& halves)
{
  if (region.IsTexel())
  {
    halves.push_back(region);
    return;
  }
  const double latitude = Pi * (0.5 * (region.Y0 + region.Y1) / height - 0.5);
  const double extentX = 2.0 * Pi * region.GetWidth() / width * std::cos(latitude);
  const double extentY = Pi * region.GetHeight() / height;
  const bool columns = region.GetWidth() > 1 && (extentX >= extentY || region.GetHeight() == 1);
  slices.Sum(region, columns, !columns);
  const std::vector<glm::dvec4>& sums = columns ? slices.Columns : slices.Rows;
  const double total = std::accumulate(sums.begin(), sums.end(), glm::dvec4(0.0)).w;
  int cut = 0;
  double least = std::numeric_limits<double>::infinity();
  double part = 0.0;
  for (std::size_t k = 1; k < sums.size(); ++k)
  {
    part += sums[k - 1].w;
    const double difference = std::abs(2.0 * part - total);
    if (difference < least - 1e-12 * total) // of equals, but for rounding, the first
    {
      least = difference;
      cut = static_cast<int>(k);
    }
  }
  for (const LightCell& half : region.Cut(columns, cut))
  {
    halves.push_back(half);
  }
}

//------------------------------------------------------------------------------
// Of an environment whose texels are small enough, as the others.
void CutByMedian(vtkEnvironment* environment, int count, vtkLightSet* output)
{
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  const TexelChanges none;
  CellSlices slices(environment, none);
  std::vector<LightCell> regions = { { 0, 0, width, height } };
  for (int made = 1; made < count; made *= 2)
  {
    std::vector<LightCell> halves;
    for (const LightCell& region : regions)
    {
      Split(region, slices, width, height, halves);
    }
    regions.swap(halves);
  }

  ParallelForEach(
    regions.size(), [&](std::size_t k) { regions[k].Gather(environment, none, slices.Directions); },
    nullptr, 0);
  for (const LightCell& region : regions)
  {
    region.AddLight(width, height, output);
  }
}

//------------------------------------------------------------------------------
void DrawByImportance(
  vtkEnvironment* environment, int count, unsigned int seed, vtkLightSet* output)
{
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  std::vector<double> weights;
  const float* pixel = environment->GetPixels().data();
  for (int y = 0; y < height; ++y)
  {
    const double solidAngle = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < width; ++x, pixel += 3)
    {
      weights.push_back(solidAngle * GetLuminance(pixel));
    }
  }
  const Distribution2D distribution(weights, width, height);
  if (distribution.IsZero())
  {
    return;
  }

  // The engine's bits are fixed by the standard; its distributions are not.
  std::mt19937 engine(seed);
  const auto random = [&engine]() { return static_cast<double>(engine()) * 0x1p-32; };
  const double shift = random();
  const double share = distribution.GetTotal() / count;
  for (int k = 0; k < count; ++k)
  {
    const double v = (k + random()) / count;
    const double u = Wrap01(RadicalInverse(static_cast<std::uint32_t>(k), 2) + shift);
    std::size_t x, y;
    double inX, inY;
    distribution.Invert(u, v, x, y, inX, inY);

    // Uniform in solid angle inside the texel: linear in the sine of the latitude.
    glm::dvec3 bottom, top, direction, radiance;
    vtkEnvironment::GetDirection(0.5, static_cast<double>(y) / height, &bottom.x);
    vtkEnvironment::GetDirection(0.5, static_cast<double>(y + 1) / height, &top.x);
    vtkEnvironment::GetDirection((static_cast<double>(x) + inX) / width, 0.5, &direction.x);
    const double sine = glm::mix(bottom.y, top.y, inY);
    direction *= std::sqrt(std::max(0.0, 1.0 - sine * sine));
    direction.y = sine;

    // L / (N p) with p = luminance(L) / total: luminance total / N in the texel's color.
    environment->GetPixel(static_cast<int>(x), static_cast<int>(y), &radiance.x);
    const double solidAngle = share / GetLuminance(radiance);
    const glm::dvec3 irradiance = solidAngle * radiance;
    output->AddLight(&direction.x, &irradiance.x, solidAngle);
  }
}
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkLightSetGenerator, Method, int, MEDIAN_CUT, IMPORTANCE);

//------------------------------------------------------------------------------
bool vtkLightSetGenerator::Generate(vtkEnvironment* environment, int count, vtkLightSet* output)
{
  if (!environment || environment->GetPixels().empty())
  {
    vtkErrorMacro("Generate: there is no environment, or it is empty.");
    return false;
  }
  if (!output)
  {
    vtkErrorMacro("Generate: there is no light set to fill.");
    return false;
  }
  if (count < 1 || count > MaximumNumberOfLights)
  {
    vtkErrorMacro("Generate: the number of lights must be in [1, " << MaximumNumberOfLights
                                                                   << "], not " << count << ".");
    return false;
  }
  if (this->Method == MEDIAN_CUT && (count & (count - 1)) != 0)
  {
    vtkErrorMacro(
      "Generate: median cut makes a power of two of lights (64, 128, ...), not " << count << ".");
    return false;
  }
  output->RemoveAllLights();
  environment = environment->GetSubdivided();
  if (this->Method == MEDIAN_CUT)
  {
    CutByMedian(environment, count, output);
  }
  else if (this->Method == IMPORTANCE)
  {
    DrawByImportance(environment, count, this->Seed, output);
  }
  else
  {
    LightTree(environment, TexelChanges(), count, []() { return true; })
      .FillLightSet(count, output);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkLightSetGenerator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
}
