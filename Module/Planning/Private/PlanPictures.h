// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What single pictures of a sphere have of an error that is known in the mean over all views: a
 * camera that looks from where the light comes from sees the dark side of the environment, and one
 * across from a lamp sees it at grazing angles. Private to the module.
 */

#ifndef PlanPictures_h
#define PlanPictures_h

#include "PlanPairs.h"

#include <vector>

namespace measuredbrdf
{
/// Sums of differences and of references over the pairs as each of their cameras sees them.
///
/// A pixel's mirror direction is uniform over all directions, whatever the camera, and how the
/// error depends on the azimuth of the view about it matters little. So a pair counts for all
/// cameras that see its mirror direction at about its own angle, however far their directions are
/// from its own (a kernel estimate, Epanechnikov 1969; width: in degrees, of twice the view's
/// angle).
class PictureSums
{
public:
  explicit PictureSums(double width);

  /// differences, references: of the pairs, with their weights.
  void Add(const PlanPairs& pairs, const std::vector<double>& differences,
    const std::vector<double>& references);

  /// The relative error of each camera's picture, in units of that of all pairs; empty where there
  /// are no cameras, no pairs or no error.
  std::vector<double> GetRatios() const;

private:
  double Width; // in radians
  std::vector<double> Differences, References;
  double AllDifferences = 0.0;
  double AllReferences = 0.0;
};
} // namespace measuredbrdf

#endif
