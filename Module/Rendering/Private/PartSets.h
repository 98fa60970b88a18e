// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sets of materials that a surface is divided by: those that meet in its polygons, merged where
 * there are too many of them. Private to the rendering room.
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

  /// The set of polygons of a set of cells.GetSets().
  int Find(int setOfCells) const { return this->Places[static_cast<std::size_t>(setOfCells)]; }

  /// Polygons whose sets were cut to mostMaterials.
  std::size_t GetNumberOfDropped() const { return this->Dropped; }

private:
  std::vector<CellMaterials::Set> Sets;
  std::vector<int> Places;
  std::size_t Dropped = 0;
};
} // namespace measuredbrdf

#endif
