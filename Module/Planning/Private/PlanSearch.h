// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The climb to the cheapest rung within a tolerance. Private to the module.
 */

#ifndef PlanSearch_h
#define PlanSearch_h

#include "PlanCandidate.h"
#include "PlanComparison.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// What a planner has found.
struct Plan
{
  std::vector<PlanCandidate> Candidates; // that were tried, in the order of the ladder
  int Choice = -1;
  int Interactive = -1; // the most accurate of those that cost little
  bool Meets = false;   // whether the choice is within the tolerance
  std::string Reason;
};

/// Asked now and then by the thread that plans; true stops the work.
using IsAborted = std::function<bool()>;

/// The candidate's integrator prepared with what the task's candidates share; SetUp grows by the
/// time. False, with a problem in words, where that failed or was aborted.
bool PrepareCandidate(
  const PlanTask& task, const IsAborted& isAborted, PlanCandidate& candidate, std::string& problem);

class PlanSearch
{
public:
  /// task and comparison stay the caller's.
  PlanSearch(const PlanTask& task, const PlanComparison& comparison, IsAborted isAborted);

  /// Called with the share of the ladder that was tried.
  std::function<void(double)> Progress;

  /**
   * Try rungs of the ladder, which is in the order of cost. The two lowest come first, which drew
   * the pairs and are prepared. Where both miss the tolerance, the climb goes on at the lowest rung
   * that has lamps as lights, if the light has lamps. It ends at the first rung within the
   * tolerance, and steps down again from there while the next lower one is within it, too. The
   * cheapest rung within the tolerance is the choice; where there is none, the most accurate.
   *
   * Returns false where it was aborted, or a method of the module failed. A rung of a program's own
   * that cannot be prepared is left out with a warning. So is one that takes too many bytes with
   * the textures of its material, without one.
   */
  bool Run(std::vector<PlanCandidate> ladder);

  /// Without a reason.
  const Plan& GetPlan() const { return this->Found; }

  /// Why Run returned false, or "".
  const std::string& GetProblem() const { return this->Problem; }

  /// What could not be prepared, one line each.
  const std::string& GetWarnings() const { return this->Warnings; }

private:
  bool Climb();
  bool Try(std::size_t rung);
  bool IsWithin(std::size_t rung) const;
  void Choose();

  const PlanTask& Task;
  const PlanComparison& Comparison;
  IsAborted Aborted;
  std::vector<PlanCandidate> Ladder;
  std::vector<bool> Tried; // and not left out
  Plan Found;
  std::string Problem;
  std::string Warnings;
};

/// Hands an abort on to an integrator at work, whose errors it keeps.
class AbortForwarder
{
public:
  AbortForwarder(
    const IsAborted& isAborted, vtkRadianceIntegrator* integrator, std::string& problem);
  ~AbortForwarder();
  AbortForwarder(const AbortForwarder&) = delete;
  void operator=(const AbortForwarder&) = delete;

private:
  void OnProgress(vtkObject*, unsigned long, void*);
  void OnError(vtkObject*, unsigned long, void* text);

  const IsAborted& Aborted;
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
  std::string& Problem;
  unsigned long Tags[2];
};
} // namespace measuredbrdf

#endif
