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
constexpr int NumberOfViews = 64;
constexpr int Cells = 256;           // of a view's quadrature
constexpr double FloorCosine = 0.17; // as tables take their Lambert part

double GetSum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }

// The last view is the lowest that shaders take.
const double LastView = std::acos(MinimumViewCosine);
}

KernelCut::KernelCut(vtkBRDF* brdf, double solidAngle)
  : Views(NumberOfViews)
{
  std::vector<double> shares(NumberOfViews, 0.0);
  vtkSMPTools::For(0, NumberOfViews, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType view = begin; view < end; ++view)
      {
        const double theta = LastView * static_cast<double>(view) / (NumberOfViews - 1);
        const LobeQuadrature quadrature(
          brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), Cells);
        const glm::dvec3 floor = glm::max(quadrature.GetFloor(FloorCosine), glm::dvec3(0.0));
        double energy = 0.0;
        for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
        {
          energy += std::max(GetSum(cell.Weight - floor * cell.Cosine), 0.0);
        }
        const double height = energy / solidAngle;
        double above = 0.0;
        for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
        {
          above +=
            std::max(GetSum(cell.Weight - floor * cell.Cosine) - height * cell.SolidAngle, 0.0);
        }
        const double albedo = GetSum(quadrature.GetAlbedo());
        this->Views[static_cast<std::size_t>(view)] = { floor, height };
        shares[static_cast<std::size_t>(view)] = albedo > 0.0 ? above / albedo : 0.0;
      }
    });
  this->SharpShare = *std::max_element(shares.begin(), shares.end());
}

glm::dvec3 KernelCut::GetBroad(const glm::dvec3& f, const glm::dvec3& i, const glm::dvec3& o) const
{
  const double at = std::atan2(std::hypot(o.x, o.y), o.z) / LastView * (NumberOfViews - 1);
  const int low = std::clamp(static_cast<int>(at), 0, NumberOfViews - 2);
  const double t = std::min(at - low, 1.0);
  const View& a = this->Views[static_cast<std::size_t>(low)];
  const View& b = this->Views[static_cast<std::size_t>(low) + 1];
  const double height = glm::mix(a.Height, b.Height, t);
  const glm::dvec3 floor = glm::min(glm::mix(a.Floor, b.Floor, t), f);
  const double rest = GetSum(f - floor) * i.z;
  return rest > height ? floor + (f - floor) * (height / rest) : f;
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
  this->Whole->Evaluate(i, o, &whole.x);
  const glm::dvec3 broad =
    this->Cut->GetBroad(whole, glm::dvec3(i[0], i[1], i[2]), glm::dvec3(o[0], o[1], o[2]));
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
