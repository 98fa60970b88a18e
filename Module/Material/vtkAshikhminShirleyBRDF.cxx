// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAshikhminShirleyBRDF.h"

#include "Floats.h"
#include "HalfVector.h"
#include "LaneMath.h"
#include "ModuleShader.h"
#include "Setters.h"
#include "vtkBRDFAshikhminShirley.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkAshikhminShirleyBRDF);

namespace
{
// (n.h)^e with e = (nu hx^2 + nv hy^2)/(1 - hz^2), without the division at the normal.
double GetLobe(double nu, double nv, const glm::dvec3& h)
{
  const double s = h.x * h.x + h.y * h.y;
  return std::exp(0.5 * (nu * h.x * h.x + nv * h.y * h.y) * LogCosineRatio(s));
}

double DiffuseFactor(double c)
{
  const double m = 1.0 - 0.5 * c;
  return 1.0 - m * m * m * m * m;
}

constexpr double DiffuseScale = 28.0 / (23.0 * Pi);

// 1 - (1 - c/2)^5, without a difference that loses digits at the horizon.
template <typename Number>
MEASUREDBRDF_INLINE Number DiffuseFactorInLanes(Number cosine)
{
  const Number x = 0.5f * cosine;
  return x * (5.0f - x * (10.0f - x * (10.0f - x * (5.0f - x))));
}

// Of the lobe, without Fresnel and the cosines.
double GetPeak(double nu, double nv) { return std::sqrt((nu + 1.0) * (nv + 1.0)) / (8.0 * Pi); }
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkAshikhminShirleyBRDF, ExponentU, double, 0.0, 1e6);
measuredbrdfSetClampedMacro(vtkAshikhminShirleyBRDF, ExponentV, double, 0.0, 1e6);
measuredbrdfSetInRangeMacro(vtkAshikhminShirleyBRDF, FresnelModel, int, SCHLICK, DIELECTRIC);
measuredbrdfSetClampedMacro(vtkAshikhminShirleyBRDF, IndexOfRefraction, double, 1.0, 100.0);
measuredbrdfSetFinite3Macro(vtkAshikhminShirleyBRDF, SpecularScale);
measuredbrdfSetFinite3Macro(vtkAshikhminShirleyBRDF, Reflectance);
measuredbrdfSetFinite3Macro(vtkAshikhminShirleyBRDF, Diffuse);

//------------------------------------------------------------------------------
void vtkAshikhminShirleyBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  this->EvaluateSoftAbove(i, o, 0.0, f);
}

//------------------------------------------------------------------------------
void vtkAshikhminShirleyBRDF::EvaluateSoftAbove(
  const double i[3], const double o[3], double spread, double f[3])
{
  const glm::dvec3 light = glm::make_vec3(i);
  const glm::dvec3 view = glm::make_vec3(o);
  const glm::dvec3 h = HalfVector(light, view);
  const double hd = glm::dot(h, view);
  const double variance = HalfVectorSpread(spread, hd);
  const double nu = WidenedExponent(this->ExponentU, variance);
  const double nv = WidenedExponent(this->ExponentV, variance);
  const double specular = GetPeak(nu, nv) * GetLobe(nu, nv, h) / (hd * std::max(light.z, view.z));
  const double diffuse = DiffuseScale * DiffuseFactor(light.z) * DiffuseFactor(view.z);
  for (int c = 0; c < 3; ++c)
  {
    f[c] = this->SpecularScale[c] * specular * this->GetFresnel(c, hd) +
           diffuse * this->Diffuse[c] * (1.0 - this->Reflectance[c]);
  }
}

