// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMedianCutLightSetGenerator.h"

#include "HalfVector.h" // for Pi
#include "LightTree.h"
#include "ParallelFor.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"

#include <glm/glm.hpp>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

using measuredbrdf::Pi;

namespace
{
using measuredbrdf::LightCell;

// Both halves of a region, across its longer side (Debevec 2005: the width shrinks with the cosine
// of the middle row's latitude), where they are nearest to equal luminance.
void Split(const LightCell& r, measuredbrdf::CellSlices& slices, int width, int height,
  std::vector<LightCell>& halves)
{
  const double latitude = Pi * (0.5 * (r.Y0 + r.Y1) / height - 0.5);
  const double extentX = 2.0 * Pi * (r.X1 - r.X0) / width * std::cos(latitude);
  const double extentY = Pi * (r.Y1 - r.Y0) / height;
  const bool across = r.X1 - r.X0 > 1 && (extentX >= extentY || r.Y1 - r.Y0 == 1);
  if (r.IsTexel())
  {
    halves.push_back(r);
    return;
  }
  slices.Sum(r, across, !across);
  const std::vector<glm::dvec4>& sums = across ? slices.Columns : slices.Rows;
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
  if (across)
  {
    halves.push_back({ r.X0, r.Y0, r.X0 + cut, r.Y1 });
    halves.push_back({ r.X0 + cut, r.Y0, r.X1, r.Y1 });
  }
  else
  {
    halves.push_back({ r.X0, r.Y0, r.X1, r.Y0 + cut });
    halves.push_back({ r.X0, r.Y0 + cut, r.X1, r.Y1 });
  }
}
} // namespace

vtkStandardNewMacro(vtkMedianCutLightSetGenerator);

//------------------------------------------------------------------------------
bool vtkMedianCutLightSetGenerator::Generate(
  vtkEnvironment* environment, int count, vtkLightSet* output)
{
  if (!this->CheckArguments(environment, count, output))
  {
    return false;
  }
  if ((count & (count - 1)) != 0)
  {
    vtkErrorMacro(
      "Generate: median cut makes a power of two of lights (64, 128, ...), not " << count << ".");
    return false;
  }

  environment = environment->GetSubdivided();
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  const measuredbrdf::TexelChanges none;
  measuredbrdf::CellSlices slices(environment, none);
  std::vector<LightCell> regions(1, LightCell{ 0, 0, width, height });
  for (int made = 1; made < count; made *= 2)
  {
    std::vector<LightCell> halves;
    halves.reserve(2 * regions.size());
    for (const LightCell& region : regions)
    {
      Split(region, slices, width, height, halves);
    }
    if (halves.size() == regions.size()) // only single texels are left
    {
      break;
    }
    regions.swap(halves);
  }

  measuredbrdf::ParallelForEach(
    regions.size(), [&](std::size_t k) { regions[k].Gather(environment, none, slices.Directions); },
    nullptr, 0);
  output->RemoveAllLights();
  for (const LightCell& region : regions)
  {
    region.AddLight(width, height, output);
  }
  return true;
}
