// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The steps of a plan, in their order: list the candidates, draw the pairs to compare them on,
 * compute a reference there, climb to the cheapest candidate within the tolerance, and put the
 * choice into words.
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
#include <stdexcept>
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
};

/// Why there is no plan; thrown by what follows, also where it was aborted.
class PlanFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
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
  std::string Warnings; // what could not be prepared, one line each
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
/// time), and integrate the light of pairs.
void Prepare(const PlanTask& task, PlanCandidate& candidate);
vtkSmartPointer<vtkDoubleArray> Integrate(
  const PlanTask& task, vtkRadianceIntegrator* integrator, const PlanPairs& pairs);
///@}

/// How many pairs candidates are compared on.
constexpr int PairsToCompare = 512;

/// Of more pairs than PairsToCompare, about that many: drawn by how much two cheap candidates
/// differ, by radiance, by weight, and some of all alike. Weights make up for it: sums are unbiased
/// for all pairs that were drawn (Horvitz, Thompson 1952, "A Generalization of Sampling Without
/// Replacement from a Finite Universe"). The two candidates are the first of the module's own and
/// the first of its method that is larger; they are prepared for it. Where there are no such two,
/// all pairs are alike. Repeatable.
void SamplePairs(const PlanTask& task, std::vector<PlanCandidate>& candidates, PlanPairs& pairs);

/// Such a sample of about so many pairs, by what two methods say that they reflect (null: all pairs
/// are alike).
PlanPairs ChoosePairs(
  const PlanPairs& pairs, vtkDoubleArray* coarse, vtkDoubleArray* fine, int count);

/// Largest number of suns and lamps that are lights of their own.
constexpr int MostReferenceSuns = 64;

/**
 * Find what the comparison's pairs reflect, and measure on some of them how far that is from the
 * truth (ReferenceError, relative L1 with two standard errors): by a sum over lights for an
 * isotropic material of which nothing is sharper than a light is wide, and which half as many
 * lights reflect nearly alike; else by the adaptive integral, each pair to half the tolerance that
 * plans are made for, at most 1 %, against an eighth of that. Returns what computed the
 * comparison's Reference.
 */
vtkSmartPointer<vtkRadianceIntegrator> MakeReference(
  const PlanTask& task, PlanComparison& comparison);

/**
 * Try the rungs of the ladder, which is in the order of cost, up to the first one within the
 * tolerance. That is the choice; where there is none, the most accurate one is. progress is called
 * with the share of the ladder that was tried; it may be empty.
 *
 * A rung of a program's own that cannot be prepared is left out with a warning. So is one that
 * takes too many bytes with the textures of its material, without one. The plan has the warnings
 * also where this throws.
 */
void Climb(const PlanTask& task, const PlanComparison& comparison,
  std::vector<PlanCandidate> ladder, Plan& plan,
  const std::function<void(double)>& progress = nullptr);

/// Why the choice was chosen, one line. givenUp: the cheapest method that costs too much, or "".
std::string ExplainChoice(const Plan& plan, double tolerance, const std::string& givenUp);

/// The choice, its figures and the reason; "no plan yet" without a choice.
std::string DescribePlan(const Plan& plan);
} // namespace measuredbrdf

#endif
