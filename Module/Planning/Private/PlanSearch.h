// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A ladder of candidates, the climb to the cheapest within a tolerance, and what is said of it.
 * Private to the module.
 */

#ifndef PlanSearch_h
#define PlanSearch_h

#include "PlanComparison.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadianceIntegrator.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// What to plan for, while that is done.
struct PlanTask
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  double Tolerance = 0.0;
  bool All = false;           // also list what can't be chosen
  vtkIdType MaximumBytes = 0; // of textures
  double MaximumCost = 0.0;   // of a pixel, times a table's
  std::shared_ptr<vtkRadianceIntegrator::Precomputation> Shared;
  std::function<bool()> IsAborted = []() { return false; }; // asked now and then
  std::string Problem;                                      // why something failed
};

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

/// What a planner has found.
struct Plan
{
  std::vector<PlanCandidate> Candidates; // that were tried, in the order of the ladder
  int Choice = -1;
  int Interactive = -1; // the most accurate of those that cost little
  bool Meets = false;   // whether the choice is within the tolerance
  std::string Reason;
};

/// The candidate's integrator, not prepared; null where its method is not known any more or does
/// not have these sizes.
vtkSmartPointer<vtkRadianceIntegrator> MakeIntegrator(
  const PlanCandidate& candidate, vtkBRDF* brdf, vtkEnvironment* environment);

/// The ladder: rungs in the order of their cost, those of the same cost in the order of their
/// textures' bytes. Each has its integrator. What costs or takes more than the task allows is left
/// out; givenUp: the cheapest of what costs too much, in words, or "".
std::vector<PlanCandidate> ListCandidates(const PlanTask& task, std::string& givenUp);

///@{
/// Prepare the candidate's integrator with what the task's candidates share (SetUp grows by the
/// time), and integrate the light of pairs. False, with the task's Problem, where that failed or
/// was aborted.
bool Prepare(PlanTask& task, PlanCandidate& candidate);
bool Integrate(PlanTask& task, vtkRadianceIntegrator* integrator, const PlanPairs& pairs,
  vtkDoubleArray* radiance);
///@}

class PlanSearch
{
public:
  /// task and comparison stay the caller's.
  PlanSearch(PlanTask& task, const PlanComparison& comparison);

  /// Called with the share of the ladder that was tried.
  std::function<void(double)> Progress;

  /**
   * Try the rungs of the ladder, which is in the order of cost, up to the first one within the
   * tolerance. That is the choice; where there is none, the most accurate one is.
   *
   * Returns false, with the task's Problem, where it was aborted, or a method of the module failed.
   * A rung of a program's own that cannot be prepared is left out with a warning. So is one that
   * takes too many bytes with the textures of its material, without one.
   */
  bool Run(std::vector<PlanCandidate> ladder);

  /// Without a reason.
  const Plan& GetPlan() const { return this->Found; }

  /// What could not be prepared, one line each.
  const std::string& GetWarnings() const { return this->Warnings; }

private:
  bool Try(std::size_t rung);
  void Choose();
  /// Of what was tried and costs at most so much: the cheapest within the tolerance, or the most
  /// accurate where there is none; -1 where nothing may be chosen.
  int FindBest(double mostCost) const;

  PlanTask& Task;
  const PlanComparison& Comparison;
  std::vector<PlanCandidate> Ladder;
  std::vector<bool> Tried; // and not left out
  Plan Found;
  std::string Warnings;
};

/// Why the choice was chosen, one line. givenUp: the cheapest method that costs too much, or "".
std::string ExplainChoice(const Plan& plan, double tolerance, const std::string& givenUp);

/// The choice, its figures and the reason; "no plan yet" without a choice.
std::string DescribePlan(const Plan& plan);
} // namespace measuredbrdf

#endif
