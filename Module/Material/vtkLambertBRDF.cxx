// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLambertBRDF.h"

#include "HalfVector.h"
#include "ModuleShader.h"
#include "Setters.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFLambert.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkLambertBRDF);

//------------------------------------------------------------------------------
measuredbrdfSetFinite3Macro(vtkLambertBRDF, Albedo);

//------------------------------------------------------------------------------
void vtkLambertBRDF::EvaluateAbove(
  const double vtkNotUsed(i)[3], const double vtkNotUsed(o)[3], double f[3])
{
  for (int c = 0; c < 3; ++c)
  {
    f[c] = this->Albedo[c] / measuredbrdf::Pi;
  }
}

//------------------------------------------------------------------------------
void vtkLambertBRDF::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  const double up[3] = { 0.0, 0.0, 1.0 };
  this->Evaluate(up, o, albedo);
  for (int c = 0; c < 3; ++c)
  {
    albedo[c] *= measuredbrdf::Pi;
  }
}

//------------------------------------------------------------------------------
void vtkLambertBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFLambert", vtkBRDFLambert);
  vtkBRDFShaderInputs::Uniform albedo{ "brdfAlbedo", {} };
  for (double a : this->Albedo)
  {
    albedo.Values.push_back(static_cast<float>(a));
  }
  term.Uniforms.push_back(albedo);
  inputs.Terms.push_back(term);
  inputs.Description = "Lambert, closed form";
}

//------------------------------------------------------------------------------
void vtkLambertBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  exchange.Triple("albedo", this->Albedo, [this](const double* value) { this->SetAlbedo(value); });
}

//------------------------------------------------------------------------------
vtkBRDF* vtkLambertBRDF::NewCopy()
{
  vtkLambertBRDF* copy = vtkLambertBRDF::New();
  std::copy_n(this->Albedo, 3, copy->Albedo);
  return copy;
}
