// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KernelLayers.h"

#include "LobeQuadrature.h"
#include "LocalFrame.h"
#include "vtkObjectFactory.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int Cells = 512; // of a view's quadrature

// Views are found from coarse to fine: one is interpolated where those about it agree, by so much
// of the albedo and so many radians, with what their neighbours say.
constexpr int Stride = 8;
constexpr double LargestBend = 1e-3;

double GetSum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }
}

double KernelViews::GetLastAngle() { return std::acos(MinimumViewCosine); }

double KernelViews::GetAngle(int index)
{
  const double t = 1.0 - static_cast<double>(index) / (NumberOfViews - 1);
  return GetLastAngle() * (1.0 - t * t);
}

double KernelViews::GetPosition(double angle)
{
  return (NumberOfViews - 1) * (1.0 - std::sqrt(std::max(1.0 - angle / GetLastAngle(), 0.0)));
}

KernelViews::KernelViews(vtkBRDF* brdf)
  : Views(NumberOfViews)
{
  std::vector<int> wanted;
  for (int k = 0; k < NumberOfViews - 1; k += Stride)
  {
    wanted.push_back(k);
  }
  wanted.push_back(NumberOfViews - 1);
  this->Evaluate(brdf, wanted);
  std::vector<int> known = wanted; // sorted
  std::vector<std::pair<int, int>> gaps;
  for (std::size_t k = 0; k + 1 < known.size(); ++k)
  {
    gaps.emplace_back(known[k], known[k + 1]);
  }
  while (!gaps.empty())
  {
    wanted.clear();
    std::vector<KernelMeans> guesses;
    for (const auto& [low, high] : gaps)
    {
      wanted.push_back((low + high) / 2);
      guesses.push_back(this->Interpolate(known, wanted.back()));
    }
    this->Evaluate(brdf, wanted);
    std::vector<std::pair<int, int>> finer;
    for (std::size_t k = 0; k < gaps.size(); ++k)
    {
      const auto [low, high] = gaps[k];
      const int middle = wanted[k];
      const KernelMeans& means = this->Views[static_cast<std::size_t>(middle)].Means;
      if (KernelMeans::GetDistance(means, guesses[k]) > LargestBend)
      {
        for (const auto& gap : { std::pair(low, middle), std::pair(middle, high) })
        {
          if (gap.second - gap.first > 1)
          {
            finer.push_back(gap);
          }
        }
      }
    }
    known.insert(known.end(), wanted.begin(), wanted.end());
    std::sort(known.begin(), known.end());
    gaps = finer;
  }
  for (int k = 0; k < NumberOfViews; ++k)
  {
    View& view = this->Views[static_cast<std::size_t>(k)];
    if (view.Cells.empty())
    {
      view.Means = this->Interpolate(known, k);
    }
  }
}

void KernelViews::Evaluate(vtkBRDF* brdf, const std::vector<int>& indices)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(indices.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        const int index = indices[static_cast<std::size_t>(k)];
        const double theta = GetAngle(index);
        const LobeQuadrature quadrature(
          brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), Cells);
        View& view = this->Views[static_cast<std::size_t>(index)];
        view.Means = KernelMeans(quadrature);
        for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
        {
          view.Cells.push_back(
            { LobeQuadrature::GetEnergy(cell, view.Means.Floor), cell.SolidAngle });
        }
      }
    });
}

// Cubic, after Lagrange, through the four known ones about it.
KernelMeans KernelViews::Interpolate(const std::vector<int>& known, int index) const
{
  const int count = static_cast<int>(known.size());
  const int above =
    static_cast<int>(std::lower_bound(known.begin(), known.end(), index) - known.begin());
  const int first = std::clamp(above - 2, 0, count - 4);
  KernelMeans sum;
  for (int k = first; k < first + 4; ++k)
  {
    const int at = known[static_cast<std::size_t>(k)];
    double weight = 1.0;
    for (int other = first; other < first + 4; ++other)
    {
      const int node = known[static_cast<std::size_t>(other)];
      weight *= other == k ? 1.0 : static_cast<double>(index - node) / (at - node);
    }
    sum.Add(this->Views[static_cast<std::size_t>(at)].Means, weight);
  }
  sum.Clamp();
  return sum;
}

