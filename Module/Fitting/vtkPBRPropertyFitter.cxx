// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPBRPropertyFitter.h"

#include "PBRPicture.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkProperty.h"

#include <algorithm>
#include <limits>
#include <vector>

vtkStandardNewMacro(vtkPBRPropertyFitter);

namespace
{
using measuredbrdf::PBRParameters;
using measuredbrdf::PBRPicture;

// Smaller roughness is a mirror to VTK's tables of the light, and 0 divides by 0.
constexpr double LeastRoughness = 0.05;
// What further parameters have to leave of the error to be worth it: not all that draws a property
// knows them.
constexpr double WorthIt = 0.7;

// Which parameters a search may change.
enum Extent
{
  METALLIC_ROUGHNESS,
  WITH_FRESNEL,
  WITH_COAT
};

//------------------------------------------------------------------------------
// What values a search may take beside the ranges of the axes.
struct Limits
{
  double LeastMetallic;
  double MostMetallic;
  double MostRoughness;
  double MostIndex;

  PBRParameters Clamp(PBRParameters parameters) const
  {
    parameters.Metallic = std::clamp(parameters.Metallic, this->LeastMetallic, this->MostMetallic);
    parameters.Roughness = std::min(parameters.Roughness, this->MostRoughness);
    parameters.BaseIOR = std::min(parameters.BaseIOR, this->MostIndex);
    parameters.CoatIOR = std::min(parameters.CoatIOR, this->MostIndex);
    return parameters;
  }
};
const Limits Free = { 0.0, 1.0, 1.0, 3.0 };
const Limits Dielectric = { 0.0, 0.0, 1.0, 2.0 };
const Limits Metal = { 0.3, 1.0, 0.6, 2.0 };
constexpr double WorthMetal = 0.95; // what a metal has to leave of a dielectric's error

//------------------------------------------------------------------------------
struct Candidate
{
  PBRParameters Parameters;
  std::array<double, 3> Color = { 0.5, 0.5, 0.5 };
  double Error = std::numeric_limits<double>::infinity();
};

//------------------------------------------------------------------------------
// What is searched, with its range and the first step of the refinement.
struct Axis
{
  double PBRParameters::*Value;
  double Least;
  double Most;
  double Step;
  Extent From;
};
const std::array<Axis, 7> Axes = { {
  { &PBRParameters::Roughness, LeastRoughness, 1.0, 0.08, METALLIC_ROUGHNESS },
  { &PBRParameters::Metallic, 0.0, 1.0, 0.2, METALLIC_ROUGHNESS },
  { &PBRParameters::BaseIOR, 1.0, 3.0, 0.25, WITH_FRESNEL },
  { &PBRParameters::EdgeTint, 0.0, 1.0, 0.25, WITH_FRESNEL },
  { &PBRParameters::CoatStrength, 0.0, 1.0, 0.25, WITH_COAT },
  { &PBRParameters::CoatRoughness, LeastRoughness, 1.0, 0.08, WITH_COAT },
  { &PBRParameters::CoatIOR, 1.0, 3.0, 0.25, WITH_COAT },
} };

//------------------------------------------------------------------------------
void Keep(Candidate& best, const Candidate& other)
{
  if (other.Error < best.Error)
  {
    best = other;
  }
}

//------------------------------------------------------------------------------
Candidate Try(PBRPicture& picture, const PBRParameters& parameters)
{
  Candidate candidate{ parameters };
  candidate.Error = picture.FitColor(parameters, candidate.Color);
  return candidate;
}

//------------------------------------------------------------------------------
// One parameter at a time, up and down, with steps halved until they are a hundredth.
Candidate Refine(PBRPicture& picture, const Candidate& start, Extent extent, const Limits& limits)
{
  Candidate best = start;
  for (double share = 1.0; share > 0.05; share *= 0.5)
  {
    for (int round = 0; round < 4; ++round)
    {
      const double before = best.Error;
      for (const Axis& axis : Axes)
      {
        for (const double sign : { -1.0, 1.0 })
        {
          Candidate next = best;
          double& value = next.Parameters.*axis.Value;
          value = std::clamp(value + sign * share * axis.Step, axis.Least, axis.Most);
          value = std::round(100.0 * value) / 100.0;
          next.Parameters = limits.Clamp(next.Parameters);
          if (axis.From <= extent && value != best.Parameters.*axis.Value)
          {
            Keep(best, Try(picture, next.Parameters));
          }
        }
      }
      if (best.Error > 0.999 * before)
      {
        break;
      }
    }
  }
  return best;
}

//------------------------------------------------------------------------------
// The best of what the few best starts lead to.
Candidate Search(PBRPicture& picture, const std::vector<PBRParameters>& starts, Extent extent,
  const Limits& limits)
{
  constexpr std::size_t refined = 3;
  std::vector<Candidate> candidates;
  for (const PBRParameters& start : starts)
  {
    candidates.push_back(Try(picture, limits.Clamp(start)));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b) { return a.Error < b.Error; });
  Candidate best;
  for (std::size_t k = 0; k < std::min(refined, candidates.size()); ++k)
  {
    Keep(best, Refine(picture, candidates[k], extent, limits));
  }
  return best;
}

