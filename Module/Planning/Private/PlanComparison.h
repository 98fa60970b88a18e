// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How far a candidate is from the reference. Private to the module.
 */

#ifndef PlanComparison_h
#define PlanComparison_h

#include "PlanPairs.h"
#include "vtkDoubleArray.h"
#include "vtkRadianceIntegrator.h"
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
  /// What computed Reference, null before.
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
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
} // namespace measuredbrdf

#endif
