// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDistributionBRDF.h"

#include "Floats.h"
#include "HalfVector.h"
#include "ModuleShader.h"
#include "Neighbors.h"
#include "Refusal.h"
#include "VolumeInterpolation.h"
#include "ZonalKernel.h"
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
// Levels of larger tables are made at this many angles and interpolated: 24 x 256^2 weights.
constexpr int MaximumAngles = 256;

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
}

//------------------------------------------------------------------------------
/**
 * Level k of Count is p convolved on the sphere with a von Mises-Fisher distribution of variance
 * (1/kappa) s (r^(k/(Count - 1)) - 1), r = 1 + 1/s, s = p's own variance: from 0 to 1, in steps
 * that lower a lobe's peak by equal factors. Between levels: linear.
 */
struct vtkDistributionBRDF::Levels
{
  static constexpr int Count = 24;

  /// p at the nTheta table angles of vtkDistributionBRDF, RGB triples.
  Levels(int nTheta, const std::vector<float>& p)
    : OwnVariance(FindBlinnVariance(nTheta, p))
    , Rows(p)
  {
    // Rings of p at up to MaximumAngles angles.
    const int n = std::min(nTheta, MaximumAngles);
    std::vector<double> angles, widths;
    std::vector<glm::dvec3> values;
    for (int k = 0; k < n; ++k)
    {
      const double u = (k + 0.5) / n;
      angles.push_back(UnitToThetaH(u));
      widths.push_back(UnitToThetaH((k + 1.0) / n) - UnitToThetaH(static_cast<double>(k) / n));
      const Neighbors t = ClampedNeighbors(u, nTheta);
      values.push_back(glm::mix(GetColor(p, t.First), GetColor(p, t.Second), t.Weight));
    }
    std::vector<glm::dvec3> blurred(values.size());
    for (int level = 1; level < Count; ++level)
    {
      const double variance =
        this->OwnVariance * (std::pow(1.0 + 1.0 / this->OwnVariance, level / (Count - 1.0)) - 1.0);
      const double reach = GetRingReach(variance);
      for (int a = 0; a < n; ++a)
      {
        glm::dvec3 sum(0.0);
        double total = 0.0;
        const auto first = std::lower_bound(angles.begin(), angles.end(), angles[a] - reach);
        const auto last = std::upper_bound(angles.begin(), angles.end(), angles[a] + reach);
        for (auto it = first; it != last; ++it)
        {
          const std::ptrdiff_t b = it - angles.begin();
          const double weight = widths[b] * GetRingWeight(angles[a], *it, variance);
          sum += weight * values[b];
          total += weight;
        }
        blurred[a] = total > 0.0 ? sum / total : values[a];
      }
      for (int k = 0; k < nTheta; ++k)
      {
        const Neighbors t = ClampedNeighbors((k + 0.5) / nTheta, n);
        const glm::vec3 value(glm::mix(blurred[t.First], blurred[t.Second], t.Weight));
        this->Rows.insert(this->Rows.end(), { value.x, value.y, value.z });
      }
    }
  }

  /// The levels around a variance >= 0 in h.
  Neighbors Find(double variance) const
  {
    const double level =
      (Count - 1) *
      std::min(std::log1p(variance / this->OwnVariance) / std::log1p(1.0 / this->OwnVariance), 1.0);
    const int first = std::min(static_cast<int>(level), Count - 2);
    return { first, first + 1, level - first };
  }

  double OwnVariance;
  std::vector<float> Rows; // Count rows of nTheta RGB triples; row 0 is p itself
};

