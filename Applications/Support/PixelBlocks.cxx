// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PixelBlocks.h"

#include "Methods.h"
#include "RunWithProgress.h"
#include "Tool.h"

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"

#include <array>
#include <cstddef>
#include <set>
#include <utility>

namespace
{
using Block = std::array<int, 4>; // pixels of the surface

// That of a pixel; pixels that are not covered are replaced by one that is.
Block FindBlock(const tool::Surface& surface, int width, const std::vector<int>& places, int pixel)
{
  const int place = surface.Pixels[static_cast<std::size_t>(pixel)];
  const int left = place % width / 2 * 2;
  const int top = place / width / 2 * 2;
  Block block{ -1, -1, -1, -1 };
  int covered = -1;
  for (int k = 0; k < 4; ++k)
  {
    const int x = left + k % 2;
    const auto at = static_cast<std::size_t>((top + k / 2) * width + x);
    block[static_cast<std::size_t>(k)] = x < width && at < places.size() ? places[at] : -1;
    covered = covered < 0 ? block[static_cast<std::size_t>(k)] : covered;
  }
  for (int& other : block)
  {
    other = other < 0 ? covered : other;
  }
  return block;
}
}

namespace tool
{
//------------------------------------------------------------------------------
std::vector<double> IntegratePixels(vtkAdaptiveRadianceIntegrator* integrator,
  const Surface& surface, const std::vector<int>& pixels, const std::function<void(double)>& show)
{
  std::vector<double> normals;
  std::vector<double> views;
  for (const int k : pixels)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      normals.push_back(surface.Normals[3 * static_cast<std::size_t>(k) + c]);
      views.push_back(surface.Views[3 * static_cast<std::size_t>(k) + c]);
    }
  }
  return pixels.empty() ? normals : IntegrateSomePairs(integrator, normals, views, show);
}

//------------------------------------------------------------------------------
std::size_t CountInBlocks(const Surface& surface, int width, const std::vector<int>& pixels)
{
  std::set<std::pair<int, int>> blocks;
  for (const int pixel : pixels)
  {
    const int place = surface.Pixels[static_cast<std::size_t>(pixel)];
    blocks.insert({ place % width / 2, place / width / 2 });
  }
  return 4 * blocks.size();
}

//------------------------------------------------------------------------------
std::vector<double> IntegrateInBlocks(vtkAdaptiveRadianceIntegrator* integrator,
  const Surface& surface, int width, const std::vector<int>& places, const std::vector<int>& pixels,
  const std::function<void(double)>& show)
{
  std::vector<int> pairs(surface.Pixels.size(), -1); // of each pixel
  vtkNew<vtkDoubleArray> normals, views, radiance;
  normals->SetNumberOfComponents(3);
  views->SetNumberOfComponents(3);
  for (const int pixel : pixels)
  {
    if (pairs[static_cast<std::size_t>(pixel)] >= 0)
    {
      continue;
    }
    for (const int other : FindBlock(surface, width, places, pixel))
    {
      const auto at = static_cast<std::size_t>(other);
      pairs[at] = static_cast<int>(normals->GetNumberOfTuples());
      normals->InsertNextTuple(&surface.Normals[3 * at]);
      views->InsertNextTuple(&surface.Views[3 * at]);
    }
  }
  std::vector<double> result(3 * pixels.size());
  if (pixels.empty())
  {
    return result;
  }
  const bool done = RunWithProgress(
    integrator,
    [&](vtkAdaptiveRadianceIntegrator* made)
    { return made->IntegrateNeighbors(normals, views, radiance); },
    show);
  if (!done)
  {
    throw Error("integrating: " + TakeErrorText());
  }
  for (std::size_t k = 0; k < pixels.size(); ++k)
  {
    radiance->GetTuple(pairs[static_cast<std::size_t>(pixels[k])], &result[3 * k]);
  }
  return result;
}
} // namespace tool
