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

#include <atomic>
#include <string>

namespace measuredbrdf
{
/**
 * What the comparison's pairs reflect, by its Integrator. Where it has none, this chooses one and
 * measures on some of the pairs how far it is from the truth (ReferenceError, relative L1 with two
 * standard errors): a sum over lights (LightsReference) for an isotropic material of which nothing
 * is sharper than a light is wide, and which half as many lights reflect nearly alike; else the
 * adaptive integral, each pair to half the tolerance that plans are made for, at most 1 %, against
 * an eighth of that.
 *
 * False where there are no pairs or, with a problem in words, where that failed or was aborted.
 */
bool MakeReference(const PlanTask& task, const IsAborted& isAborted, const std::atomic<bool>& abort,
  PlanComparison& comparison, std::string& problem);
} // namespace measuredbrdf

#endif