namespace
{
constexpr int MostSamples = 16384; // of a side

// Takes a table of that size; clears rounding noise below 0. Returns what is wrong with it, or "".
std::string TakeTable(int width, int height, std::vector<float> rgb, std::vector<float>& table)
{
  return FindProblemOf(
    [&]()
    {
      for (const int side : { width, height })
      {
        Require(side >= 1 && side <= MostSamples, "found " + std::to_string(side) +
                                                    " samples along a side, expected 1 to " +
                                                    std::to_string(MostSamples));
      }
      const std::size_t samples = static_cast<std::size_t>(width) * height;
      Require(rgb.size() == 3 * samples, "found " + std::to_string(rgb.size()) + " values for " +
                                           std::to_string(samples) + " samples, expected 3 each");
      RequireFinite(rgb, "values");
      Require(ClearNoise(rgb), "found a negative value, expected none");
      table = std::move(rgb);
    });
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
  const std::string problem = TakeTable(nTheta, nPhi, rgb, this->Distribution);
  if (!problem.empty())
  {
    vtkErrorMacro("SetDistribution: " << problem << "; p stays.");
    return false;
  }
  this->NumberOfTheta = nTheta;
  this->NumberOfPhi = nPhi;
  this->ResetLobe();
  this->WidenedLevels.reset();
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkDistributionBRDF::SetFresnel(int n, const std::vector<float>& rgb)
{
  const std::string problem = TakeTable(n, 1, rgb, this->Fresnel);
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
  const Neighbors t = ClampedNeighbors(ThetaHToUnit(angles.ThetaH), this->NumberOfTheta);
  // Rows of the table are phi_h; of the levels, widths.
  const bool soft = spread > 0.0 && this->NumberOfPhi == 1;
  if (soft)
  {
    this->PrepareLevels();
  }
  const std::vector<float>& rows = soft ? this->WidenedLevels->Rows : this->Distribution;
  const Neighbors p = soft
                        ? this->WidenedLevels->Find(HalfVectorSpread(spread, glm::dot(h, view)))
                        : PeriodicNeighbors(std::atan2(h.y, h.x) / (2.0 * Pi), this->NumberOfPhi);
  const Neighbors d =
    ClampedNeighbors(angles.ThetaD * (2.0 / Pi), static_cast<int>(this->Fresnel.size() / 3));
  const double g = 4.0 * (light.z + view.z - light.z * view.z);
  const auto at = [this, &rows](int theta, int row)
  { return GetColor(rows, row * this->NumberOfTheta + theta); };
  const glm::dvec3 p0 = glm::mix(at(t.First, p.First), at(t.Second, p.First), t.Weight);
  const glm::dvec3 p1 = glm::mix(at(t.First, p.Second), at(t.Second, p.Second), t.Weight);
  const glm::dvec3 fresnel =
    glm::mix(GetColor(this->Fresnel, d.First), GetColor(this->Fresnel, d.Second), d.Weight);
  const glm::dvec3 value = glm::mix(p0, p1, p.Weight) * fresnel / g;
  std::copy_n(&value.x, 3, f);
}

//------------------------------------------------------------------------------
void vtkDistributionBRDF::PrepareLevels()
{
  if (!this->WidenedLevels && this->NumberOfPhi == 1)
  {
    this->WidenedLevels = std::make_shared<const Levels>(this->NumberOfTheta, this->Distribution);
  }
}

//------------------------------------------------------------------------------
void vtkDistributionBRDF::Prepare()
{
  this->PrepareLevels();
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
void vtkDistributionBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFDistribution", vtkBRDFDistribution);
  // Rows of the texture are widths of an isotropic p, else phi_h.
  const bool hasLevels = this->NumberOfPhi == 1;
  this->PrepareLevels();
  auto& p = AddTexture(term, "brdfDistribution", this->NumberOfTheta,
    hasLevels ? static_cast<int>(Levels::Count) : this->NumberOfPhi);
  p.Repeat[1] = !hasLevels;
  p.Data = hasLevels ? this->WidenedLevels->Rows : this->Distribution;
  const double variance = hasLevels ? this->WidenedLevels->OwnVariance : 1.0;
  term.Uniforms = { { "brdfOwnVariance", { static_cast<float>(variance) } },
    { "brdfNumberOfLevels", { hasLevels ? static_cast<float>(Levels::Count) : 0.0f } } };
  AddTexture(term, "brdfFresnel", static_cast<int>(this->Fresnel.size() / 3), 1).Data =
    this->Fresnel;
  term.Fetches = 2;
  inputs.Terms.push_back(term);
  inputs.QuantizationError = std::max(inputs.QuantizationError, 0x1p-23);
  inputs.Description = "D-BRDF, tables of " + std::to_string(this->NumberOfTheta) + " x " +
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
  copy->WidenedLevels = this->WidenedLevels;
  return copy;
}
