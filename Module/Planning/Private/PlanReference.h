// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the planner measures its candidates against: nearly exact, in a few hundred milliseconds.
 * Private to the module.
 */

#ifndef PlanReference_h
#define PlanReference_h

#include "PlanCandidate.h"
#include "PlanComparison.h"
#include "PlanSearch.h" // for IsAborted

#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadianceIntegrator.h"
#include "vtkSmartPointer.h"

#include <atomic>
#include <memory>
#include <string>

namespace measuredbrdf
{
/// For broad lobes a sum over lights (LightsReference); for isotropic ones with a sharp part
/// the adaptive integral, each pair to half the tolerance that plans are made for, at most 1 %: the
/// mean is far more accurate than that. Whether abort was set has to be asked afterwards.
vtkSmartPointer<vtkRadianceIntegrator> NewPlanReference(vtkBRDF* brdf, vtkEnvironment* environment,
  double tolerance, const std::shared_ptr<vtkRadianceIntegrator::Precomputation>& shared,
  const std::atomic<bool>& abort);

/// What the comparison's pairs reflect by it, and how far that may be from the truth. True where
/// that is known; false where there are no pairs or, with a problem in words, where that failed or
/// was aborted.
bool MakeReference(const PlanTask& task, const IsAborted& isAborted, const std::atomic<bool>& abort,
  PlanComparison& comparison, std::string& problem);
} // namespace measuredbrdf

#endif
