// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StandInBRDF.h"

#include "vtkObjectFactory.h"

namespace measuredbrdf
{
vtkStandardNewMacro(StandInBRDF);

vtkSmartPointer<vtkBRDF> StandInBRDF::Make(vtkBRDF* material)
{
  auto made = vtkSmartPointer<StandInBRDF>::New();
  made->Material = material;
  made->Name = material->GetName();
  made->Source = material->GetSource();
  made->ResamplingTolerance = material->GetResamplingTolerance();
  return made;
}

vtkBRDF* StandInBRDF::GetRenderable()
{
  if (!this->Quick)
  {
    this->Quick = vtkSmartPointer<vtkBRDF>::Take(this->Material->NewQuickRenderable());
  }
  return this->Quick;
}

void StandInBRDF::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  this->GetRenderable()->GetShaderInputs(form);
}

void StandInBRDF::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  this->Material->GetDirectionalAlbedo(o, albedo);
}

void StandInBRDF::GetBounds(double minimumCosine, double lower[3], double upper[3])
{
  this->Material->GetBounds(minimumCosine, lower, upper);
}

void StandInBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  EvaluateTerm(this->Material, i, o, f);
}

void StandInBRDF::EvaluateSoftAbove(
  const double i[3], const double o[3], double spread, double f[3])
{
  EvaluateSoftTerm(this->Material, i, o, spread, f);
}

bool StandInBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  return this->Material->Sample(o, u1, u2, i);
}

double StandInBRDF::PdfAbove(const double i[3], const double o[3])
{
  return this->Material->Pdf(i, o);
}
} // namespace measuredbrdf