//------------------------------------------------------------------------------
std::vector<PBRParameters> GetStarts(Extent extent, const PBRParameters& before)
{
  // Rough ones first: of equals, where nothing is specular, the first is taken.
  const std::vector<double> any = { 1.0, 0.7, 0.5, 0.35, 0.25, 0.15, 0.07 };
  const std::vector<double> few = { 1.0, 0.5, 0.3, before.Roughness };
  std::vector<PBRParameters> starts;
  for (const double roughness : extent == WITH_COAT ? few : any)
  {
    for (const double metallic : { 0.0, 0.5, 1.0 })
    {
      PBRParameters start;
      start.Roughness = roughness;
      start.Metallic = metallic;
      if (extent == METALLIC_ROUGHNESS)
      {
        starts.push_back(start);
      }
      else if (extent == WITH_FRESNEL)
      {
        for (const double index : { 1.0, 1.5, 2.2 })
        {
          start.BaseIOR = index;
          start.EdgeTint = 0.5;
          starts.push_back(start);
        }
      }
      else
      {
        for (const double coat : { 0.07, 0.2, 0.4 })
        {
          start.CoatStrength = 1.0;
          start.CoatRoughness = coat;
          start.CoatIOR = 1.5;
          starts.push_back(start);
        }
      }
    }
  }
  return starts;
}

//------------------------------------------------------------------------------
// More parameters only where they are worth it.
Candidate SearchWithin(PBRPicture& picture, const Limits& limits)
{
  Candidate best;
  for (const Extent extent : { METALLIC_ROUGHNESS, WITH_FRESNEL, WITH_COAT })
  {
    const Candidate next = Search(picture, GetStarts(extent, best.Parameters), extent, limits);
    if (!(next.Error >= WorthIt * best.Error))
    {
      best = next;
    }
  }
  return best;
}
}

