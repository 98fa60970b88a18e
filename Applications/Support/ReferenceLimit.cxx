// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceLimit.h"

#include "Methods.h"
#include "Tool.h"

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>

namespace
{
constexpr std::size_t TimedPixels = 64;
}

namespace tool
{
//------------------------------------------------------------------------------
double EstimateReferenceSeconds(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface)
{
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(brdf);
  reference->SetEnvironment(environment);
  reference->Prepare();
  const std::size_t count = surface.Pixels.size();
  std::vector<double> normals;
  std::vector<double> views;
  for (std::size_t k = 0; k < TimedPixels; ++k)
  {
    const std::size_t pixel = 3 * ((2 * k + 1) * count / (2 * TimedPixels));
    normals.insert(normals.end(), &surface.Normals[pixel], &surface.Normals[pixel] + 3);
    views.insert(views.end(), &surface.Views[pixel], &surface.Views[pixel] + 3);
  }
  const auto begin = std::chrono::steady_clock::now();
  IntegratePairs(reference, normals, views);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  return seconds.count() * static_cast<double>(count) / TimedPixels;
}

//------------------------------------------------------------------------------
int LimitReference(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface,
  double seconds, const std::string& option)
{
  const auto count = static_cast<double>(surface.Pixels.size());
  const double needed = seconds > 0.0 ? EstimateReferenceSeconds(brdf, environment, surface) : 0.0;
  if (needed <= seconds)
  {
    return static_cast<int>(count);
  }
  const int affordable = std::max(1, static_cast<int>(count * seconds / needed));
  char text[200];
  std::snprintf(text, sizeof(text),
    "The reference of %.0f pixels may take %.2g s, more than %s %g: at most %d pixels on a grid "
    "are "
    "compared.\n",
    count, needed, option.c_str(), seconds, affordable);
  PrintOut(text);
  return affordable;
}
} // namespace tool
