// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How far a candidate is from the reference: over all pairs, and in the pictures of single cameras.
 */

#ifndef PlanComparison_h
#define PlanComparison_h

#include "PlanPairs.h"
#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace measuredbrdf
{
/// Some pairs and what they reflect, as nearly as the reference knows it.
struct PlanComparison
{
  PlanPairs Pairs;
  vtkSmartPointer<vtkDoubleArray> Reference; // 3 components a pair
  double ReferenceError = 0.0;               // relative, with two standard errors
};

/// Relative L1 over the pairs, with Uncertainty: two standard errors of the sample, and the
/// reference's own error.
struct PlanError
{
  double Error = 0.0;
  double Uncertainty = 0.0;
  /// The largest of single pictures from the pairs' cameras; Error where there are none.
  double Picture = 0.0;
  /// What 95 % and 99 % of the pixels stay within, relative to the mean radiance, by this sample.
  double Percentiles[2] = { 0.0, 0.0 };
};

/// radiance: a candidate's, of the comparison's pairs.
PlanError Compare(const PlanComparison& comparison, vtkDoubleArray* radiance);

/// The relative error of each camera's picture of a sphere, in units of that of all pairs; empty
/// where there are no cameras, no pairs or no error. A camera that looks from where the light comes
/// from sees the dark side of the environment, and one across from a lamp sees it at grazing
/// angles.
///
/// A pixel's mirror direction is uniform over all directions, whatever the camera, and how the
/// error depends on the azimuth of the view about it matters little. So a pair counts for all
/// cameras that see its mirror direction at about its own angle, however far their directions are
/// from its own (a kernel estimate, Epanechnikov 1969). width: in degrees, of twice the view's
/// angle. differences, references: of the pairs, with their weights.
std::vector<double> GetPictureRatios(const PlanPairs& pairs, double width,
  const std::vector<double>& differences, const std::vector<double>& references);
} // namespace measuredbrdf

#endif
