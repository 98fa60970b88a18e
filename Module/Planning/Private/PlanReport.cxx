// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanReport.h"

#include "NumberText.h"

#include <cstddef>

namespace measuredbrdf
{
namespace
{
std::string Percent(double value) { return NumberText(100.0 * value, 2) + " %"; }
}

std::string ExplainChoice(const Plan& plan, double tolerance, const std::string& givenUp)
{
  const std::size_t choice = static_cast<std::size_t>(plan.Choice);
  const PlanCandidate& chosen = plan.Candidates[choice];
  if (!plan.Meets)
  {
    return "no method that was tried is within " + Percent(tolerance) +
           "; this one is the most accurate, with " + Percent(chosen.Error) +
           (givenUp.empty() ? "" : "; " + givenUp + ", costs more than MaximumCost");
  }
  std::string reason = "the cheapest within " + Percent(tolerance);
  for (std::size_t k = choice; k > 0; --k)
  {
    if (plan.Candidates[k - 1].MayBeChosen)
    {
      const PlanCandidate& cheaper = plan.Candidates[k - 1];
      reason +=
        ": " + cheaper.Method + ", " + cheaper.Description + ", has " + Percent(cheaper.Error);
      break;
    }
  }
  return reason + (chosen.Picture > tolerance
                      ? "; that is the mean over all views: a single picture may have up to " +
                          Percent(chosen.Picture)
                      : "");
}

std::string DescribePlan(const Plan& plan)
{
  if (plan.Choice < 0)
  {
    return "no plan yet";
  }
  const PlanCandidate& chosen = plan.Candidates[static_cast<std::size_t>(plan.Choice)];
  const std::string error = ", error " + Percent(chosen.Error) + " (" +
                            NumberText(100.0 * (chosen.Error - chosen.Uncertainty), 2) + " + " +
                            NumberText(100.0 * chosen.Uncertainty, 2) + " for chance)";
  const std::string percentiles = ", 95 % of the pixels within " + Percent(chosen.Percentiles[0]) +
                                  ", 99 % within " + Percent(chosen.Percentiles[1]);
  const std::string costs = ", " + FixedText(1e-6 * static_cast<double>(chosen.Bytes), 1) +
                            " MB, set up in " + FixedText(chosen.SetUp, 0) + " ms: ";
  const std::string pictures = chosen.Picture > chosen.Error
                                 ? ", up to " + Percent(chosen.Picture) + " in a single picture"
                                 : "";
  std::string interactive;
  if (plan.Interactive >= 0 && plan.Interactive != plan.Choice)
  {
    const PlanCandidate& other = plan.Candidates[static_cast<std::size_t>(plan.Interactive)];
    interactive = "; while one interacts and that takes too long: " + other.Method + ", " +
                  other.Description + ", with " + Percent(other.Error);
  }
  return chosen.Method + ", " + chosen.Description + error + percentiles + pictures + costs +
         plan.Reason + interactive;
}
} // namespace measuredbrdf
