// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobePart.h"

#include "LobeQuadrature.h"
#include "vtkObjectFactory.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
constexpr int Cells = 512; // of a view's quadrature
}

vtkStandardNewMacro(LobePart);

void LobePart::Set(vtkBRDF* brdf, const std::shared_ptr<LobeSplit>& cut, bool sharp)
{
  this->Whole = brdf;
  this->Cut = cut;
  this->Sharp = sharp;
  this->Modified();
}

void LobePart::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  const glm::dvec3 sum = LobeQuadrature(this, glm::dvec3(o[0], o[1], o[2]), Cells).GetAlbedo();
  std::copy_n(&sum.x, 3, albedo);
}

void LobePart::GetBounds(double minimumCosine, double lower[3], double upper[3])
{
  this->Whole->GetBounds(minimumCosine, lower, upper);
  std::fill(lower, lower + 3, 0.0);
}

void LobePart::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  glm::dvec3 whole;
  EvaluateTerm(this->Whole, i, o, &whole.x);
  const glm::dvec3 broad = this->Cut->GetView(glm::dvec3(o[0], o[1], o[2])).GetBroad(whole, i[2]);
  for (int c = 0; c < 3; ++c)
  {
    f[c] = this->Sharp ? whole[c] - broad[c] : broad[c];
  }
}

bool LobePart::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  return this->Whole->Sample(o, u1, u2, i);
}

double LobePart::PdfAbove(const double i[3], const double o[3]) { return this->Whole->Pdf(i, o); }
} // namespace measuredbrdf
