// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The groups of materials that a surface is divided by.
 *
 * A group is drawn by one shader, which evaluates all of its materials. Polygons where the same
 * materials meet are of one group; where there are too many groups, some are merged.
 *
 * Two kinds of polygons are drawn by several groups, each of which keeps some of the pixels:
 * On a scale of values, polygons where too many materials meet are of several bands, a few
 * neighbors on the scale each, which share the material where they meet. A band keeps the pixels
 * whose values are its own. Polygons with corners of several classes, which were not cut, are of a
 * group for each class. It keeps the pixels that are nearest to corners of that class. For that
 * each corner has one weight, 1, in a slot that its class shares with no other class of the
 * polygon.
 */

#ifndef MaterialPartition_h
#define MaterialPartition_h

#include "PolygonMaterials.h"

#include <cstddef>
#include <map>
#include <vector>

namespace measuredbrdf
{
struct MaterialPartition
{
  /// mostMaterials: in a group; wanted: number of groups, where merging comes so far. Groups of one
  /// material stay alone.
  MaterialPartition(const PolygonMaterials& polygons, int mostMaterials, int wanted);

  /// Weights of classes have few slots: the components of a vertex attribute. So not more classes
  /// than this may meet in a polygon.
  static constexpr std::size_t MaximumNumberOfSlots = 4;

  struct Group
  {
    PolygonMaterials::Set Materials;
    bool IsBand = false;
    int Slot = -1; // of the weight of a class among others; -1: all polygons are the group's alone
  };

  std::vector<Group> Groups;
  std::vector<std::vector<int>> GroupsOf;      // of polygons of each of PolygonMaterials' sets
  std::vector<std::map<int, int>> SlotOfClass; // the same, of several classes
  int NumberOfSlots = 0;
  std::size_t Dropped = 0; // polygons whose materials were cut to mostMaterials

private:
  void Add(std::size_t set, Group group);
  void AddBands(
    const PolygonMaterials& polygons, const std::vector<std::size_t>& sets, int mostMaterials);
};
} // namespace measuredbrdf

#endif
