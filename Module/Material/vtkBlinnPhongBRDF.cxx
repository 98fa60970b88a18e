// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBlinnPhongBRDF.h"

#include "HalfVector.h"
#include "ModuleShader.h"
#include "Setters.h"
#include "vtkBRDFBlinnPhong.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBlinnPhongBRDF);

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBlinnPhongBRDF, Exponent, double, 0.0, 1e6);
measuredbrdfSetFinite3Macro(vtkBlinnPhongBRDF, Specular);

//------------------------------------------------------------------------------
void vtkBlinnPhongBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  this->EvaluateSoftAbove(i, o, 0.0, f);
}

//------------------------------------------------------------------------------
void vtkBlinnPhongBRDF::EvaluateSoftAbove(
  const double i[3], const double o[3], double spread, double f[3])
{
  const glm::dvec3 view = glm::make_vec3(o);
  const glm::dvec3 h = HalfVector(glm::make_vec3(i), view);
  const double s = h.x * h.x + h.y * h.y;
  const double n = WidenedExponent(this->Exponent, HalfVectorSpread(spread, glm::dot(h, view)));
  const double lobe = (n + 2.0) / (2.0 * Pi) * PowerCosine(n, s);
  std::transform(this->Specular, this->Specular + 3, f, [lobe](double k) { return k * lobe; });
}

//------------------------------------------------------------------------------
bool vtkBlinnPhongBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  const double c = std::pow(1.0 - u1, 1.0 / (this->Exponent + 1.0));
  const double s = std::sqrt(std::max(1.0 - c * c, 0.0));
  const double phi = 2.0 * Pi * u2;
  const glm::dvec3 h(s * std::cos(phi), s * std::sin(phi), c);
  const glm::dvec3 direction = ReflectAbout(glm::make_vec3(o), h);
  std::copy_n(glm::value_ptr(direction), 3, i);
  return direction.z > 0.0;
}

//------------------------------------------------------------------------------
double vtkBlinnPhongBRDF::PdfAbove(const double i[3], const double o[3])
{
  const glm::dvec3 view = glm::make_vec3(o);
  const glm::dvec3 h = HalfVector(glm::make_vec3(i), view);
  const double s = h.x * h.x + h.y * h.y;
  return (this->Exponent + 1.0) / (2.0 * Pi) * PowerCosine(this->Exponent, s) /
         (4.0 * glm::dot(view, h));
}

//------------------------------------------------------------------------------
void vtkBlinnPhongBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFBlinnPhong", vtkBRDFBlinnPhong);
  const glm::dvec3 specular = glm::make_vec3(this->Specular);
  term.Uniforms = { MakeTriple("brdfScale", specular * (this->Exponent + 2.0) / (2.0 * Pi)),
    { "brdfExponent", { static_cast<float>(this->Exponent) } } };
  inputs.Terms.push_back(term);
  inputs.Description = "Blinn-Phong, closed form";
}

//------------------------------------------------------------------------------
void vtkBlinnPhongBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  exchange.Triple(
    "specular", this->Specular, [this](const double* value) { this->SetSpecular(value); });
  exchange.Number("exponent", this->Exponent, [this](double value) { this->SetExponent(value); });
}

//------------------------------------------------------------------------------
vtkBRDF* vtkBlinnPhongBRDF::NewCopy()
{
  vtkBlinnPhongBRDF* copy = vtkBlinnPhongBRDF::New();
  std::copy_n(this->Specular, 3, copy->Specular);
  copy->Exponent = this->Exponent;
  return copy;
}
