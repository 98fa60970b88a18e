// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles of a set in Embree 3 or 4 (Wald et al. 2014), which shares their memory. Private to
 * the module.
 */

#ifndef EmbreeScene_h
#define EmbreeScene_h

#include "TriangleSet.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace measuredbrdf
{
class EmbreeScene
{
public:
  EmbreeScene();
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  void operator=(const EmbreeScene&) = delete;

  /// Whether this build has Embree.
  static bool IsAvailable();

  /// The set must stay, unchanged. Returns false where Embree cannot, for want of memory say.
  bool Build(const TriangleSet& triangles);

  /// As TriangleTree::Trace.
  std::int64_t Trace(const TriangleSet::Ray& ray, bool any, double& t, glm::dvec3& weights) const;

  std::size_t GetBytes() const;

private:
  struct Internals;
  std::unique_ptr<Internals> Data;
};
} // namespace measuredbrdf

#endif
