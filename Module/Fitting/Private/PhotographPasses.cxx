// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PhotographPasses.h"

#include "vtkPhotographSet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
std::string FormatSize(int width, int height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}
}

//------------------------------------------------------------------------------
PhotographPasses::PhotographPasses(vtkPhotographSet* set, std::function<bool(double)> proceed)
  : Set(set)
  , Report(std::move(proceed))
{
}

//------------------------------------------------------------------------------
void PhotographPasses::Read(int index, PhotographPixels& pixels) const
{
  const std::string problem = ReadPhotograph(this->Set, index, pixels);
  if (problem.empty())
  {
    return;
  }
  const std::string name = this->Set->GetName(index);
  const bool named = !name.empty() && problem.find(name) != std::string::npos;
  throw PhotographError(
    (named ? "" : (name.empty() ? "photograph " + std::to_string(index) : name) + ": ") + problem);
}

//------------------------------------------------------------------------------
void PhotographPasses::Open()
{
  PhotographPixels pixels;
  this->Read(0, pixels);
  this->Width = pixels.Width;
  this->Height = pixels.Height;
}

//------------------------------------------------------------------------------
bool PhotographPasses::Run(
  double from, double to, const std::function<void(int, const PhotographPixels&)>& use)
{
  const int count = this->Set->GetNumberOfPhotographs();
  PhotographPixels pixels;
  for (int k = 0; k < count; ++k)
  {
    if (!this->Proceed(from + (to - from) * k / count))
    {
      return false;
    }
    this->Read(k, pixels);
    if (pixels.Width != this->Width || pixels.Height != this->Height)
    {
      const std::string name = this->Set->GetName(k);
      throw PhotographError((name.empty() ? "photograph " + std::to_string(k) : name) +
                            ": size: found " + FormatSize(pixels.Width, pixels.Height) +
                            ", expected the first photograph's " +
                            FormatSize(this->Width, this->Height));
    }
    if (this->NumberOfPasses == 0)
    {
      const auto counts = pixels.CountStates();
      std::transform(counts.begin(), counts.end(), this->PixelCounts.begin(),
        this->PixelCounts.begin(), std::plus<std::uint64_t>());
    }
    use(k, pixels);
  }
  ++this->NumberOfPasses;
  return true;
}

//------------------------------------------------------------------------------
bool PhotographPasses::Proceed(double share)
{
  this->Stopped = this->Stopped || !this->Report(share);
  return !this->Stopped;
}

//------------------------------------------------------------------------------
MaterialValues EvaluateMaterials(vtkPhotographSet* set, const std::vector<NamedMaterial>& materials,
  const std::vector<double>& scales)
{
  const int photographs = set->GetNumberOfPhotographs();
  MaterialValues result;
  result.Values.resize(3 * photographs, static_cast<Eigen::Index>(materials.size()));
  result.Scales = scales;
  for (const NamedMaterial& material : materials)
  {
    material.BRDF->Prepare();
  }
  for (int k = 0; k < photographs; ++k)
  {
    double light[3], view[3];
    set->GetLight(k, light);
    set->GetView(k, view);
    const double scale = set->GetScale(k);
    double logarithms = 0.0;
    for (std::size_t m = 0; m < materials.size(); ++m)
    {
      double f[3];
      materials[m].BRDF->Evaluate(light, view, f);
      for (int c = 0; c < 3; ++c)
      {
        result.Values(3 * k + c, static_cast<Eigen::Index>(m)) = scale * f[c];
        logarithms += std::log(scale * f[c] + NoiseFloor);
      }
    }
    if (scales.empty())
    {
      result.Scales.push_back(std::exp(
        logarithms / (3.0 * static_cast<double>(std::max<std::size_t>(materials.size(), 1)))));
    }
    result.Values.middleRows<3>(3 * k) /= result.Scales[static_cast<std::size_t>(k)];
  }
  return result;
}
} // namespace measuredbrdf
