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
#include <iterator>

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

const MaterialPrecomputation::Kernels& MaterialPrecomputation::GetKernels(
  vtkBRDF* brdf, int angles, int resolution, const std::atomic<bool>& abort, const Use& use)
{
  Kernels& kernels = this->KernelsOf[{ angles, resolution }];
  const Expansion& known = this->Expansions[&kernels];
  const bool areNodesWanted = use.Nodes || known.Degree < use.Degree || known.Orders < use.Orders;
  if (kernels.empty() || std::any_of(kernels.begin(), kernels.end(),
                           [areNodesWanted](const auto& kernel)
                           { return !kernel || (areNodesWanted && !kernel->HasNodes()); }))
  {
    kernels.clear();
    kernels.resize(angles);
    measuredbrdf::ParallelForEach(
      angles,
      [&](int k)
      {
        kernels[k] = std::make_unique<LobeHarmonics>(brdf, LobeViews::GetKnotAngle(k, angles),
          resolution, this->Quick ? QuickKernelCells : KernelCells);
      },
      &abort);
  }
  return kernels;
}

std::vector<std::vector<float>> MaterialPrecomputation::GetExpanded(
  const Kernels& kernels, int degree, int orders)
{
  Expansion& known = this->Expansions[&kernels];
  if (known.Degree < degree || known.Orders < orders)
  {
    assert(std::all_of(kernels.begin(), kernels.end(),
      [](const auto& kernel) { return kernel && kernel->HasNodes(); })); // Use was of less
    known.Degree = std::max(known.Degree, degree);
    known.Orders = std::max(known.Orders, orders);
    std::vector<std::pair<const LobeHarmonics*, double>> lobes;
    for (std::size_t k = 0; k < kernels.size(); ++k)
    {
      const double angle =
        LobeViews::GetKnotAngle(static_cast<int>(k), static_cast<int>(kernels.size()));
      lobes.emplace_back(kernels[k].get(), this->Views->GetAxis(angle));
    }
    known.Harmonics = LobeHarmonics::Expand(lobes, known.Degree, known.Orders);
  }
  if (known.Degree == degree && known.Orders == orders)
  {
    return known.Harmonics;
  }
  std::vector<std::vector<float>> parts;
  for (const std::vector<float>& all : known.Harmonics)
  {
    parts.emplace_back();
    for (int row = 0; row < 3 * (orders + 1); ++row)
    {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(row) * (known.Degree + 1);
      parts.back().insert(parts.back().end(), first, first + degree + 1);
    }
  }
  return parts;
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
    this->Views = std::make_unique<LobeViews>(brdf, abort, this->Quick);
    this->AreViewsWhole = !abort;
  }
  return *this->Views;
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
  this->Remainders.clear();
  this->LampForms.clear();
  for (auto it = this->KernelsOf.begin(); it != this->KernelsOf.end();)
  {
    const bool isKept = it->first.first <= mostAngles && it->first.second <= mostNodes;
    const bool isExpanded = !this->Expansions[&it->second].Harmonics.empty();
    for (const auto& kernel : it->second)
    {
      if (kernel && !isKept && isExpanded)
      {
        kernel->ForgetNodes();
      }
    }
    if (!isKept && !isExpanded)
    {
      this->Expansions.erase(&it->second);
      it = this->KernelsOf.erase(it);
    }
    else
    {
      ++it;
    }
  }
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
    kernels.resize(angles * azimuths);
    measuredbrdf::ParallelForEach(
      kernels.size(),
      [&](std::size_t k)
      {
        const int knot = static_cast<int>(k);
        kernels[k] = std::make_unique<AnisotropicLobe>(brdf,
          AnisotropicViews::GetView(LobeViews::GetKnotAngle(knot / azimuths, angles),
            views.GetAzimuth(knot % azimuths, azimuths)),
          resolution);
      },
      &abort);
  }
  return kernels;
}
} // namespace measuredbrdf
