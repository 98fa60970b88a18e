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

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

vtkStandardNewMacro(vtkLambertBRDF);

//------------------------------------------------------------------------------
measuredbrdfSetFinite3Macro(vtkLambertBRDF, Albedo);

//------------------------------------------------------------------------------
void vtkLambertBRDF::EvaluateAbove(
  const double vtkNotUsed(i)[3], const double vtkNotUsed(o)[3], double f[3])
{
  std::transform(
    this->Albedo, this->Albedo + 3, f, [](double albedo) { return albedo / measuredbrdf::Pi; });
}

//------------------------------------------------------------------------------
void vtkLambertBRDF::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  const double up[3] = { 0.0, 0.0, 1.0 };
  this->Evaluate(up, o, albedo);
  std::for_each(albedo, albedo + 3, [](double& value) { value *= measuredbrdf::Pi; });
}

//------------------------------------------------------------------------------
void vtkLambertBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFLambert", vtkBRDFLambert);
  term.Uniforms = { measuredbrdf::MakeTriple("brdfAlbedo", glm::make_vec3(this->Albedo)) };
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
