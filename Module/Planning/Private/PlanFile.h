// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A plan as bytes, to be kept on disk. Private to the module.
 */

#ifndef PlanFile_h
#define PlanFile_h

#include "PlanSearch.h"

#include <string>

namespace measuredbrdf
{
/// One line of counts, one line for each candidate, the reason, then what the choice has prepared.
/// "" for a plan with methods of the program's own: nobody knows whether they are the same in the
/// next program.
std::string WritePlan(const Plan& plan);

/// The plan with its choice prepared; false, nothing changed, where the bytes are not such a plan
/// for this material and environment.
bool ReadPlan(const std::string& bytes, vtkBRDF* brdf, vtkEnvironment* environment, Plan& plan);
} // namespace measuredbrdf

#endif