//------------------------------------------------------------------------------
void vtkAshikhminShirleyBRDF::EvaluateLights(
  int count, const float* const i[3], const double o[3], float* const f[3])
{
  const float exponents[2] = { ToFloat(this->ExponentU), ToFloat(this->ExponentV) };
  const float index = this->FresnelModel == SCHLICK ? 0.0f : ToFloat(this->IndexOfRefraction);
  const double peak = GetPeak(this->ExponentU, this->ExponentV);
  const auto viewCosine = static_cast<float>(o[2]);
  float specular[3], reflectance[3], diffuse[3];
  for (int c = 0; c < 3; ++c)
  {
    specular[c] = ToFloat(this->SpecularScale[c] * peak);
    reflectance[c] = ToFloat(this->Reflectance[c]);
    diffuse[c] = ToFloat(DiffuseScale * this->Diffuse[c] * (1.0 - this->Reflectance[c])) *
                 DiffuseFactorInLanes(viewCosine);
  }
  struct State : LaneState
  {
    LaneDirections Half;
    Floats Cosine; // of theta_d
  };
  EvaluateLanes<State>(
    count, i, f,
    [&](State& s) MEASUREDBRDF_INLINED { s.Half = FindHalf(s.Light, FillDirections(o), s.Cosine); },
    [&](State& s) MEASUREDBRDF_INLINED
    {
      const LaneDirections& h = s.Half;
      const Floats cosine = s.Cosine;
      const Floats xSquare = h.X * h.X;
      const Floats ySquare = h.Y * h.Y;
      const Floats ratio = FindLogCosineRatio(h.Z, Smaller(xSquare + ySquare, Fill(1.0f)));
      const Floats lobe =
        FindExp(0.5f * (exponents[0] * xSquare + exponents[1] * ySquare) * ratio) /
        (cosine * Larger(s.Light.Z, Fill(viewCosine)));
      const Floats spread = DiffuseFactorInLanes(s.Light.Z);
      const Floats rest = Larger(1.0f - cosine, Floats{});
      const Floats fifth = rest * rest * rest * rest * rest;
      Floats dielectric{};
      if (index > 0.0f)
      {
        const Floats square = cosine * cosine + (index * index - 1.0f);
        const Floats g = SquareRoot(Larger(square, Floats{}));
        const Floats a = (g - cosine) / (g + cosine);
        const Floats b = (cosine * (g + cosine) - 1.0f) / (cosine * (g - cosine) + 1.0f);
        dielectric = 0.5f * a * a * (1.0f + b * b);
      }
      for (int c = 0; c < 3; ++c)
      {
        const Floats fresnel =
          index > 0.0f ? dielectric : reflectance[c] + (1.0f - reflectance[c]) * fifth;
        s.Color[c] = specular[c] * lobe * fresnel + diffuse[c] * spread;
      }
    });
}

//------------------------------------------------------------------------------
double vtkAshikhminShirleyBRDF::GetFresnel(int channel, double cosine) const
{
  return this->FresnelModel == SCHLICK ? SchlickFresnel(this->Reflectance[channel], cosine)
                                       : DielectricFresnel(this->IndexOfRefraction, cosine);
}

//------------------------------------------------------------------------------
double vtkAshikhminShirleyBRDF::GetSpecularProbability() const
{
  double specular = 0.0;
  double diffuse = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    specular += std::max(this->SpecularScale[c], 0.0) * this->GetFresnel(c, 1.0);
    diffuse += std::max(this->Diffuse[c] * (1.0 - this->Reflectance[c]), 0.0);
  }
  // The specular part grows towards grazing: never less than a quarter of the draws.
  return diffuse > 0.0 ? std::max(specular / (specular + diffuse), 0.25) : 1.0;
}

//------------------------------------------------------------------------------
bool vtkAshikhminShirleyBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  const double probability = this->GetSpecularProbability();
  if (u1 >= probability)
  {
    return this->Superclass::SampleAbove(o, (u1 - probability) / (1.0 - probability), u2, i);
  }
  u1 /= probability;
  // Azimuth: the paper's first quadrant, repeated around.
  const double quadrant = std::floor(4.0 * u2);
  const double first = std::atan(
    std::sqrt((this->ExponentU + 1.0) / (this->ExponentV + 1.0)) *
    std::tan(
      0.5 * Pi *
      (static_cast<int>(quadrant) % 2 == 0 ? 4.0 * u2 - quadrant : 1.0 - (4.0 * u2 - quadrant))));
  const double x = (quadrant == 1.0 || quadrant == 2.0 ? -1.0 : 1.0) * std::cos(first);
  const double y = (quadrant >= 2.0 ? -1.0 : 1.0) * std::sin(first);
  const double c =
    std::pow(1.0 - u1, 1.0 / (this->ExponentU * x * x + this->ExponentV * y * y + 1.0));
  const double s = std::sqrt(std::max(1.0 - c * c, 0.0));
  const glm::dvec3 direction = ReflectAbout(glm::make_vec3(o), glm::dvec3(s * x, s * y, c));
  std::copy_n(glm::value_ptr(direction), 3, i);
  return direction.z > 0.0;
}

