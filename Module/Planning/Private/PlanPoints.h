// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a picture shows between the points that a plan for it is given. Private to the module.
 */

#ifndef PlanPoints_h
#define PlanPoints_h

#include "PlanPairs.h"
#include "vtkType.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace measuredbrdf
{
/// Some of a picture's pixels, each of which stands for those around it: pairs between it and the
/// nearest others are drawn as these show them, more where they differ, since a few of them may see
/// a lamp. Repeatable.
class PlanPoints
{
public:
  explicit PlanPoints(const PlanPairs& given);

  /// The points, and as many about each until there are at least so many. None without points.
  PlanPairs DrawAlike(vtkIdType count);

  /// So many more, about points around which two methods' difference or radiance varies most, by
  /// what both say of all pairs that were drawn before: in proportion to the deviation (Neyman
  /// 1934, "On the Two Different Aspects of the Representative Method").
  PlanPairs DrawWhereItVaries(
    const std::vector<double>& differences, const std::vector<double>& radiances, int count);

  /// Says of all pairs that were drawn, in their order, which points they lie about; and weighs
  /// them: those about a point share its weight, which is 1.
  void Weigh(PlanPairs& pairs) const;

private:
  static constexpr int Nearest = 8; // of pixels in rows: around one

  using Pair = std::array<glm::dvec3, 2>; // normal and view

  std::array<std::size_t, Nearest> FindNearest(std::size_t of) const;
  Pair DrawAbout(std::size_t point);
  double Draw();

  std::vector<Pair> Points;
  std::vector<std::array<std::size_t, Nearest>> Neighbors;
  std::vector<Pair> Middles;       // of the neighbors
  std::vector<std::size_t> Owners; // of all pairs: the point that they lie about
  std::mt19937 Engine;
};

/// So that neighbors follow each other: what a pair shows depends on its mirror direction and the
/// view's cosine. Samples in equal steps are spread over the picture then (Stevens, Olsen 2004,
/// "Spatially Balanced Sampling of Natural Resources").
std::vector<std::size_t> OrderByPlace(const PlanPairs& pairs);
} // namespace measuredbrdf

#endif
