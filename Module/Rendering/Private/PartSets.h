// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sets of materials that a surface is divided by: those that meet in its polygons, merged where
 * there are too many of them. Private to the rendering room.
 *
 * On a scale of values, polygons where too many materials meet are of several sets: of bands, a few
 * neighbors on the scale each, which share the material where they meet. Each band's part draws the
 * pixels whose values are its own, so that every pixel shows the materials that meet there.
 */

#ifndef PartSets_h
#define PartSets_h

#include "CellMaterials.h"

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
class PartSets
{
public:
  /// mostMaterials: in a set; wanted: number of sets, where merging comes so far. Sets of one
  /// material stay alone.
  PartSets(const CellMaterials& cells, int mostMaterials, int wanted);

  const std::vector<CellMaterials::Set>& Get() const { return this->Sets; }

  /// The set, or the bands, of polygons of a set of cells.GetSets().
  const std::vector<int>& Find(int setOfCells) const
  {
    return this->Places[static_cast<std::size_t>(setOfCells)];
  }

  /// Whether only places between the set's first and last material are meant; beyond them, too,
  /// where these are the scale's first and last.
  bool IsBand(std::size_t set) const { return set >= this->FirstBand; }

  /// Polygons whose sets were cut to mostMaterials.
  std::size_t GetNumberOfDropped() const { return this->Dropped; }

private:
  void AddBands(const CellMaterials& cells, const std::vector<int>& origins, int mostMaterials);

  std::vector<CellMaterials::Set> Sets;
  std::size_t FirstBand = 0;
  std::vector<std::vector<int>> Places;
  std::size_t Dropped = 0;
};
} // namespace measuredbrdf

#endif
