// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a planner tries, and in which order. Private to the module.
 */

#ifndef PlanCandidate_h
#define PlanCandidate_h

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
struct PlanCandidate
{
  std::string Method;
  std::vector<int> Sizes;
  std::string Description;                           // the sizes in words
  double Cost = 0.0;                                 // of a pixel, times a table's
  double Error = 0.0;                                // relative L1, with Uncertainty
  double Uncertainty = 0.0;                          // for what the pairs may miss
  double Picture = 0.0;                              // estimated: the most of a single picture
  bool OnBoth = false;                               // compared on a second sample, too
  bool MayBeChosen = true;                           // else it is only listed
  vtkIdType Bytes = 0;                               // of textures
  double SetUp = 0.0;                                // ms
  vtkSmartPointer<vtkRadianceIntegrator> Integrator; // null: to be made again
};

/// The size that its method gives first; 0 without one.
inline int GetMainSize(const PlanCandidate& candidate)
{
  return candidate.Sizes.empty() ? 0 : candidate.Sizes.front();
}

/// What to plan for.
struct PlanTask
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  double Tolerance = 0.0;
  bool All = false;           // also list what can't be chosen
  vtkIdType MaximumBytes = 0; // of textures
  std::shared_ptr<vtkRadianceIntegrator::Precomputation> Shared;
};

/// The candidate's integrator, not prepared; null where its method is not known any more or does
/// not have these sizes.
vtkSmartPointer<vtkRadianceIntegrator> MakeIntegrator(
  const PlanCandidate& candidate, vtkBRDF* brdf, vtkEnvironment* environment);

/// In the order to try them: by cost, those of one cost by the bytes of their textures. Each has
/// its integrator.
std::vector<PlanCandidate> ListCandidates(const PlanTask& task);
} // namespace measuredbrdf

#endif