KernelCut::KernelCut(vtkBRDF* brdf, double solidAngle)
  : KernelCut(KernelViews(brdf), solidAngle)
{
}

KernelCut::KernelCut(const KernelViews& views, double solidAngle)
{
  std::size_t known = 0; // the last view that has cells
  for (const KernelViews::View& view : views.GetViews())
  {
    this->Views.push_back({ view.Means.Floor, 0.0, 0.0 });
    if (view.Cells.empty())
    {
      continue;
    }
    double energy = 0.0;
    for (const KernelViews::Cell& cell : view.Cells)
    {
      energy += cell.Energy;
    }
    View& cut = this->Views.back();
    cut.Height = energy / solidAngle;
    double above = 0.0;
    for (const KernelViews::Cell& cell : view.Cells)
    {
      above += std::max(cell.Energy - cut.Height * cell.SolidAngle, 0.0);
    }
    cut.Share = view.Means.Albedo > 0.0 ? above / view.Means.Albedo : 0.0;
    this->SharpShare = std::max(this->SharpShare, cut.Share);
    const std::size_t last = this->Views.size() - 1;
    for (std::size_t k = known + 1; k < last; ++k)
    {
      const double t = static_cast<double>(k - known) / static_cast<double>(last - known);
      this->Views[k].Height = glm::mix(this->Views[known].Height, cut.Height, t);
      this->Views[k].Share = glm::mix(this->Views[known].Share, cut.Share, t);
    }
    known = last;
  }
}

KernelCut::View KernelCut::GetView(const glm::dvec3& o) const
{
  const double at = KernelViews::GetPosition(std::atan2(std::hypot(o.x, o.y), o.z));
  const int low = std::clamp(static_cast<int>(at), 0, KernelViews::NumberOfViews - 2);
  const double t = std::min(at - low, 1.0);
  const View& a = this->Views[static_cast<std::size_t>(low)];
  const View& b = this->Views[static_cast<std::size_t>(low) + 1];
  return { glm::mix(a.Floor, b.Floor, t), glm::mix(a.Height, b.Height, t),
    glm::mix(a.Share, b.Share, t) };
}

glm::dvec3 KernelCut::View::GetBroad(const glm::dvec3& f, double cosine) const
{
  const glm::dvec3 floor = glm::min(this->Floor, f);
  const double rest = GetSum(f - floor) * cosine;
  return rest > this->Height ? floor + (f - floor) * (this->Height / rest) : f;
}

vtkStandardNewMacro(KernelLayer);

void KernelLayer::Set(vtkBRDF* brdf, const std::shared_ptr<KernelCut>& cut, bool sharp)
{
  this->Whole = brdf;
  this->Cut = cut;
  this->Sharp = sharp;
  this->Modified();
}

void KernelLayer::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  const glm::dvec3 sum = LobeQuadrature(this, glm::dvec3(o[0], o[1], o[2]), Cells).GetAlbedo();
  std::copy_n(&sum.x, 3, albedo);
}

void KernelLayer::GetBounds(double minimumCosine, double lower[3], double upper[3])
{
  this->Whole->GetBounds(minimumCosine, lower, upper);
  std::fill(lower, lower + 3, 0.0);
}

void KernelLayer::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  glm::dvec3 whole;
  EvaluateTerm(this->Whole, i, o, &whole.x);
  const glm::dvec3 broad = this->Cut->GetView(glm::dvec3(o[0], o[1], o[2])).GetBroad(whole, i[2]);
  for (int c = 0; c < 3; ++c)
  {
    f[c] = this->Sharp ? whole[c] - broad[c] : broad[c];
  }
}

bool KernelLayer::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  return this->Whole->Sample(o, u1, u2, i);
}

double KernelLayer::PdfAbove(const double i[3], const double o[3])
{
  return this->Whole->Pdf(i, o);
}
} // namespace measuredbrdf
