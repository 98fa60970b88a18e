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
  /// What computed Reference, null before. Another comparison may use it, too, with its error: what
  /// it prepared does not depend on the pairs.
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
};

/// Relative L1 over the pairs of all comparisons, with Uncertainty: two standard errors of their
/// sample, and the reference's own error. Picture: the largest of single pictures from the pairs'
/// cameras, the same where they have none.
struct PlanError
{
  double Error = 0.0;
  double Uncertainty = 0.0;
  double Picture = 0.0;
};

/// radiances: a candidate's, of each comparison's pairs.
PlanError Compare(const std::vector<const PlanComparison*>& comparisons,
  const std::vector<vtkDoubleArray*>& radiances);
} // namespace measuredbrdf

#endif
