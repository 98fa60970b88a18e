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
 *
 * Polygons with corners of several classes are of a set for each class, which draws the pixels that
 * are nearest to corners of that class. Its weight has a slot that no other class has in these
 * polygons. The sets of a class differ in the slot.
 */

#ifndef PartSets_h
#define PartSets_h

#include "CellMaterials.h"

#include <cstddef>
#include <map>
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
  bool IsBand(std::size_t set) const { return set >= this->FirstBand && !this->IsBorder(set); }

  ///@{
  /// Weights of classes have few slots: the components of a vertex attribute. So not more classes
  /// than this may meet in a polygon.
  static constexpr std::size_t MaximumNumberOfSlots = 4;

  /// Whether a set is of the places of one class in polygons of several; the slot of its weight.
  bool IsBorder(std::size_t set) const { return set >= this->FirstBorder; }
  int GetSlot(std::size_t set) const { return this->Slots[set - this->FirstBorder]; }
  int GetNumberOfSlots() const { return this->NumberOfSlots; }
  ///@}

  /// Of the weight that a class has in polygons of a set of cells.GetSets(), of several classes.
  int FindSlot(int setOfCells, int cls) const
  {
    return this->SlotOfClass[static_cast<std::size_t>(setOfCells)].at(cls);
  }

  /// Polygons whose sets were cut to mostMaterials.
  std::size_t GetNumberOfDropped() const { return this->Dropped; }

private:
  void AddBorders(const CellMaterials& cells, const std::vector<int>& origins,
    const std::vector<double>& polygons);
  void AddBands(const CellMaterials& cells, const std::vector<int>& origins, int mostMaterials);

  std::vector<CellMaterials::Set> Sets;
  std::size_t FirstBand = 0;
  std::size_t FirstBorder = 0;
  std::vector<int> Slots; // of each set from FirstBorder on
  int NumberOfSlots = 0;
  std::vector<std::map<int, int>> SlotOfClass; // of each set of the cells
  std::vector<std::vector<int>> Places;
  std::size_t Dropped = 0;
};
} // namespace measuredbrdf

#endif
