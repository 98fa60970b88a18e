// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The (normal, view) pairs on which a planner compares its candidates: those of a sphere from
 * everywhere, or of a picture.
 */

#ifndef PlanPairs_h
#define PlanPairs_h

#include "ExtractedEmitters.h"
#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace measuredbrdf
{
struct PlanPairs
{
  vtkSmartPointer<vtkDoubleArray> Normals; // unit vectors
  vtkSmartPointer<vtkDoubleArray> Views;   // as many unit vectors
  std::vector<double> Weights;             // of the pairs; none: 1 each
  std::vector<std::size_t> Points;         // that they lie about; none: each its own
  std::vector<double> Cameras; // three components each, whose pictures count; none: all is one
  std::vector<double> Ratios;  // what they have of a cheap method's error (GetPictureRatios)
};

/// Arrays without tuples.
PlanPairs MakeEmptyPairs();

/// Cameras around a sphere, whose pictures count for plans for all views: the directions towards a
/// cube's faces and corners, three components each.
std::vector<double> GetPictureCameras();

/// So many normals as a sphere shows them to distant cameras everywhere, uniform over its disc, but
/// many of them near the rim, where radiance is steep, and half of them where its mirror directions
/// see one of the lamps, the more the closer, down to less than any lobe's width. Weights make up
/// for both.
PlanPairs DrawSpherePairs(int count, const std::vector<ExtractedEmitters::Light>& lamps = {});

/// Turned by a rotation, whose columns follow each other.
void Turn(const double columns[9], PlanPairs& pairs);

/// Weights scaled so that their sum is count, but each at most so much.
std::vector<double> ScaleToSum(std::vector<double> weights, double count, double most);

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
  void AddPairAbout(std::size_t point, PlanPairs& pairs);
  double Draw();

  std::vector<Pair> Points;
  std::vector<std::array<std::size_t, Nearest>> Neighbors;
  std::vector<std::size_t> Owners; // of all pairs: the point that they lie about
  std::mt19937 Engine;
};
} // namespace measuredbrdf

#endif
