// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What integrators and the planner make of an environment's pixels, whatever the material: made
 * once, shared by all threads, kept and freed with the pixels, which snapshots share.
 */

#ifndef EnvironmentPrecomputation_h
#define EnvironmentPrecomputation_h

#include "EnvironmentHarmonics.h"
#include "EnvironmentPanels.h"
#include "EnvironmentPyramid.h"
#include "ExtractedEmitters.h"
#include "Floats.h"
#include "RecentlyUsed.h"
#include "TexelChanges.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkSmartPointer.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

class vtkLightSetGenerator;

namespace measuredbrdf
{
/// Values that threads share, those asked for last. The first thread that asks for a value makes
/// it. Do not use this inside a parallel loop (vtkSMPTools): a thread that makes a value may
/// execute another part of that loop while it waits for its own parallel loop.
template <typename Key, typename Value>
class ConcurrentCache
{
public:
  using Pointer = std::shared_ptr<const Value>;

  /// More values are not kept; whoever has one keeps it.
  static constexpr std::size_t Most = 32;

  /// The value, made by make() if there is none. Other threads that ask for the same value wait.
  /// They call goOn() regularly and get null once it returns false. If make returns null or throws,
  /// the next thread makes the value.
  template <typename GoOn, typename Make>
  Pointer Get(const Key& key, const GoOn& goOn, const Make& make)
  {
    std::shared_ptr<Entry> entry;
    {
      const std::lock_guard<std::mutex> access(this->Access);
      std::shared_ptr<Entry>& known = this->Entries[key];
      known = known ? known : std::make_shared<Entry>();
      entry = known;
    }
    std::unique_lock<std::timed_mutex> lock(entry->Making, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(10)))
    {
      if (!goOn())
      {
        return nullptr;
      }
    }
    if (!entry->Made)
    {
      entry->Made = make();
    }
    return entry->Made;
  }

private:
  struct Entry
  {
    std::timed_mutex Making;
    Pointer Made;
  };

  std::mutex Access;
  RecentlyUsed<Key, std::shared_ptr<Entry>> Entries{ Most };
};

/// A light for each lamp. Its parts are a few smaller lights that add up to it.
class LampSet : public vtkLightSet
{
public:
  static LampSet* New();
  vtkTypeMacro(LampSet, vtkLightSet);

  std::vector<std::vector<ExtractedEmitters::Part>> Parts; // by lamp

protected:
  LampSet() = default;
  ~LampSet() override = default;

private:
  LampSet(const LampSet&) = delete;
  void operator=(const LampSet&) = delete;
};

/**
 * The environment that is given must be the parts' own or a snapshot of it. goOn is called now and
 * then while it takes long, by the calling thread; where it says false the result is null. What
 * other threads hold, too, is not to be changed.
 */
class EnvironmentPrecomputation
{
public:
  using GoOn = std::function<bool()>;
  /// The environment without its lights; null: there are none. The same object means the same
  /// texels, however they were found.
  using Rest = std::shared_ptr<const TexelChanges>;

  /// Lights and what they leave.
  struct Lamps
  {
    std::vector<ExtractedEmitters::Light> Lights;
    vtkSmartPointer<vtkLightSet> Set; // the same; null: none
    double Spread = 0.0;              // their mean one, by luminance,
    double SpreadOfParts = 0.0;       // and their parts'
    measuredbrdf::EnvironmentPrecomputation::Rest Rest;
    double GetSpread(bool ofParts) const { return ofParts ? this->SpreadOfParts : this->Spread; }
  };
  ///@{
  /// ExtractedEmitters, and its FindLamps.
  std::shared_ptr<const Lamps> GetExtractedEmitters(
    vtkEnvironment* environment, double share, int maximum, const GoOn& goOn, double angle = 0.0);
  std::shared_ptr<const Lamps> GetLamps(
    vtkEnvironment* environment, double angle, int maximum, const GoOn& goOn)
  {
    return this->GetExtractedEmitters(
      environment, ExtractedEmitters::LampShare, maximum, goOn, angle);
  }
  ///@}

  /// Up to the given degree at least.
  std::shared_ptr<const EnvironmentHarmonics> GetHarmonics(
    vtkEnvironment* environment, const Rest& rest, int degree, const GoOn& goOn);

  std::shared_ptr<const EnvironmentPyramid> GetPyramid(
    vtkEnvironment* environment, const Rest& rest, const GoOn& goOn);

  /// Null where goOn says so.
  std::shared_ptr<const EnvironmentPanels> GetPanels(
    vtkEnvironment* environment, const Rest& rest, const GoOn& goOn);

  /// vtkLightSetGenerator's by variance.
  vtkSmartPointer<vtkLightSet> GetLightSet(
    vtkEnvironment* environment, const Rest& rest, int count, const GoOn& goOn);

  /// The same for several counts, descending, by one tree.
  std::vector<vtkSmartPointer<vtkLightSet>> GetLightSets(vtkEnvironment* environment,
    const Rest& rest, const std::vector<int>& counts, const GoOn& goOn);

  /// A generator's, as it is now; null, and it has said why, where it can't make so many.
  vtkSmartPointer<vtkLightSet> GetGeneratedSet(
    vtkEnvironment* environment, vtkLightSetGenerator* generator, int count, const GoOn& goOn);

  /// A map of irradiance, in the form that make() gives it.
  std::shared_ptr<const ScaledTexels> GetIrradiance(const Rest& rest, const GoOn& goOn,
    const std::function<std::shared_ptr<const ScaledTexels>()>& make);

private:
  std::shared_ptr<const Lamps> Keep(ExtractedEmitters&& bright);

  using LightSet = vtkSmartPointer<vtkLightSet>;
  std::mutex Access;
  std::vector<std::weak_ptr<const TexelChanges>> Rests;
  ConcurrentCache<std::tuple<double, int, double>, Lamps> Bright; // share, maximum, angle
  // Keys hold the rest: its address is not used again while something is known of it.
  ConcurrentCache<std::pair<Rest, int>, EnvironmentHarmonics> Harmonics; // rest, degree
  ConcurrentCache<Rest, EnvironmentPanels> Panels;
  ConcurrentCache<Rest, EnvironmentPyramid> Pyramids;
  using LightSets = std::vector<LightSet>;
  ConcurrentCache<std::pair<Rest, std::vector<int>>, LightSets> SetsOf; // rest, counts
  // Generator, its modification time (never used twice: a recycled address does no harm), count.
  ConcurrentCache<std::tuple<vtkLightSetGenerator*, vtkMTimeType, int>, LightSet> GeneratedSets;
  ConcurrentCache<Rest, ScaledTexels> Irradiances;
};
} // namespace measuredbrdf

/// What an environment's GetParts gives.
struct vtkEnvironment::Precomputation : public measuredbrdf::EnvironmentPrecomputation
{
};

#endif
