// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialPrecomputation.h"

#include "Lamps.h"
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace measuredbrdf
{
namespace
{
// That tell where a kernel is.
constexpr int KernelCells = 512;
constexpr int QuickKernelCells = 128;
}

MaterialPrecomputation::MaterialPrecomputation(bool quick)
  : Quick(quick)
{
}

MaterialPrecomputation::~MaterialPrecomputation() = default;

MaterialKernels& MaterialPrecomputation::GetKernels(
  vtkBRDF* brdf, const Sizes& sizes, const std::atomic<bool>& abort, const Use& use)
{
  const auto [angles, resolution, azimuths] = sizes;
  MaterialKernels& kernels = this->KernelsOf[{ angles, resolution, azimuths }];
  const bool areNodesWanted = use.Nodes || kernels.NeedsNodes(use.Degree, use.Orders);
  if (!kernels.At.empty() && !(areNodesWanted && !kernels.At.front().HasNodes()))
  {
    return kernels;
  }
  const LobeViews* const views = azimuths > 0 ? nullptr : &this->GetViews(brdf, abort);
  const AnisotropicViews* const turned =
    azimuths > 0 ? &this->GetAnisotropicViews(brdf, abort) : nullptr;
  std::vector<LobeKernel> all(std::max(azimuths, 1) * angles);
  measuredbrdf::ParallelForEach(
    all.size(),
    [&, each = std::max(azimuths, 1), nodes = resolution](std::size_t k)
    {
      const int knot = static_cast<int>(k);
      const double theta =
        LobeViews::GetKnotAngle(knot / each, static_cast<int>(all.size()) / each);
      const double phi = turned ? turned->GetAzimuth(knot % each, each) : 0.0;
      all[k] = LobeKernel(brdf, AnisotropicViews::GetView(theta, phi), nodes,
        this->Quick ? QuickKernelCells : KernelCells, !turned);
      all[k].Means.Delta = views ? views->GetAxis(theta) : 0.0;
    },
    &abort);
  kernels.At = abort ? std::vector<LobeKernel>() : std::move(all); // never a part of them
  return kernels;
}

std::vector<std::vector<float>> MaterialKernels::Expand(int degree, int orders)
{
  if (this->NeedsNodes(degree, orders))
  {
    assert(!this->At.empty() && this->At.front().HasNodes()); // Use was of less
    std::vector<TurnedLobe> lobes;
    for (const LobeKernel& kernel : this->At)
    {
      lobes.push_back({ &kernel, kernel.Means.Delta });
    }
    const int highest = std::max(this->Degree, degree), most = std::max(this->Orders, orders);
    this->Harmonics = ExpandLobes(lobes, highest, most);
    this->Degree = highest; // not before: where that throws, what is known stays
    this->Orders = most;
  }
  std::vector<std::vector<float>> parts;
  for (const std::vector<float>& all : this->Harmonics)
  {
    parts.emplace_back();
    for (int row = 0; row < 3 * (orders + 1); ++row)
    {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(row) * (this->Degree + 1);
      parts.back().insert(parts.back().end(), first, first + degree + 1);
    }
  }
  return parts;
}

// Views that were aborted are of no use, but for the caller that aborted them.
const LobeViews& MaterialPrecomputation::GetViews(vtkBRDF* brdf, const std::atomic<bool>& abort)
{
  if (!this->AreViewsWhole)
  {
    this->Views = std::make_unique<LobeViews>(brdf, abort, this->Quick);
    this->AreViewsWhole = !abort;
  }
  return *this->Views;
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

vtkSmartPointer<vtkBRDF> MaterialPrecomputation::GetLampForm(
  vtkBRDF* brdf, double spread, const std::atomic<bool>& abort)
{
  const auto known = this->LampForms.find(spread);
  if (known != this->LampForms.end())
  {
    return known->second;
  }
  const LobeViews& views = this->GetViews(brdf, abort);
  if (abort)
  {
    return nullptr;
  }
  const auto form = LampBRDF::Make(brdf, spread);
  form->SetSeesParts(LampBRDF::IsWidthSeen(views, spread));
  this->LampForms[spread] = form;
  return form;
}

void MaterialPrecomputation::Trim(int mostAngles, int mostNodes)
{
  this->LampForms.clear();
  for (auto& [sizes, kernels] : this->KernelsOf)
  {
    if (sizes[0] > mostAngles || sizes[1] > mostNodes)
    {
      std::for_each(kernels.At.begin(), kernels.At.end(), std::mem_fn(&LobeKernel::ForgetNodes));
    }
  }
}
} // namespace measuredbrdf
