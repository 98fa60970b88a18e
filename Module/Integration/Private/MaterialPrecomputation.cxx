// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialPrecomputation.h"

#include "LocalFrame.h"
#include "vtkBRDF.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace measuredbrdf
{
MaterialPrecomputation::MaterialPrecomputation() = default;

MaterialPrecomputation::~MaterialPrecomputation() = default;

const MaterialPrecomputation::Kernels& MaterialPrecomputation::GetKernels(
  vtkBRDF* brdf, int angles, int resolution, const std::atomic<bool>& abort)
{
  Kernels& kernels = this->KernelsOf[{ angles, resolution }];
  if (kernels.empty() ||
      std::any_of(kernels.begin(), kernels.end(), [](const auto& kernel) { return !kernel; }))
  {
    kernels.clear();
    kernels.resize(static_cast<std::size_t>(angles));
    vtkSMPTools::For(0, angles, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end && !abort; ++k)
        {
          kernels[static_cast<std::size_t>(k)] = std::make_unique<LobeHarmonics>(
            brdf, LobeViews::GetKnotAngle(static_cast<int>(k), angles), resolution);
        }
      });
  }
  return kernels;
}

const MaterialPrecomputation::Matrices& MaterialPrecomputation::GetRemainders(
  const std::vector<double>& sizes, const std::function<Matrices()>& make)
{
  Matrices& known = this->Remainders[sizes];
  if (known.empty())
  {
    known = make();
  }
  return known;
}

const LobeViews& MaterialPrecomputation::GetViews(vtkBRDF* brdf, const std::atomic<bool>& abort)
{
  if (!this->AreViewsWhole)
  {
    this->Views = std::make_unique<LobeViews>(brdf, abort);
    this->AreViewsWhole = !abort;
  }
  return *this->Views;
}

void MaterialPrecomputation::Trim(int mostAngles)
{
  this->Remainders.clear();
  for (auto it = this->KernelsOf.begin(); it != this->KernelsOf.end();)
  {
    it = it->first.first > mostAngles ? this->KernelsOf.erase(it) : std::next(it);
  }
}

std::size_t MaterialPrecomputation::GetBytes() const
{
  std::size_t bytes = 0;
  for (const auto& [sizes, kernels] : this->KernelsOf)
  {
    for (const auto& kernel : kernels)
    {
      bytes += kernel ? kernel->GetBytes() : 0;
    }
  }
  if (this->Views)
  {
    for (const LobeViews::View& view : this->Views->GetViews())
    {
      bytes += sizeof(view) + view.Cells.size() * sizeof(LobeViews::Cell);
    }
  }
  return bytes;
}

const AnisotropicViews& MaterialPrecomputation::GetAnisotropicViews(
  vtkBRDF* brdf, const std::atomic<bool>& abort)
{
  if (!this->AreViewsByAzimuthWhole)
  {
    this->ViewsByAzimuth = std::make_unique<AnisotropicViews>(brdf, abort);
    this->AreViewsByAzimuthWhole = !abort;
  }
  return *this->ViewsByAzimuth;
}

const MaterialPrecomputation::AnisotropicKernels& MaterialPrecomputation::GetAnisotropicKernels(
  vtkBRDF* brdf, int angles, int azimuths, int resolution, const std::atomic<bool>& abort)
{
  const AnisotropicViews& views = this->GetAnisotropicViews(brdf, abort);
  AnisotropicKernels& kernels = this->KernelsByAzimuth[{ angles, azimuths, resolution }];
  if (kernels.empty() ||
      std::any_of(kernels.begin(), kernels.end(), [](const auto& kernel) { return !kernel; }))
  {
    kernels.clear();
    kernels.resize(static_cast<std::size_t>(angles * azimuths));
    vtkSMPTools::For(0, static_cast<vtkIdType>(kernels.size()), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end && !abort; ++k)
        {
          const int knot = static_cast<int>(k);
          kernels[static_cast<std::size_t>(k)] = std::make_unique<AnisotropicLobe>(brdf,
            AnisotropicViews::GetView(LobeViews::GetKnotAngle(knot / azimuths, angles),
              views.GetAzimuth(knot % azimuths, azimuths)),
            resolution);
        }
      });
  }
  return kernels;
}
} // namespace measuredbrdf