//------------------------------------------------------------------------------
double vtkAshikhminShirleyBRDF::PdfAbove(const double i[3], const double o[3])
{
  const glm::dvec3 view = glm::make_vec3(o);
  const glm::dvec3 h = HalfVector(glm::make_vec3(i), view);
  const double half = std::sqrt((this->ExponentU + 1.0) * (this->ExponentV + 1.0)) / (2.0 * Pi) *
                      GetLobe(this->ExponentU, this->ExponentV, h);
  const double probability = this->GetSpecularProbability();
  return probability * half / (4.0 * glm::dot(h, view)) +
         (1.0 - probability) * this->Superclass::PdfAbove(i, o);
}

//------------------------------------------------------------------------------
void vtkAshikhminShirleyBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFAshikhminShirley", vtkBRDFAshikhminShirley);
  const double peak = GetPeak(this->ExponentU, this->ExponentV);
  const glm::dvec3 reflectance = glm::make_vec3(this->Reflectance);
  // An index of 0 selects Schlick: a dielectric has an index of at least 1.
  const double index = this->FresnelModel == SCHLICK ? 0.0 : this->IndexOfRefraction;
  term.Uniforms = { MakeTriple("brdfScale", peak * glm::make_vec3(this->SpecularScale)),
    MakeTriple("brdfReflectance", reflectance),
    MakeTriple("brdfDiffuse", DiffuseScale * glm::make_vec3(this->Diffuse) * (1.0 - reflectance)),
    MakeTriple("brdfExponents", { this->ExponentU, this->ExponentV, 0.0 }),
    { "brdfIndex", { static_cast<float>(index) } } };
  inputs.Terms.push_back(term);
  inputs.Description = "Ashikhmin-Shirley, closed form";
}

//------------------------------------------------------------------------------
void vtkAshikhminShirleyBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  exchange.Triple("specularScale", this->SpecularScale,
    [this](const double* value) { this->SetSpecularScale(value); });
  exchange.Triple(
    "reflectance", this->Reflectance, [this](const double* value) { this->SetReflectance(value); });
  exchange.Triple(
    "diffuse", this->Diffuse, [this](const double* value) { this->SetDiffuse(value); });
  exchange.Number(
    "exponentU", this->ExponentU, [this](double value) { this->SetExponentU(value); });
  exchange.Number(
    "exponentV", this->ExponentV, [this](double value) { this->SetExponentV(value); });
  exchange.Option("fresnelModel", { "schlick", "dielectric" }, this->FresnelModel,
    [this](int value) { this->SetFresnelModel(value); });
  exchange.Number("indexOfRefraction", this->IndexOfRefraction,
    [this](double value) { this->SetIndexOfRefraction(value); });
}

//------------------------------------------------------------------------------
vtkBRDF* vtkAshikhminShirleyBRDF::NewCopy()
{
  vtkAshikhminShirleyBRDF* copy = vtkAshikhminShirleyBRDF::New();
  std::copy_n(this->SpecularScale, 3, copy->SpecularScale);
  std::copy_n(this->Reflectance, 3, copy->Reflectance);
  std::copy_n(this->Diffuse, 3, copy->Diffuse);
  copy->ExponentU = this->ExponentU;
  copy->ExponentV = this->ExponentV;
  copy->FresnelModel = this->FresnelModel;
  copy->IndexOfRefraction = this->IndexOfRefraction;
  return copy;
}
