// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartSets.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Most materials of sets that are merged: their textures fit into the 16 units that every graphics
// card has, and none is left out where fewer meet.
constexpr std::size_t MostMerged = 5;

struct Group
{
  CellMaterials::Set Set;
  double Polygons;
  std::vector<int> Origins; // sets of the cells

  // What it costs to draw: each pixel asks all of the materials.
  double GetCost() const { return this->Polygons * static_cast<double>(this->Set.size()); }
};

CellMaterials::Set Unite(const CellMaterials::Set& a, const CellMaterials::Set& b)
{
  CellMaterials::Set both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

// Merge the group of the fewest polygons with the one that makes that cheapest; whether it could.
bool MergeSmallest(std::vector<Group>& groups, std::size_t mostMaterials)
{
  const auto smallest = std::min_element(groups.begin(), groups.end(),
    [](const Group& a, const Group& b) { return a.Polygons < b.Polygons; });
  double least = std::numeric_limits<double>::infinity();
  auto best = groups.end();
  for (auto other = groups.begin(); other != groups.end(); ++other)
  {
    const std::size_t size = Unite(smallest->Set, other->Set).size();
    const double cost = static_cast<double>(size) * (smallest->Polygons + other->Polygons) -
                        smallest->GetCost() - other->GetCost();
    if (other != smallest && size <= mostMaterials && cost < least)
    {
      least = cost;
      best = other;
    }
  }
  if (best == groups.end())
  {
    return false;
  }
  best->Set = Unite(best->Set, smallest->Set);
  best->Polygons += smallest->Polygons;
  best->Origins.insert(best->Origins.end(), smallest->Origins.begin(), smallest->Origins.end());
  groups.erase(smallest);
  return true;
}

// A slot for each class, so that few classes that meet have the same one: each class in turn, those
// of the most polygons first, takes the slot that the fewest polygons with its neighbors have.
std::map<int, int> FindUsualSlots(
  const CellMaterials& cells, const std::vector<int>& origins, const std::vector<double>& polygons)
{
  std::map<int, std::map<int, double>> neighbors;
  std::map<int, double> totals;
  for (int origin : origins)
  {
    const auto place = static_cast<std::size_t>(origin);
    for (int a : cells.GetSets()[place])
    {
      totals[a] += polygons[place];
      for (int b : cells.GetSets()[place])
      {
        neighbors[a][b] += polygons[place];
      }
    }
  }
  std::vector<std::pair<double, int>> order;
  for (const auto& [cls, total] : totals)
  {
    order.emplace_back(-total, cls);
  }
  std::sort(order.begin(), order.end());
  std::map<int, int> slots;
  for (const auto& [total, cls] : order)
  {
    std::array<double, PartSets::MaximumNumberOfSlots> meeting = {};
    for (const auto& [other, count] : neighbors[cls])
    {
      const auto known = slots.find(other);
      if (known != slots.end())
      {
        meeting[static_cast<std::size_t>(known->second)] += count;
      }
    }
    slots[cls] =
      static_cast<int>(std::min_element(meeting.begin(), meeting.end()) - meeting.begin());
  }
  return slots;
}
}

PartSets::PartSets(const CellMaterials& cells, int mostMaterials, int wanted)
{
  const auto most = static_cast<std::size_t>(mostMaterials);
  const bool onScale = !cells.GetKnots().empty();
  std::vector<double> polygons(cells.GetSets().size(), 0.0);
  for (int set : cells.GetSetOfPolygon())
  {
    polygons[static_cast<std::size_t>(set)] += 1.0;
  }
  this->Places.resize(polygons.size());
  std::vector<Group> groups; // of several materials
  std::vector<int> inBands;
  std::vector<int> onBorders;
  for (std::size_t k = 0; k < polygons.size(); ++k)
  {
    const int origin = static_cast<int>(k);
    CellMaterials::Set set = cells.GetSets()[k];
    if (set.size() > most && onScale)
    {
      inBands.push_back(origin);
      continue;
    }
    if (set.size() > most)
    {
      set = cells.GetHeaviest(origin, most);
      this->Dropped += static_cast<std::size_t>(polygons[k]);
    }
    if (set.size() > 1 && !cells.GetPointClasses().empty())
    {
      onBorders.push_back(origin);
    }
    else if (set.size() > 1)
    {
      groups.push_back({ std::move(set), polygons[k], { origin } });
    }
    else
    {
      this->Places[k].push_back(static_cast<int>(this->Sets.size()));
      this->Sets.push_back(std::move(set));
    }
  }
  while (
    static_cast<int>(groups.size()) > wanted && MergeSmallest(groups, std::min(most, MostMerged)))
  {
  }
  const bool stillMany = onScale && static_cast<int>(groups.size()) > wanted &&
                         groups.size() * most > cells.GetKnots().size();
  for (Group& group : groups)
  {
    for (int origin : group.Origins)
    {
      if (stillMany)
      {
        inBands.push_back(origin);
      }
      else
      {
        this->Places[static_cast<std::size_t>(origin)].push_back(
          static_cast<int>(this->Sets.size()));
      }
    }
    if (!stillMany)
    {
      this->Sets.push_back(std::move(group.Set));
    }
  }
  this->FirstBand = this->Sets.size();
  this->AddBands(cells, inBands, mostMaterials);
  this->FirstBorder = this->Sets.size();
  this->AddBorders(cells, onBorders, polygons);
}

void PartSets::AddBorders(
  const CellMaterials& cells, const std::vector<int>& origins, const std::vector<double>& polygons)
{
  this->SlotOfClass.resize(polygons.size());
  const std::map<int, int> usual = FindUsualSlots(cells, origins, polygons);
  std::map<std::pair<int, int>, int> known; // the set of a class and a slot
  for (int origin : origins)
  {
    const auto place = static_cast<std::size_t>(origin);
    std::map<int, int>& slots = this->SlotOfClass[place];
    std::set<int> taken;
    for (int cls : cells.GetSets()[place])
    {
      slots[cls] = taken.insert(usual.at(cls)).second ? usual.at(cls) : -1;
    }
    for (auto& [cls, slot] : slots)
    {
      for (int next = 0; slot < 0; ++next)
      {
        slot = taken.insert(next).second ? next : -1;
      }
      const auto [set, isNew] =
        known.try_emplace({ cls, slot }, static_cast<int>(this->Sets.size()));
      if (isNew)
      {
        this->Sets.push_back({ cls });
        this->Slots.push_back(slot);
        this->NumberOfSlots = std::max(this->NumberOfSlots, slot + 1);
      }
      this->Places[place].push_back(set->second);
    }
  }
}

void PartSets::AddBands(
  const CellMaterials& cells, const std::vector<int>& origins, int mostMaterials)
{
  const int last = static_cast<int>(cells.GetKnots().size()); // materials count from 1
  for (int first = 1; first < last; first += mostMaterials - 1)
  {
    const int end = std::min(first + mostMaterials - 1, last);
    bool used = false;
    for (int origin : origins)
    {
      const CellMaterials::Set& set = cells.GetSets()[static_cast<std::size_t>(origin)];
      if (std::max(set.front(), first) < std::min(set.back(), end))
      {
        this->Places[static_cast<std::size_t>(origin)].push_back(
          static_cast<int>(this->Sets.size()));
        used = true;
      }
    }
    if (used)
    {
      CellMaterials::Set band(static_cast<std::size_t>(end - first) + 1);
      std::iota(band.begin(), band.end(), first);
      this->Sets.push_back(std::move(band));
    }
  }
}
} // namespace measuredbrdf
