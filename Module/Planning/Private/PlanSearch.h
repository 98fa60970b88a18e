// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The search for the cheapest candidate within a tolerance. Private to the module.
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
  std::vector<PlanCandidate> Candidates; // that were tried, in this order
  int Choice = -1;
  int First = -1;     // that met the tolerance; the choice, or what that replaced for pictures
  bool Meets = false; // the tolerance
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

  /// Asked for other pairs when a choice may be luck: the best of many on the same pairs looks
  /// better than it is. Null: there are none. It stays the caller's.
  std::function<const PlanComparison*()> GetSecond;

  /// Called with the share of the candidates that are done.
  std::function<void(double)> Progress;

  /// Try candidates in their order until one is within the tolerance, but for those that the others
  /// show not to help. One that misses it by no more than what stands for chance is compared on the
  /// second pairs before any that costs clearly more is tried; where chance may be all on both,
  /// long frames are left out. Where nothing is within the tolerance, the largest that were left
  /// out as no help are tried in the end. Where single pictures may have more than the tolerance,
  /// those after the first within it that take no longer a frame and little memory are tried, too.
  /// If all are wanted, the others come last, and the choice stays. Returns false where it was
  /// aborted, or a candidate of the module failed.
  bool Run(const std::vector<PlanCandidate>& candidates);

  /// Without a reason.
  const Plan& GetPlan() const { return this->Found; }

  /// Why Run returned false, or "".
  const std::string& GetProblem() const { return this->Problem; }

  /// What methods of the program's own could not be prepared, one line each; they are left out.
  const std::string& GetWarnings() const { return this->Warnings; }

private:
  const PlanCandidate& GetChoice() const
  {
    return this->Found.Candidates[static_cast<std::size_t>(this->Found.Choice)];
  }
  bool Search(const std::vector<PlanCandidate>& candidates);
  bool TryOthers(const std::vector<PlanCandidate>& candidates);
  void SayProgress(std::size_t done, std::size_t all, bool others) const;
  bool IsWorthTrying(const PlanCandidate& candidate) const;
  bool IsAffordable(const PlanCandidate& candidate) const;
  bool MayHoldPictures(const PlanCandidate& candidate) const;
  bool CanPrune(const PlanCandidate& candidate, double error) const;
  bool IsBetterInPictures(const PlanCandidate& candidate) const;
  bool IsTooLong(const PlanCandidate& candidate) const;
  bool Try(PlanCandidate candidate, bool mayBeChosen = true);
  bool Prepare(PlanCandidate& candidate, bool mayBeChosen);
  bool Integrate(PlanCandidate& candidate, const PlanPairs& pairs, vtkDoubleArray* radiance);
  bool MayBeLuck(const PlanCandidate& candidate) const;
  bool Check(PlanCandidate& candidate);
  bool IsNearMiss() const;
  bool CheckChoice();
  void Take(const PlanCandidate& candidate);
  bool TrySkipped(const std::vector<PlanCandidate>& skipped);

  const PlanTask& Task;
  const PlanComparison& First;
  IsAborted Aborted;
  Plan Found;
  std::string Problem;
  std::string Warnings;
  int Tried = 0;
  double ShortestFrame = 0.0; // by cost
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
