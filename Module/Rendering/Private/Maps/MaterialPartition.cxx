// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialPartition.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace measuredbrdf
{
namespace
{
using Set = PolygonMaterials::Set;

// Most materials of groups that are merged: their textures fit into the 16 units that every
// graphics card has, and none is left out where fewer meet.
constexpr std::size_t MostMerged = 5;

// Of several materials, before it is merged with others.
struct Mixture
{
  Set Materials;
  double Polygons;
  std::vector<std::size_t> Sets; // of PolygonMaterials

  // What it costs to draw: each pixel asks all of the materials.
  double GetCost() const { return this->Polygons * static_cast<double>(this->Materials.size()); }
};

Set Unite(const Set& a, const Set& b)
{
  Set both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

// Merge the mixture of the fewest polygons with the one that makes that cheapest; whether it could.
bool MergeSmallest(std::vector<Mixture>& mixtures, std::size_t mostMaterials)
{
  const auto smallest = std::min_element(mixtures.begin(), mixtures.end(),
    [](const Mixture& a, const Mixture& b) { return a.Polygons < b.Polygons; });
  double least = std::numeric_limits<double>::infinity();
  auto best = mixtures.end();
  for (auto other = mixtures.begin(); other != mixtures.end(); ++other)
  {
    const std::size_t size = Unite(smallest->Materials, other->Materials).size();
    const double cost = static_cast<double>(size) * (smallest->Polygons + other->Polygons) -
                        smallest->GetCost() - other->GetCost();
    if (other != smallest && size <= mostMaterials && cost < least)
    {
      least = cost;
      best = other;
    }
  }
  if (best == mixtures.end())
  {
    return false;
  }
  best->Materials = Unite(best->Materials, smallest->Materials);
  best->Polygons += smallest->Polygons;
  best->Sets.insert(best->Sets.end(), smallest->Sets.begin(), smallest->Sets.end());
  mixtures.erase(smallest);
  return true;
}

// A slot for each class, where possible the same in all polygons.
std::map<int, int> FindSlots(const Set& classes)
{
  std::map<int, int> slots;
  bool taken[MaterialPartition::MaximumNumberOfSlots] = {};
  for (int cls : classes)
  {
    std::size_t slot = static_cast<std::size_t>(cls) % MaterialPartition::MaximumNumberOfSlots;
    while (taken[slot])
    {
      slot = (slot + 1) % MaterialPartition::MaximumNumberOfSlots;
    }
    taken[slot] = true;
    slots[cls] = static_cast<int>(slot);
  }
  return slots;
}
}

void MaterialPartition::Add(std::size_t set, Group group)
{
  this->GroupsOf[set].push_back(static_cast<int>(this->Groups.size()));
  this->Groups.push_back(std::move(group));
}

MaterialPartition::MaterialPartition(
  const PolygonMaterials& polygons, int mostMaterials, int wanted)
{
  const auto most = static_cast<std::size_t>(mostMaterials);
  const bool onScale = !polygons.Knots.empty();
  const std::size_t sets = polygons.Sets.size();
  std::vector<double> counts(sets, 0.0);
  for (int set : polygons.SetOfPolygon)
  {
    counts[static_cast<std::size_t>(set)] += 1.0;
  }
  this->GroupsOf.resize(sets);
  this->SlotOfClass.resize(sets);
  std::vector<Mixture> mixtures;
  std::vector<std::size_t> inBands;
  std::map<std::pair<int, int>, int> known; // the group of a class and a slot
  for (std::size_t k = 0; k < sets; ++k)
  {
    const Set& set = polygons.Sets[k];
    if (set.size() < 2)
    {
      Group group;
      group.Materials = set;
      this->Add(k, std::move(group));
    }
    else if (!polygons.PointClasses.empty())
    {
      this->SlotOfClass[k] = FindSlots(set);
      for (const auto& [cls, slot] : this->SlotOfClass[k])
      {
        const auto [group, isNew] =
          known.try_emplace({ cls, slot }, static_cast<int>(this->Groups.size()));
        if (isNew)
        {
          this->Groups.push_back({ { cls }, false, slot });
          this->NumberOfSlots = std::max(this->NumberOfSlots, slot + 1);
        }
        this->GroupsOf[k].push_back(group->second);
      }
    }
    else if (set.size() > most && onScale)
    {
      inBands.push_back(k);
    }
    else
    {
      const bool fits = set.size() <= most;
      this->Dropped += fits ? 0 : static_cast<std::size_t>(counts[k]);
      mixtures.push_back(
        { fits ? set : polygons.GetHeaviest(static_cast<int>(k), most), counts[k], { k } });
    }
  }
  while (static_cast<int>(mixtures.size()) > wanted &&
         MergeSmallest(mixtures, std::min(most, MostMerged)))
  {
  }
  const bool stillMany = onScale && static_cast<int>(mixtures.size()) > wanted &&
                         mixtures.size() * most > polygons.Knots.size();
  for (Mixture& mixture : mixtures)
  {
    if (stillMany)
    {
      inBands.insert(inBands.end(), mixture.Sets.begin(), mixture.Sets.end());
      continue;
    }
    for (std::size_t set : mixture.Sets)
    {
      this->GroupsOf[set].push_back(static_cast<int>(this->Groups.size()));
    }
    this->Groups.push_back({ std::move(mixture.Materials) });
  }
  this->AddBands(polygons, inBands, mostMaterials);
}

void MaterialPartition::AddBands(
  const PolygonMaterials& polygons, const std::vector<std::size_t>& sets, int mostMaterials)
{
  const int last = static_cast<int>(polygons.Knots.size()); // materials count from 1
  for (int first = 1; first < last; first += mostMaterials - 1)
  {
    const int end = std::min(first + mostMaterials - 1, last);
    bool used = false;
    for (std::size_t k : sets)
    {
      const Set& set = polygons.Sets[k];
      if (std::max(set.front(), first) < std::min(set.back(), end))
      {
        this->GroupsOf[k].push_back(static_cast<int>(this->Groups.size()));
        used = true;
      }
    }
    if (used)
    {
      Set band(static_cast<std::size_t>(end - first) + 1);
      std::iota(band.begin(), band.end(), first);
      this->Groups.push_back({ std::move(band), true });
    }
  }
}
} // namespace measuredbrdf
