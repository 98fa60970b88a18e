// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanReference.h"

#include "HalfVector.h" // for Pi
#include "LobePart.h"
#include "LobeSampler.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "MaterialPrecomputation.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr int NumberOfLights = 4096;
constexpr int FewerLights[] = { 256, 1024 }; // where the material tells them from all by little
constexpr int Probes = 16;                   // pairs that show by how much
constexpr double LittleError = 5e-4;         // relative L1 over those, or
constexpr double LittleShare = 0.025;        // this share of the tolerance
constexpr int FewestDirections = 64;
constexpr double DirectionsTimesTolerance = 1.28; // that few where the tolerance allows
constexpr int MostDirections = 2048;
constexpr double FullShare = 0.25; // of the albedo, that a sharp layer has to get the most
constexpr int MaximumSuns = 64;
constexpr double ResolvedAngle = 0.35; // sr, that the broad layer's lobes fill
// Of the albedo, and of the tolerance: below, there is no sharp layer.
constexpr double LeastShare = 2e-3;
constexpr double LeastShareOfTolerance = 0.25;
constexpr int SunPoints = 8; // a side of the square that a texel is interpolated over

// Median of the solid angle in sr in which one of the lobe's directions is alone, times their
// number; at 45 degrees.
double MeasureLobe(vtkBRDF* sharp, const LobeTable& lobes)
{
  const LobeSampler lobe(sharp, glm::normalize(glm::dvec3(1.0, 0.0, 1.0)), &lobes);
  std::vector<double> solidAngles;
  for (int k = 0; k < FewestDirections && !lobe.IsBlack(); ++k)
  {
    double density = 0.0;
    lobe.Sample(
      glm::dvec2((k + 0.5) / FewestDirections, RadicalInverse(static_cast<unsigned int>(k), 2)),
      density);
    solidAngles.push_back(density > 0.0 ? 1.0 / density : 4.0 * Pi);
  }
  std::sort(solidAngles.begin(), solidAngles.end());
  return solidAngles.empty() ? 4.0 * Pi : solidAngles[solidAngles.size() / 2];
}

// Radiance is interpolated between texels: one bright texel is a pyramid over 2 x 2 texels.
std::vector<ExtractedEmitters::Light> Spread(
  const std::vector<ExtractedEmitters::Light>& suns, vtkEnvironment* environment)
{
  std::vector<ExtractedEmitters::Light> points;
  for (const ExtractedEmitters::Light& sun : suns)
  {
    double u = 0.0;
    double v = 0.0;
    vtkEnvironment::GetCoordinates(&sun.Direction.x, u, v);
    for (int k = 0; k < SunPoints * SunPoints; ++k)
    {
      const glm::dvec2 at =
        (2.0 * glm::dvec2(k % SunPoints, k / SunPoints) + 1.0) / double(SunPoints) - 1.0;
      const double share =
        (1.0 - std::abs(at.x)) * (1.0 - std::abs(at.y)) * 4.0 / (SunPoints * SunPoints);
      ExtractedEmitters::Light point = sun;
      vtkEnvironment::GetDirection(u + at.x / environment->GetWidth(),
        std::clamp(v + at.y / environment->GetHeight(), 0.0, 1.0), &point.Direction.x);
      point.Irradiance *= share;
      points.push_back(point);
    }
  }
  return points;
}
}

vtkStandardNewMacro(PlanReference);

PlanReference::PlanReference() = default;
PlanReference::~PlanReference() = default;

bool PlanReference::Begin()
{
  const auto goOn = [this]() { return this->Report(0.0); };
  EnvironmentPrecomputation& parts = this->Environment->GetParts();
  const auto bright = parts.GetExtractedEmitters(
    this->Environment, ExtractedEmitters::DefaultShare, MaximumSuns, goOn);
  const auto lights =
    bright ? parts.GetLightSet(this->Environment, bright->Rest, NumberOfLights, goOn) : nullptr;
  if (!lights)
  {
    vtkErrorMacro("Integrate: aborted.");
    return false;
  }
  this->Suns = bright->Lights;
  this->Rest = bright->Rest;
  this->Lights = GetLights(lights);
  this->Cut = nullptr;
  this->Lobes = nullptr;
  if (this->BRDF->IsIsotropic())
  {
    const auto known = this->Shared ? this->Shared : std::make_shared<Precomputation>();
    const auto cut =
      std::make_shared<LobeSplit>(known->GetViews(this->BRDF, this->Abort), ResolvedAngle);
    if (cut->GetSharpShare() > std::max(LeastShare, LeastShareOfTolerance * this->ErrorTolerance))
    {
      auto sharp = vtkSmartPointer<LobePart>::New();
      sharp->Set(this->BRDF, cut, true);
      this->Sharp = sharp;
      this->Lobes = std::make_unique<LobeTable>(sharp);
      this->Cut = cut;
    }
  }
  this->SharpSeesSuns = false;
  if (this->Cut)
  {
    vtkEnvironment* environment = this->Environment->GetSubdivided();
    this->Suns = Spread(this->Suns, environment);
    this->SharpSeesSuns = MeasureLobe(this->Sharp, *this->Lobes) <
                          4.0 * environment->GetTexelSolidAngle(environment->GetHeight() / 2);
  }
  return this->ChooseLights(goOn);
}

