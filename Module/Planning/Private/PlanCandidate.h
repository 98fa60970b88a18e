// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a planner tries, and in which order. Private to the module.
 */

#ifndef PlanCandidate_h
#define PlanCandidate_h

#include "PlanComparison.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadianceIntegrator.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <memory>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// A method (vtkRadianceMethods) with its sizes.
struct PlanCandidate : PlanError
{
  std::string Method;
  std::vector<int> Sizes;
  std::string Description;                           // the sizes in words
  double Cost = 0.0;                                 // of a pixel, times a table's
  bool MayBeChosen = true;                           // else it is only listed
  vtkIdType Bytes = 0;                               // of textures
  double SetUp = 0.0;                                // ms
  vtkSmartPointer<vtkRadianceIntegrator> Integrator; // null: to be made again
};

/// What to plan for.
struct PlanTask
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  double Tolerance = 0.0;
  bool All = false;           // also list what can't be chosen
  vtkIdType MaximumBytes = 0; // of textures
  double MaximumCost = 0.0;   // of a pixel, times a table's
  std::shared_ptr<vtkRadianceIntegrator::Precomputation> Shared;
};

/// The candidate's integrator, not prepared; null where its method is not known any more or does
/// not have these sizes.
vtkSmartPointer<vtkRadianceIntegrator> MakeIntegrator(
  const PlanCandidate& candidate, vtkBRDF* brdf, vtkEnvironment* environment);

/// The ladder: rungs in the order of their cost, those of the same cost in the order of their
/// textures' bytes. Each has its integrator. What costs or takes more than the task allows is left
/// out; givenUp: the cheapest of what costs too much, in words, or "".
std::vector<PlanCandidate> ListCandidates(const PlanTask& task, std::string& givenUp);
} // namespace measuredbrdf

#endif
