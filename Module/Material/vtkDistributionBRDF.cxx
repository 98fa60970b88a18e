// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDistributionBRDF.h"

#include "Floats.h"
#include "HalfVector.h"
#include "ModuleShader.h"
#include "Neighbors.h"
#include "Refusal.h"
#include "VolumeInterpolation.h"
#include "vtkBRDFDistribution.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkDistributionBRDF);

namespace
{
// Variance of the Blinn lobe with p's ratio of peak to projected integral: (n+2)/2pi for cos^n.
double FindBlinnVariance(int nTheta, const std::vector<float>& p)
{
  double integral = 0.0;
  double peak = 0.0;
  for (int k = 0; k < nTheta; ++k)
  {
    const double value = static_cast<double>(p[3 * k]) + p[3 * k + 1] + p[3 * k + 2];
    const double low = std::sin(UnitToThetaH(static_cast<double>(k) / nTheta));
    const double high = std::sin(UnitToThetaH((k + 1.0) / nTheta));
    integral += value * Pi * (high * high - low * low);
    peak = std::max(peak, value);
  }
  const double exponent = integral > 0.0 ? 2.0 * Pi * peak / integral - 2.0 : 1.0;
  return 1.0 / std::clamp(exponent, 1.0, 1e6);
}

glm::dvec3 GetColor(const std::vector<float>& rgb, int k)
{
  return glm::dvec3(glm::make_vec3(&rgb[3 * static_cast<std::size_t>(k)]));
}

constexpr int MostSamples = 16384; // of a side

// Takes a table of so many samples where it is one; clears rounding noise below 0.
void TakeTable(const std::vector<float>& rgb, std::size_t samples, std::vector<float>& table)
{
  std::vector<float> values = rgb;
  Require(values.size() == 3 * samples, "found " + std::to_string(rgb.size()) + " values for " +
                                          std::to_string(samples) + " samples, expected 3 each");
  RequireFinite(values, "values");
  Require(ClearNoise(values), "found a negative value, expected none");
  table = std::move(values);
}

void CheckSide(int samples)
{
  Require(samples >= 1 && samples <= MostSamples, "found " + std::to_string(samples) +
                                                    " samples along a side, expected 1 to " +
                                                    std::to_string(MostSamples));
}
}

//------------------------------------------------------------------------------
vtkDistributionBRDF::vtkDistributionBRDF()
{
  this->SetBlinnDistribution(50.0);
  const double f0[3] = { 0.04, 0.04, 0.04 };
  this->SetSchlickFresnel(f0);
}

//------------------------------------------------------------------------------
bool vtkDistributionBRDF::SetDistribution(int nTheta, int nPhi, const std::vector<float>& rgb)
{
  const std::string problem = FindProblemOf(
    [&]()
    {
      CheckSide(nTheta);
      CheckSide(nPhi);
      TakeTable(rgb, static_cast<std::size_t>(nTheta) * nPhi, this->Distribution);
    });
  if (!problem.empty())
  {
    vtkErrorMacro("SetDistribution: " << problem << "; p stays.");
    return false;
  }
  this->NumberOfTheta = nTheta;
  this->NumberOfPhi = nPhi;
  this->OwnVariance = nPhi == 1 ? FindBlinnVariance(nTheta, this->Distribution) : 0.0;
  this->ResetLobe();
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkDistributionBRDF::SetFresnel(int n, const std::vector<float>& rgb)
{
  const std::string problem = FindProblemOf(
    [&]()
    {
      CheckSide(n);
      TakeTable(rgb, static_cast<std::size_t>(n), this->Fresnel);
    });
  if (!problem.empty())
  {
    vtkErrorMacro("SetFresnel: " << problem << "; F stays.");
    return false;
  }
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
void vtkDistributionBRDF::SetBlinnDistribution(double exponent)
{
  if (!(exponent >= 0.0 && exponent <= 1e6))
  {
    vtkErrorMacro(
      "SetBlinnDistribution: found " << exponent << ", expected a number from 0 to 1e6; p stays.");
    return;
  }
  constexpr int n = 256;
  std::vector<float> rgb;
  for (int k = 0; k < n; ++k)
  {
    const double s = std::sin(UnitToThetaH((k + 0.5) / n));
    const double p = (exponent + 2.0) / (2.0 * Pi) * PowerCosine(exponent, s * s);
    rgb.insert(rgb.end(), 3, static_cast<float>(p));
  }
  this->SetDistribution(n, 1, rgb);
}

//------------------------------------------------------------------------------
void vtkDistributionBRDF::SetSchlickFresnel(const double f0[3])
{
  if (!std::all_of(f0, f0 + 3, [](double f) { return f >= 0.0 && f <= 1.0; }))
  {
    vtkErrorMacro("SetSchlickFresnel: found " << f0[0] << ", " << f0[1] << ", " << f0[2]
                                              << ", expected numbers from 0 to 1; F stays.");
    return;
  }
  constexpr int n = 64;
  std::vector<float> rgb;
  for (int k = 0; k < n; ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      rgb.push_back(static_cast<float>(SchlickFresnel(f0[c], std::cos(0.5 * Pi * (k + 0.5) / n))));
    }
  }
  this->SetFresnel(n, rgb);
}

//------------------------------------------------------------------------------
void vtkDistributionBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  this->EvaluateSoftAbove(i, o, 0.0, f);
}

