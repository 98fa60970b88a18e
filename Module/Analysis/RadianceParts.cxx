// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceParts.h"

#include "BrightTexels.h"
#include "LocalFrame.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
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

const RadianceParts::Lamps& RadianceParts::GetLamps(
  vtkEnvironment* environment, double angle, int maximum)
{
  const auto [found, isNew] = this->LampsOf.try_emplace({ angle, maximum });
  Lamps& lamps = found->second;
  if (!isNew)
  {
    return lamps;
  }
  environment = environment->GetSubdivided();
  BrightTexels bright = BrightTexels::FindLamps(environment, angle, maximum);
  lamps.Rest = environment;
  if (!bright.Lights.empty())
  {
    lamps.Rest = vtkSmartPointer<vtkEnvironment>::New();
    lamps.Rest->SetPixels(
      environment->GetWidth(), environment->GetHeight(), std::move(bright.Rest));
    lamps.Lights = vtkSmartPointer<vtkLightSet>::New();
    for (const BrightTexels::Light& light : bright.Lights)
    {
      lamps.Lights->AddLight(&light.Direction.x, &light.Irradiance.x);
    }
  }
  return lamps;
}

const EnvironmentHarmonics& RadianceParts::GetHarmonics(vtkEnvironment* environment, int degree)
{
  environment = environment->GetSubdivided(); // as lamps leave it
  std::unique_ptr<EnvironmentHarmonics>& harmonics = this->Harmonics[environment];
  if (!harmonics || harmonics->GetMaximumDegree() < degree)
  {
    harmonics = std::make_unique<EnvironmentHarmonics>(environment, degree);
  }
  return *harmonics;
}

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