//------------------------------------------------------------------------------
void vtkPBRPropertyFitter::SetBRDF(vtkBRDF* brdf)
{
  if (this->BRDF != brdf)
  {
    this->BRDF = brdf;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkPBRPropertyFitter::GetNeutralRadiance(const double direction[3])
{
  const glm::dvec3 d = glm::normalize(glm::dvec3(direction[0], direction[1], direction[2]));
  // A round lamp of that radius, its edge soft over two degrees.
  const auto lamp = [&d](const glm::dvec3& towards, double degrees)
  {
    const double cosine = std::cos(vtkMath::RadiansFromDegrees(degrees));
    const double edge =
      std::sin(vtkMath::RadiansFromDegrees(degrees)) * vtkMath::RadiansFromDegrees(1.0);
    return 1.0 / (1.0 + std::exp((cosine - glm::dot(d, glm::normalize(towards))) / edge));
  };
  return 0.3 + 0.2 * d.y                                 // floor to ceiling
         + 5.0 * lamp(glm::dvec3(-0.6, 0.7, 0.6), 14.0)  // key
         + 1.0 * lamp(glm::dvec3(1.0, 0.15, 0.4), 25.0)  // fill
         + 2.0 * lamp(glm::dvec3(0.4, 0.4, -1.0), 18.0); // rim
}

//------------------------------------------------------------------------------
bool vtkPBRPropertyFitter::Update()
{
  if (!this->BRDF)
  {
    vtkErrorMacro("There is no material to fit: call SetBRDF first.");
    return false;
  }
  this->BRDF->Prepare();
  PBRPicture picture(this->BRDF, [](const glm::dvec3& d) { return GetNeutralRadiance(&d.x); });
  Candidate best = SearchWithin(picture, Dielectric);
  const Candidate metal = SearchWithin(picture, Metal);
  // One at the least metallic part wants to be none.
  const bool isMetal =
    metal.Parameters.Metallic > Metal.LeastMetallic && metal.Error < WorthMetal * best.Error;
  best = isMetal ? metal : best;
  Candidate closest = best;
  Keep(closest, metal);
  Keep(closest, SearchWithin(picture, Free));
  this->ClosestError = closest.Error;
  best = this->UsualValues ? best : closest;
  std::copy(best.Color.begin(), best.Color.end(), this->BaseColor);
  this->Roughness = best.Parameters.Roughness;
  this->Metallic = best.Parameters.Metallic;
  this->BaseIOR = best.Parameters.BaseIOR;
  this->EdgeTint = best.Parameters.EdgeTint;
  this->CoatStrength = best.Parameters.CoatStrength;
  this->CoatRoughness = best.Parameters.CoatRoughness;
  this->CoatIOR = best.Parameters.CoatIOR;
  this->RelativeError = best.Error;
  return true;
}

//------------------------------------------------------------------------------
void vtkPBRPropertyFitter::Apply(vtkProperty* property)
{
  if (!property)
  {
    vtkErrorMacro("There is no property to set.");
    return;
  }
  property->SetInterpolationToPBR();
  property->SetColor(this->BaseColor);
  property->SetDiffuse(1.0);
  property->SetMetallic(this->Metallic);
  property->SetRoughness(this->Roughness);
  property->SetBaseIOR(this->BaseIOR);
  property->SetEdgeTint(this->EdgeTint, this->EdgeTint, this->EdgeTint);
  property->SetAnisotropy(0.0);
  property->SetCoatStrength(this->CoatStrength);
  property->SetCoatRoughness(this->CoatRoughness);
  property->SetCoatIOR(this->CoatIOR);
  property->SetCoatColor(1.0, 1.0, 1.0);

  // Phong's: the lobe's peak at normal incidence, pi f = F0 / (4 alpha^2), and the exponent of the
  // reflected vector, a quarter of the half vector's 2 / alpha^2 - 2 (Walter et al. 2007).
  const bool coat = this->CoatStrength > 0.5 && this->CoatRoughness < this->Roughness;
  const double roughness = coat ? this->CoatRoughness : this->Roughness;
  const double alpha2 = std::pow(roughness, 4);
  const double base = property->ComputeReflectanceOfBaseLayer();
  double f0[3];
  for (int c = 0; c < 3; ++c)
  {
    f0[c] = coat ? measuredbrdf::GetPBRReflectance(this->CoatIOR, 1.0)
                 : base + (this->BaseColor[c] - base) * this->Metallic;
  }
  const double most = std::max({ f0[0], f0[1], f0[2] });
  if (most > 0.0)
  {
    property->SetSpecularColor(f0[0] / most, f0[1] / most, f0[2] / most);
  }
  property->SetSpecular(std::min(most / (4.0 * alpha2), 1.0));
  property->SetSpecularPower(std::clamp(0.25 * (2.0 / alpha2 - 2.0), 1.0, 128.0));
}

//------------------------------------------------------------------------------
double vtkPBRPropertyFitter::Fit(vtkBRDF* brdf, vtkProperty* property)
{
  vtkNew<vtkPBRPropertyFitter> fitter;
  fitter->SetBRDF(brdf);
  if (!property || !fitter->Update())
  {
    return -1.0;
  }
  fitter->Apply(property);
  return fitter->GetRelativeError();
}

//------------------------------------------------------------------------------
void vtkPBRPropertyFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "BaseColor: " << this->BaseColor[0] << " " << this->BaseColor[1] << " "
     << this->BaseColor[2] << "\n";
  os << indent << "Roughness: " << this->Roughness << "\n";
  os << indent << "Metallic: " << this->Metallic << "\n";
  os << indent << "BaseIOR: " << this->BaseIOR << "\n";
  os << indent << "EdgeTint: " << this->EdgeTint << "\n";
  os << indent << "CoatStrength: " << this->CoatStrength << "\n";
  os << indent << "CoatRoughness: " << this->CoatRoughness << "\n";
  os << indent << "CoatIOR: " << this->CoatIOR << "\n";
  os << indent << "RelativeError: " << this->RelativeError << "\n";
  os << indent << "UsualValues: " << (this->UsualValues ? "On" : "Off") << "\n";
  os << indent << "ClosestError: " << this->ClosestError << "\n";
}
