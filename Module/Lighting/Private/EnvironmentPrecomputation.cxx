// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPrecomputation.h"

#include "LightTree.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace measuredbrdf
{
vtkStandardNewMacro(LampSet);

namespace
{
// Harmonics come up to these degrees, so that tables of several sizes share them.
constexpr int Degrees[] = { 129, 257, 321, 513 };

TexelChanges GetChanges(const EnvironmentPrecomputation::Rest& rest)
{
  return rest ? *rest : TexelChanges();
}
}

std::shared_ptr<const EnvironmentPrecomputation::Lamps> EnvironmentPrecomputation::Keep(
  ExtractedEmitters&& bright)
{
  auto lamps = std::make_shared<Lamps>();
  lamps->Lights = std::move(bright.Lights);
  if (lamps->Lights.empty())
  {
    return lamps;
  }
  auto set = vtkSmartPointer<LampSet>::New();
  lamps->Set = set;
  double sum = 0.0;
  for (const ExtractedEmitters::Light& light : lamps->Lights)
  {
    const double luminance = vtkEnvironment::GetLuminance(&light.Irradiance.x);
    sum += luminance;
    lamps->Spread += luminance * light.Spread;
    for (const ExtractedEmitters::Part& part : light.Parts)
    {
      lamps->SpreadOfParts += vtkEnvironment::GetLuminance(&part.Irradiance.x) * part.Spread;
    }
    set->Parts.push_back(light.Parts);
    lamps->Set->AddLight(
      &light.Direction.x, &light.Irradiance.x, 0.0, light.Spread > 0.0 ? 1.0 / light.Spread : 0.0);
  }
  sum = std::max(sum, std::numeric_limits<double>::min());
  lamps->Spread /= sum;
  lamps->SpreadOfParts /= sum;
  const std::lock_guard<std::mutex> lock(this->Access);
  for (auto known = this->Rests.begin(); known != this->Rests.end();)
  {
    const Rest rest = known->lock();
    if (rest && rest->Texels == bright.Rest.Texels)
    {
      lamps->Rest = rest;
      return lamps;
    }
    known = rest ? std::next(known) : this->Rests.erase(known);
  }
  lamps->Rest = std::make_shared<TexelChanges>(std::move(bright.Rest));
  this->Rests.push_back(lamps->Rest);
  return lamps;
}

std::shared_ptr<const EnvironmentPrecomputation::Lamps>
EnvironmentPrecomputation::GetExtractedEmitters(
  vtkEnvironment* environment, double share, int maximum, const GoOn& goOn, double angle)
{
  return this->Bright.Get({ share, maximum, angle }, goOn,
    [&]() { return this->Keep(ExtractedEmitters(environment, share, maximum, angle)); });
}

std::shared_ptr<const EnvironmentHarmonics> EnvironmentPrecomputation::GetHarmonics(
  vtkEnvironment* environment, const Rest& rest, int degree, const GoOn& goOn)
{
  const int* enough = std::lower_bound(std::begin(Degrees), std::end(Degrees), degree);
  const int made = enough != std::end(Degrees) ? *enough : degree;
  return this->Harmonics.Get({ rest, made }, goOn,
    [&]() { return std::make_shared<EnvironmentHarmonics>(environment, made, GetChanges(rest)); });
}

std::shared_ptr<const EnvironmentPyramid> EnvironmentPrecomputation::GetPyramid(
  vtkEnvironment* environment, const Rest& rest, const GoOn& goOn)
{
  return this->Pyramids.Get(rest, goOn,
    [&]() { return std::make_shared<EnvironmentPyramid>(environment, GetChanges(rest)); });
}

std::shared_ptr<const EnvironmentPanels> EnvironmentPrecomputation::GetPanels(
  vtkEnvironment* environment, const Rest& rest, const GoOn& goOn)
{
  return this->Panels.Get(rest, goOn,
    [&]() -> std::shared_ptr<EnvironmentPanels>
    {
      const auto lights = this->GetLightSet(environment, rest, EnvironmentPanels::Lights, goOn);
      return lights ? std::make_shared<EnvironmentPanels>(environment, GetChanges(rest), lights)
                    : nullptr;
    });
}

vtkSmartPointer<vtkLightSet> EnvironmentPrecomputation::GetLightSet(
  vtkEnvironment* environment, const Rest& rest, int count, const GoOn& goOn)
{
  const LightSets sets = this->GetLightSets(environment, rest, { count }, goOn);
  return sets.empty() ? nullptr : sets.front();
}

std::vector<vtkSmartPointer<vtkLightSet>> EnvironmentPrecomputation::GetLightSets(
  vtkEnvironment* environment, const Rest& rest, const std::vector<int>& counts, const GoOn& goOn)
{
  const auto make = [&]() -> std::shared_ptr<LightSets>
  {
    if (counts.empty() || !std::is_sorted(counts.rbegin(), counts.rend()) || counts.back() < 1 ||
        counts.front() > vtkLightSetGenerator::MaximumNumberOfLights)
    {
      return nullptr;
    }
    vtkEnvironment* subdivided = environment->GetSubdivided();
    const TexelChanges changes = GetChanges(rest);
    const LightTree tree(subdivided, changes, counts.front(), goOn);
    if (tree.IsStopped())
    {
      return nullptr;
    }
    auto sets = std::make_shared<LightSets>();
    for (const int count : counts)
    {
      sets->push_back(LightSet::New());
      tree.FillLightSet(count, sets->back());
    }
    return sets;
  };
  const auto sets = this->SetsOf.Get({ rest, counts }, goOn, make);
  return sets ? *sets : LightSets();
}

vtkSmartPointer<vtkLightSet> EnvironmentPrecomputation::GetGeneratedSet(
  vtkEnvironment* environment, vtkLightSetGenerator* generator, int count, const GoOn& goOn)
{
  const auto make = [&]() -> std::shared_ptr<LightSet>
  {
    static std::mutex generating; // a generator works for one thread at a time
    const std::lock_guard<std::mutex> lock(generating);
    auto set = vtkSmartPointer<vtkLightSet>::New();
    return generator->Generate(environment, count, set) ? std::make_shared<LightSet>(set) : nullptr;
  };
  const auto set = this->GeneratedSets.Get({ generator, generator->GetMTime(), count }, goOn, make);
  return set ? *set : nullptr;
}

std::shared_ptr<const ScaledTexels> EnvironmentPrecomputation::GetIrradiance(const Rest& rest,
  const GoOn& goOn, const std::function<std::shared_ptr<const ScaledTexels>()>& make)
{
  return this->Irradiances.Get(rest, goOn, make);
}
} // namespace measuredbrdf

std::shared_ptr<vtkEnvironment::Precomputation> vtkEnvironment::MakeParts()
{
  return std::make_shared<Precomputation>();
}