//------------------------------------------------------------------------------
void vtkDistributionBRDF::EvaluateSoftAbove(
  const double i[3], const double o[3], double spread, double f[3])
{
  const glm::dvec3 light = glm::make_vec3(i);
  const glm::dvec3 view = glm::make_vec3(o);
  const HalfDifference angles = ToHalfDifference(light, view);
  const glm::dvec3 h = HalfVector(light, view);
  // The lobe with the light's variance in addition is as much wider, and lower, as Blinn's of such
  // variances are.
  const double variance = HalfVectorSpread(spread, glm::dot(h, view));
  const bool soft = spread > 0.0 && this->OwnVariance > 0.0;
  const double share = soft ? this->OwnVariance / (this->OwnVariance + variance) : 1.0;
  const double height =
    soft ? (share + 2.0 * this->OwnVariance) / (1.0 + 2.0 * this->OwnVariance) : 1.0;
  const Neighbors t =
    ClampedNeighbors(ThetaHToUnit(angles.ThetaH * std::sqrt(share)), this->NumberOfTheta);
  const Neighbors p = PeriodicNeighbors(std::atan2(h.y, h.x) / (2.0 * Pi), this->NumberOfPhi);
  const Neighbors d =
    ClampedNeighbors(angles.ThetaD * (2.0 / Pi), static_cast<int>(this->Fresnel.size() / 3));
  const double g = 4.0 * (light.z + view.z - light.z * view.z);
  const auto at = [this](int theta, int row)
  { return GetColor(this->Distribution, row * this->NumberOfTheta + theta); };
  const glm::dvec3 p0 = glm::mix(at(t.First, p.First), at(t.Second, p.First), t.Weight);
  const glm::dvec3 p1 = glm::mix(at(t.First, p.Second), at(t.Second, p.Second), t.Weight);
  const glm::dvec3 fresnel =
    glm::mix(GetColor(this->Fresnel, d.First), GetColor(this->Fresnel, d.Second), d.Weight);
  const glm::dvec3 value = glm::mix(p0, p1, p.Weight) * fresnel * (height / g);
  std::copy_n(&value.x, 3, f);
}

//------------------------------------------------------------------------------
void vtkDistributionBRDF::Prepare()
{
  if (this->HasLobe())
  {
    return;
  }
  std::vector<double> weights;
  for (std::size_t k = 0; k < this->Distribution.size(); k += 3)
  {
    const int theta = static_cast<int>(k / 3) % this->NumberOfTheta;
    const double cosine = std::cos(UnitToThetaH((theta + 0.5) / this->NumberOfTheta));
    weights.push_back(
      cosine * (this->Distribution[k] + this->Distribution[k + 1] + this->Distribution[k + 2]));
  }
  this->SetLobe(this->NumberOfTheta, this->NumberOfPhi, 0.75, weights);
}

//------------------------------------------------------------------------------
void vtkDistributionBRDF::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFDistribution", vtkBRDFDistribution);
  vtkBRDFShaderInputs::Texture p;
  p.Name = "brdfDistribution";
  p.Dimensions = { this->NumberOfTheta, this->NumberOfPhi, 1 };
  p.Repeat = { false, true, false };
  p.Data = this->Distribution;
  term.Uniforms.push_back({ "brdfOwnVariance", { static_cast<float>(this->OwnVariance) } });
  vtkBRDFShaderInputs::Texture fresnel;
  fresnel.Name = "brdfFresnel";
  fresnel.Dimensions = { static_cast<int>(this->Fresnel.size() / 3), 1, 1 };
  fresnel.Data = this->Fresnel;
  term.Textures = { p, fresnel };
  term.Fetches = 2;
  form.Terms.push_back(term);
  form.QuantizationError = std::max(form.QuantizationError, 0x1p-23);
  form.Description = "D-BRDF, tables of " + std::to_string(this->NumberOfTheta) + " x " +
                     std::to_string(this->NumberOfPhi) + " and " +
                     std::to_string(this->Fresnel.size() / 3) + " samples, 32-bit";
}

//------------------------------------------------------------------------------
void vtkDistributionBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  if (!exchange.IsLoading())
  {
    exchange.SaveArray(
      "distribution", { this->NumberOfPhi, this->NumberOfTheta }, 3, this->Distribution);
    exchange.SaveArray("fresnel", { static_cast<int>(this->Fresnel.size() / 3) }, 3, this->Fresnel);
    return;
  }
  const auto distribution = exchange.LoadArray("distribution", 2, 3);
  const auto fresnel = exchange.LoadArray("fresnel", 1, 3);
  exchange.Check(
    this->SetDistribution(distribution.Shape[1], distribution.Shape[0], distribution.Values)
      ? ""
      : "array 'distribution' was refused: negative or not finite");
  exchange.Check(this->SetFresnel(fresnel.Shape[0], fresnel.Values)
                   ? ""
                   : "array 'fresnel' was refused: negative or not finite");
}

//------------------------------------------------------------------------------
vtkBRDF* vtkDistributionBRDF::NewCopy()
{
  vtkDistributionBRDF* copy = vtkDistributionBRDF::New();
  copy->NumberOfTheta = this->NumberOfTheta;
  copy->NumberOfPhi = this->NumberOfPhi;
  copy->Distribution = this->Distribution;
  copy->Fresnel = this->Fresnel;
  copy->OwnVariance = this->OwnVariance;
  return copy;
}
