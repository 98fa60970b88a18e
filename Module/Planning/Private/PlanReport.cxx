// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanReport.h"

#include "NumberText.h"

#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr vtkIdType SmallTexture = 4000000; // bytes; the reason says why a plan takes more
const char* const Table = "table";          // the method that it is compared with

std::string Percent(double value) { return NumberText(100.0 * value, 2) + " %"; }

// What the best of the small tables that were tried had.
std::string ExplainMemory(const Plan& plan)
{
  const PlanCandidate& chosen = plan.Candidates[static_cast<std::size_t>(plan.Choice)];
  const PlanCandidate* small = nullptr;
  for (const PlanCandidate& candidate : plan.Candidates)
  {
    const bool fits = candidate.Method == Table && candidate.Bytes <= SmallTexture;
    small = fits && (!small || candidate.Error < small->Error) ? &candidate : small;
  }
  if (chosen.Bytes <= SmallTexture || !small)
  {
    return "";
  }
  const std::string needs = chosen.Method == Table
                              ? "gloss needs " + std::to_string(chosen.Sizes[0]) + " rows"
                              : "it needs more than a table";
  return "; " + needs + ": the best table within 4 MB, " + small->Description + ", has " +
         Percent(small->Error);
}
}

std::string ExplainChoice(const Plan& plan, double tolerance)
{
  const std::size_t choice = static_cast<std::size_t>(plan.Choice);
  std::string reason;
  const PlanCandidate& chosen = plan.Candidates[choice];
  if (plan.Meets && plan.First >= 0 && plan.First != plan.Choice)
  {
    const PlanCandidate& first = plan.Candidates[static_cast<std::size_t>(plan.First)];
    reason = "the first candidate, by cost and size, within " + Percent(tolerance) +
             " may have up to " + Percent(first.Picture) + " in a single picture; this one " +
             (chosen.Picture <= tolerance ? "is within " + Percent(tolerance) + " there, too"
                                          : "may have up to " + Percent(chosen.Picture) + " there");
  }
  else if (plan.Meets)
  {
    const PlanCandidate* before = choice > 0 ? &plan.Candidates[choice - 1] : nullptr;
    reason = "the first candidate, by cost and size, within " + Percent(tolerance) +
             (before ? ": the one before has " + Percent(before->Error) : std::string());
    if (chosen.Picture > tolerance)
    {
      reason += "; that is the mean over all views: a single picture may have up to " +
                Percent(chosen.Picture);
    }
  }
  else
  {
    reason = "nothing that the search tried is within " + Percent(tolerance) +
             "; this is the most accurate for its cost, with " + Percent(chosen.Error);
  }
  return reason + ExplainMemory(plan);
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
  const std::string costs = ", " + FixedText(1e-6 * static_cast<double>(chosen.Bytes), 1) +
                            " MB, set up in " + FixedText(chosen.SetUp, 0) + " ms: ";
  const std::string pictures = chosen.Picture > chosen.Error
                                 ? ", up to " + Percent(chosen.Picture) + " in a single picture"
                                 : "";
  return chosen.Method + ", " + chosen.Description + error + pictures + costs + plan.Reason;
}
} // namespace measuredbrdf