// Broad lobes do not tell a few hundred lights from all of them. Some pairs show whether this one
// does.
bool PlanReference::ChooseLights(const std::function<bool()>& goOn)
{
  const double least = std::min(LittleError, LittleShare * this->ErrorTolerance);
  std::vector<Pair> pairs;
  std::vector<glm::dvec3> all;
  double total = 0.0;
  for (unsigned int k = 1; k <= Probes; ++k)
  {
    // Normals over the sphere, views of a sphere's disc.
    const double z = 2.0 * RadicalInverse(k, 2) - 1.0;
    const double azimuth = 2.0 * Pi * RadicalInverse(k, 3);
    const double s = std::sqrt(1.0 - z * z);
    const double cosine = std::sqrt(RadicalInverse(k, 5));
    const Frame frame =
      FrameAbout(glm::dvec3(s * std::cos(azimuth), z, s * std::sin(azimuth)), glm::dvec3(0.0));
    const double turn = 2.0 * Pi * RadicalInverse(k, 7);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    pairs.push_back(this->MakePair(
      frame, LiftView(glm::dvec3(sine * std::cos(turn), sine * std::sin(turn), cosine))));
    all.push_back(this->SumLights(this->Lights, pairs.back()));
    total += all.back().x + all.back().y + all.back().z;
  }
  for (const int count : FewerLights)
  {
    const auto set =
      this->Environment->GetParts().GetLightSet(this->Environment, this->Rest, count, goOn);
    if (!set)
    {
      vtkErrorMacro("Integrate: aborted.");
      return false;
    }
    std::vector<ExtractedEmitters::Light> lights = GetLights(set);
    double difference = 0.0;
    for (std::size_t k = 0; k < pairs.size(); ++k)
    {
      const glm::dvec3 d = glm::abs(this->SumLights(lights, pairs[k]) - all[k]);
      difference += d.x + d.y + d.z;
    }
    if (difference <= least * total)
    {
      this->Lights = std::move(lights);
      break;
    }
  }
  return true;
}

std::vector<ExtractedEmitters::Light> PlanReference::GetLights(vtkLightSet* set)
{
  std::vector<ExtractedEmitters::Light> lights(static_cast<std::size_t>(set->GetNumberOfLights()));
  for (int k = 0; k < set->GetNumberOfLights(); ++k)
  {
    ExtractedEmitters::Light& light = lights[static_cast<std::size_t>(k)];
    set->GetDirection(k, &light.Direction.x);
    set->GetIrradiance(k, &light.Irradiance.x);
  }
  return lights;
}

PlanReference::Pair PlanReference::MakePair(const Frame& about, const glm::dvec3& lifted) const
{
  Pair pair{ about, lifted, {} };
  if (this->Cut) // isotropic: any frame about the normal does, this one has the view over its x
  {
    const double s = std::hypot(lifted.x, lifted.y);
    const glm::dvec2 a = s > 1e-6 ? glm::dvec2(lifted) / s : glm::dvec2(1.0, 0.0);
    pair.Local = Frame(about * glm::dvec3(a, 0.0), about * glm::dvec3(-a.y, a.x, 0.0), about[2]);
    pair.View = glm::dvec3(s, 0.0, lifted.z);
    pair.Cut = this->Cut->GetView(pair.View);
  }
  return pair;
}

glm::dvec3 PlanReference::Evaluate(const glm::dvec3& i, const Pair& pair) const
{
  glm::dvec3 f;
  this->BRDF->Evaluate(&i.x, &pair.View.x, &f.x);
  return f;
}

glm::dvec3 PlanReference::SumLights(
  const std::vector<ExtractedEmitters::Light>& lights, const Pair& pair) const
{
  glm::dvec3 sum(0.0);
  for (const ExtractedEmitters::Light& light : lights)
  {
    const glm::dvec3 i = ToLocal(pair.Local, light.Direction);
    if (i.z > 0.0)
    {
      const glm::dvec3 f = this->Evaluate(i, pair);
      sum += i.z * (this->Cut ? pair.Cut.GetBroad(f, i.z) : f) * light.Irradiance;
    }
  }
  return sum;
}

void PlanReference::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const Frame about = FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  const Pair pair = this->MakePair(about, LiftView(ToLocal(about, glm::make_vec3(o))));
  glm::dvec3 sum = this->SumLights(this->Lights, pair);
  for (const ExtractedEmitters::Light& sun : this->Suns)
  {
    const glm::dvec3 i = ToLocal(pair.Local, sun.Direction);
    if (i.z > 0.0)
    {
      const glm::dvec3 f = this->Evaluate(i, pair);
      sum += i.z * (this->SharpSeesSuns ? pair.Cut.GetBroad(f, i.z) : f) * sun.Irradiance;
    }
  }
  if (this->Cut)
  {
    const TexelChanges none;
    const TexelChanges& rest = this->Rest && !this->SharpSeesSuns ? *this->Rest : none;
    const LobeSampler lobe(this->Sharp, pair.View, this->Lobes.get());
    // A smaller share of the radiance may be less accurate.
    const int fewest = std::clamp(static_cast<int>(DirectionsTimesTolerance / this->ErrorTolerance),
      FewestDirections, 4 * FewestDirections);
    const int directions = std::clamp(
      static_cast<int>(MostDirections * pair.Cut.Share / FullShare), fewest, MostDirections);
    for (int k = 0; k < directions && !lobe.IsBlack(); ++k)
    {
      const glm::dvec2 u((k + 0.5) / directions, RadicalInverse(static_cast<unsigned int>(k), 2));
      double density = 0.0;
      const glm::dvec3 i = lobe.Sample(u, density);
      if (i.z > 0.0)
      {
        const glm::dvec3 direction = pair.Local * i;
        glm::dvec3 light;
        rest.GetRadiance(this->Environment->GetSubdivided(), &direction.x, &light.x);
        const glm::dvec3 f = this->Evaluate(i, pair);
        sum += (f - pair.Cut.GetBroad(f, i.z)) * light * (i.z / (density * directions));
      }
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += sum[c];
  }
}
} // namespace measuredbrdf
