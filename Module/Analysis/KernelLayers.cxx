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

namespace measuredbrdf
{
namespace
{
constexpr int Cells = 512; // of a view's quadrature

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
  vtkSMPTools::For(0, NumberOfViews, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        const double theta = GetAngle(static_cast<int>(k));
        const LobeQuadrature quadrature(
          brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), Cells);
        View& view = this->Views[static_cast<std::size_t>(k)];
        view.Means = KernelMeans(quadrature);
        for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
        {
          view.Cells.push_back(
            { LobeQuadrature::GetEnergy(cell, view.Means.Floor), cell.SolidAngle });
        }
      }
    });
}

KernelCut::KernelCut(vtkBRDF* brdf, double solidAngle)
  : KernelCut(KernelViews(brdf), solidAngle)
{
}

KernelCut::KernelCut(const KernelViews& views, double solidAngle)
{
  for (const KernelViews::View& view : views.GetViews())
  {
    double energy = 0.0;
    for (const KernelViews::Cell& cell : view.Cells)
    {
      energy += cell.Energy;
    }
    const double height = energy / solidAngle;
    double above = 0.0;
    for (const KernelViews::Cell& cell : view.Cells)
    {
      above += std::max(cell.Energy - height * cell.SolidAngle, 0.0);
    }
    const double share = view.Means.Albedo > 0.0 ? above / view.Means.Albedo : 0.0;
    this->Views.push_back({ view.Means.Floor, height, share });
    this->SharpShare = std::max(this->SharpShare, share);
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
