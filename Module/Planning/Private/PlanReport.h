// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A plan in words. Private to the module.
 */

#ifndef PlanReport_h
#define PlanReport_h

#include "PlanSearch.h"

#include <string>

namespace measuredbrdf
{
/// Why the choice was chosen, one line. givenUp: the cheapest method that costs too much, or "".
std::string ExplainChoice(const Plan& plan, double tolerance, const std::string& givenUp);

/// The choice, its figures and the reason; "no plan yet" without a choice.
std::string DescribePlan(const Plan& plan);
} // namespace measuredbrdf

#endif
