// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartSets.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
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
    if (set.size() > 1)
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
