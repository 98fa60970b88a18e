// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A bounding volume hierarchy of triangles. Splits by the surface area heuristic over bins (Wald
 * 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies"). Private to the module.
 */

#ifndef TriangleTree_h
#define TriangleTree_h

#include "TriangleSet.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace measuredbrdf
{
class TriangleTree
{
public:
  /// Orders the set's triangles anew. The set must stay.
  void Build(TriangleSet& triangles);

  /// The nearest hit, or with `any` the first one found; its triangle's index, or -1.
  std::int64_t Trace(TriangleSet::Ray ray, bool any, double& t, glm::dvec3& weights) const;

  std::size_t GetBytes() const { return this->Nodes.capacity() * sizeof(Node); }

private:
  /// 32 bytes. Inner: its two children are First and First + 1. Leaf: Count triangles from First
  /// on.
  struct Node
  {
    float Low[3];
    std::uint32_t First;
    float High[3];
    std::uint32_t Count; // 0: inner
  };
  struct Slabs;
  class Builder;

  const TriangleSet* Triangles = nullptr;
  std::vector<Node> Nodes;
};
} // namespace measuredbrdf

#endif
