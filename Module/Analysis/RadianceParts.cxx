// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceParts.h"

#include "LocalFrame.h"
#include "vtkBRDF.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr int ProfileResolution = 32; // only means are used
}

RadianceParts::RadianceParts() = default;

RadianceParts::~RadianceParts() = default;

double RadianceParts::GetLastView() { return std::acos(MinimumViewCosine); }

// The first is the normal itself: there the axis must not depend on the azimuth. Towards the
// horizon measured f is steep.
double RadianceParts::GetProfileAngle(int index)
{
  const double t = 1.0 - static_cast<double>(index) / (ProfileSize - 1);
  return GetLastView() * (1.0 - t * t);
}

void RadianceParts::Make(vtkBRDF* brdf, const std::vector<double>& angles, int resolution,
  const std::atomic<bool>& abort, Kernels& kernels)
{
  if (kernels.empty() ||
      std::any_of(kernels.begin(), kernels.end(), [](const auto& kernel) { return !kernel; }))
  {
    kernels.clear();
    kernels.resize(angles.size());
    vtkSMPTools::For(0, static_cast<vtkIdType>(angles.size()), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end && !abort; ++k)
        {
          const std::size_t index = static_cast<std::size_t>(k);
          kernels[index] = std::make_unique<KernelHarmonics>(brdf, angles[index], resolution);
        }
      });
  }
}

const RadianceParts::Kernels& RadianceParts::GetKernels(
  vtkBRDF* brdf, int angles, int resolution, const std::atomic<bool>& abort)
{
  std::vector<double> thetas;
  for (int k = 0; k < angles; ++k)
  {
    thetas.push_back(GetLastView() * k / (angles - 1));
  }
  Kernels& kernels = this->KernelsOf[{ angles, resolution }];
  Make(brdf, thetas, resolution, abort, kernels);
  return kernels;
}

const KernelViews& RadianceParts::GetViews(vtkBRDF* brdf)
{
  if (!this->Views)
  {
    this->Views = std::make_unique<KernelViews>(brdf);
  }
  return *this->Views;
}

const RadianceParts::Kernels& RadianceParts::GetProfile(
  vtkBRDF* brdf, const std::atomic<bool>& abort)
{
  std::vector<double> thetas;
  for (int k = 0; k < ProfileSize; ++k)
  {
    thetas.push_back(GetProfileAngle(k));
  }
  Make(brdf, thetas, ProfileResolution, abort, this->Profile);
  return this->Profile;
}
} // namespace measuredbrdf
