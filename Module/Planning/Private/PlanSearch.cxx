// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanSearch.h"

#include "MaterialPrecomputation.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkRadianceMethods.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr double FarAway = 3.0; // times the tolerance: where last resorts are tried
constexpr double WorthIt = 0.9; // of another's error, to be worth more cost
constexpr int Few = 3;          // so many tried, and luck does not matter
constexpr double Dearer = 1.05; // times another's cost
// Times the shortest frame: longer ones are not for what chance alone may have missed.
constexpr double LongFrame = 2.0;

// To hold in single pictures, too, what meets the tolerance in the mean: without a longer frame, in
// so many bytes, and where that does not suffice, for two thirds of a
// picture's error.
constexpr double AsDear = 1.001;
constexpr vtkIdType LittleMemory = 4000000;
constexpr double PictureWorthIt = 1.5;

// Where the tolerance is missed, textures beyond so many bytes have to leave two thirds of the
// error.
constexpr vtkIdType ManyBytes = 12000000;
constexpr double MemoryWorthIt = 1.5;

double GetMemoryFactor(const PlanCandidate& candidate)
{
  return candidate.Bytes > ManyBytes ? MemoryWorthIt : 1.0;
}

// Of those that were skipped: the largest, within that memory if there is one.
bool IsBetterLastResort(const PlanCandidate& candidate, const PlanCandidate& other)
{
  const double factor = GetMemoryFactor(candidate);
  const double known = GetMemoryFactor(other);
  return factor < known || (factor == known && candidate.Bytes >= other.Bytes);
}

// To be worth its cost beside another that misses the tolerance, too.
double GetErrorWorthIt(const PlanCandidate& candidate, const PlanCandidate& other)
{
  return WorthIt * other.Error * GetMemoryFactor(other) / GetMemoryFactor(candidate);
}
}

AbortForwarder::AbortForwarder(
  const IsAborted& isAborted, vtkRadianceIntegrator* integrator, std::string& problem)
  : Aborted(isAborted)
  , Integrator(integrator)
  , Problem(problem)
{
  this->Tags[0] =
    integrator->AddObserver(vtkCommand::ProgressEvent, this, &AbortForwarder::OnProgress);
  this->Tags[1] = integrator->AddObserver(vtkCommand::ErrorEvent, this, &AbortForwarder::OnError);
}

AbortForwarder::~AbortForwarder()
{
  this->Integrator->RemoveObserver(this->Tags[0]);
  this->Integrator->RemoveObserver(this->Tags[1]);
}

void AbortForwarder::OnProgress(vtkObject*, unsigned long, void*)
{
  if (this->Aborted())
  {
    this->Integrator->SetAbort(true);
  }
}

void AbortForwarder::OnError(vtkObject*, unsigned long, void* text)
{
  this->Problem = text ? static_cast<const char*>(text) : "";
}

bool PrepareCandidate(
  const PlanTask& task, const IsAborted& isAborted, PlanCandidate& candidate, std::string& problem)
{
  const auto start = std::chrono::steady_clock::now();
  const AbortForwarder supervision(isAborted, candidate.Integrator, problem);
  candidate.Integrator->SetPrecomputation(task.Shared);
  const bool prepared = candidate.Integrator->Prepare();
  candidate.Integrator->SetPrecomputation(nullptr); // it may go to another thread
  const auto end = std::chrono::steady_clock::now();
  candidate.SetUp += std::chrono::duration<double, std::milli>(end - start).count();
  return prepared;
}

PlanSearch::PlanSearch(const PlanTask& task, const PlanComparison& comparison, IsAborted isAborted)
  : Task(task)
  , First(comparison)
  , Aborted(std::move(isAborted))
{
}

bool PlanSearch::Run(const std::vector<PlanCandidate>& candidates)
{
  this->ShortestFrame = HUGE_VAL;
  for (const PlanCandidate& candidate : candidates)
  {
    this->ShortestFrame = std::min(this->ShortestFrame, candidate.Cost);
  }
  return this->Search(candidates) && (!this->Task.All || this->TryOthers(candidates)) &&
         !this->Aborted();
}

bool PlanSearch::Search(const std::vector<PlanCandidate>& candidates)
{
  std::vector<PlanCandidate> skipped; // the largest of each method
  for (std::size_t k = 0; k < candidates.size() && !this->Aborted(); ++k)
  {
    const PlanCandidate& candidate = candidates[k];
    if (!candidate.MayBeChosen || !this->IsWorthTrying(candidate))
    {
      continue;
    }
    if (this->Found.Meets) // others cost more
    {
      if (this->MayHoldPictures(candidate) && !this->Try(candidate))
      {
        return false;
      }
    }
    else if (this->CanPrune(candidate, this->Task.Tolerance))
    {
      const auto known = std::find_if(skipped.begin(), skipped.end(),
        [&candidate](const PlanCandidate& other) { return other.Method == candidate.Method; });
      if (known == skipped.end())
      {
        skipped.push_back(candidate);
      }
      else if (IsBetterLastResort(candidate, *known))
      {
        *known = candidate;
      }
    }
    else
    {
      const bool isDearer = this->IsNearMiss() && candidate.Cost > Dearer * this->GetChoice().Cost;
      if (isDearer && !this->CheckChoice())
      {
        return false;
      }
      if (!this->Found.Meets && !this->IsTooLong(candidate) && !this->Try(candidate))
      {
        return false;
      }
    }
    this->SayProgress(k + 1, candidates.size(), false);
  }
  return this->TrySkipped(skipped) && this->CheckChoice();
}

// Those that the search left out; the choice stays.
bool PlanSearch::TryOthers(const std::vector<PlanCandidate>& candidates)
{
  std::vector<PlanCandidate> searched;
  searched.swap(this->Found.Candidates);
  const int choice = this->Found.Choice;
  const int first = this->Found.First;
  for (std::size_t k = 0; k < candidates.size() && !this->Aborted(); ++k)
  {
    const auto known = std::find_if(searched.begin(), searched.end(),
      [&](const PlanCandidate& other)
      { return other.Method == candidates[k].Method && other.Sizes == candidates[k].Sizes; });
    const int number = static_cast<int>(this->Found.Candidates.size());
    if (known != searched.end())
    {
      const int before = static_cast<int>(known - searched.begin());
      this->Found.Choice = before == choice ? number : this->Found.Choice;
      this->Found.First = before == first ? number : this->Found.First;
      this->Found.Candidates.push_back(*known);
    }
    else if (!this->Try(candidates[k], false))
    {
      return false;
    }
    this->SayProgress(k + 1, candidates.size(), true);
  }
  return true;
}

// others: of the second half of the work, where all are tried.
void PlanSearch::SayProgress(std::size_t done, std::size_t all, bool others) const
{
  if (this->Progress)
  {
    const double share = static_cast<double>(done) / static_cast<double>(all);
    this->Progress(!this->Task.All ? share : 0.5 * (share + (others ? 1.0 : 0.0)));
  }
}

bool PlanSearch::IsWorthTrying(const PlanCandidate& candidate) const
{
  return this->Found.Choice < 0 || !candidate.Integrator->IsLastResort() ||
         this->GetChoice().Error >= FarAway * this->Task.Tolerance;
}

// Beside a choice that meets the tolerance.
bool PlanSearch::IsAffordable(const PlanCandidate& candidate) const
{
  return candidate.Bytes <= LittleMemory && candidate.Cost <= AsDear * this->GetChoice().Cost;
}

bool PlanSearch::MayHoldPictures(const PlanCandidate& candidate) const
{
  const PlanCandidate& choice = this->GetChoice();
  return choice.Picture > this->Task.Tolerance && this->IsAffordable(candidate) &&
         !this->CanPrune(candidate,
           choice.Error * std::max(this->Task.Tolerance / choice.Picture, 1.0 / PictureWorthIt));
}

// In single pictures, than a choice that meets the tolerance.
bool PlanSearch::IsBetterInPictures(const PlanCandidate& candidate) const
{
  const PlanCandidate& choice = this->GetChoice();
  return choice.Picture > this->Task.Tolerance && this->IsAffordable(candidate) &&
         candidate.Error <= this->Task.Tolerance &&
         candidate.Picture <= std::max(this->Task.Tolerance, choice.Picture / PictureWorthIt);
}

bool PlanSearch::CanPrune(const PlanCandidate& candidate, double error) const
{
  std::vector<vtkRadianceIntegrator::Attempt> attempts;
  for (const PlanCandidate& tried : this->Found.Candidates)
  {
    const std::vector<int> sizes =
      tried.Method == candidate.Method
        ? tried.Sizes
        : candidate.Integrator->GetEquivalentSizes(tried.Method, tried.Sizes);
    if (!sizes.empty())
    {
      attempts.push_back({ sizes, tried.Error });
    }
  }
  return candidate.Integrator->CanPrune(attempts, error);
}

// In the order of the methods.
bool PlanSearch::TrySkipped(const std::vector<PlanCandidate>& skipped)
{
  for (const vtkSmartPointer<vtkRadianceIntegrator>& method : vtkRadianceMethods::GetMethods())
  {
    for (const PlanCandidate& candidate : skipped)
    {
      if (candidate.Method != method->GetMethodName() || this->Found.Meets || this->Aborted() ||
          this->Found.Choice < 0 || this->IsTooLong(candidate))
      {
        continue;
      }
      const PlanCandidate& best = this->GetChoice();
      const bool isLarger = candidate.Method != best.Method ||
                            GetMainSize(candidate) > GetMainSize(best) ||
                            candidate.Bytes > best.Bytes;
      if (isLarger && !this->CanPrune(candidate, GetErrorWorthIt(candidate, best)) &&
          !this->Try(candidate))
      {
        return false;
      }
    }
  }
  return true;
}

bool PlanSearch::Try(PlanCandidate candidate, bool mayBeChosen)
{
  if (this->Prepare(candidate, mayBeChosen))
  {
    const bool fits = candidate.Bytes <= this->Task.MaximumBytes; // with the material's textures
    if (fits && mayBeChosen)
    {
      this->Take(candidate);
    }
    else if (fits)
    {
      candidate.Integrator = nullptr;
      this->Found.Candidates.push_back(candidate);
    }
    return true;
  }
  if (this->Aborted() || vtkRadianceMethods::IsBuiltIn(candidate.Method))
  {
    return false;
  }
  this->Warnings += (this->Warnings.empty() ? "" : "\n") + candidate.Method + ", " +
                    candidate.Description + ": " + this->Problem;
  this->Problem.clear();
  return true;
}

// And see how far it is from the reference.
bool PlanSearch::Prepare(PlanCandidate& candidate, bool mayBeChosen)
{
  if (!PrepareCandidate(this->Task, this->Aborted, candidate, this->Problem))
  {
    return false;
  }
  if (candidate.Integrator->UsesBRDFOnGPU())
  {
    vtkBRDFShaderInputs form;
    form.SoftLights = candidate.Integrator->UsesSoftLights();
    this->Task.BRDF->GetShaderInputs(form);
    candidate.Bytes += static_cast<vtkIdType>(form.GetTextureBytes());
  }
  vtkNew<vtkDoubleArray> radiance;
  if (!this->Integrate(candidate, this->First.Pairs, radiance))
  {
    return false;
  }
  const PlanError found = Compare({ &this->First }, { radiance });
  candidate.Error = found.Error;
  candidate.Uncertainty = found.Uncertainty;
  candidate.Picture = found.Picture;
  ++this->Tried;
  return !mayBeChosen || !this->MayBeLuck(candidate) || this->Check(candidate);
}

bool PlanSearch::Integrate(
  PlanCandidate& candidate, const PlanPairs& pairs, vtkDoubleArray* radiance)
{
  const AbortForwarder supervision(this->Aborted, candidate.Integrator, this->Problem);
  return candidate.Integrator->Integrate(pairs.Normals, pairs.Views, radiance);
}

// Within the tolerance, but no further than the sample's error again, after some that were not.
bool PlanSearch::MayBeLuck(const PlanCandidate& candidate) const
{
  return this->Tried > Few && candidate.Error <= this->Task.Tolerance &&
         candidate.Error + candidate.Uncertainty > this->Task.Tolerance &&
         (!this->Found.Meets || this->IsBetterInPictures(candidate));
}

// On both samples.
bool PlanSearch::Check(PlanCandidate& candidate)
{
  const PlanComparison* second = this->GetSecond ? this->GetSecond() : nullptr;
  if (!second)
  {
    return !this->Aborted();
  }
  vtkNew<vtkDoubleArray> radiance, other;
  if (!this->Integrate(candidate, this->First.Pairs, radiance) ||
      !this->Integrate(candidate, second->Pairs, other))
  {
    return false;
  }
  const PlanError found = Compare({ &this->First, second }, { radiance, other });
  candidate.Error = found.Error;
  candidate.Uncertainty = found.Uncertainty;
  candidate.Picture = found.Picture;
  candidate.OnBoth = true;
  return true;
}

// Without what stands for chance, the best so far would be within the tolerance.
bool PlanSearch::IsNearMiss() const
{
  return !this->Found.Meets && this->Found.Choice >= 0 &&
         this->GetChoice().Error - this->GetChoice().Uncertainty <= this->Task.Tolerance;
}

// Where what misses the tolerance by chance only, on both samples, has a frame of half the length.
bool PlanSearch::IsTooLong(const PlanCandidate& candidate) const
{
  return this->IsNearMiss() && this->GetChoice().OnBoth &&
         candidate.Cost > LongFrame * this->ShortestFrame;
}

// The best of those that miss the tolerance, too: on both samples it may be within it.
bool PlanSearch::CheckChoice()
{
  Plan& plan = this->Found;
  if (plan.Meets || plan.Choice < 0 || this->GetChoice().OnBoth || this->Tried <= Few ||
      this->Aborted())
  {
    return true;
  }
  PlanCandidate& choice = plan.Candidates[static_cast<std::size_t>(plan.Choice)];
  const bool checked = this->Check(choice);
  plan.Meets = checked && choice.Error <= this->Task.Tolerance;
  plan.First = plan.Meets ? plan.Choice : -1;
  return checked;
}

// The first within the tolerance, in single pictures, too, where that costs little; else the most
// accurate, where that is worth its cost.
void PlanSearch::Take(const PlanCandidate& candidate)
{
  Plan& plan = this->Found;
  plan.Candidates.push_back(candidate);
  const int last = static_cast<int>(plan.Candidates.size()) - 1;
  const double enough =
    plan.Meets ? 0.0
    : plan.Choice < 0
      ? HUGE_VAL
      : GetErrorWorthIt(candidate, plan.Candidates[static_cast<std::size_t>(plan.Choice)]);
  if (!plan.Meets && candidate.Error <= this->Task.Tolerance)
  {
    plan.Meets = true;
    plan.Choice = last;
    plan.First = last;
  }
  else if (plan.Meets && this->IsBetterInPictures(candidate))
  {
    plan.Choice = last;
  }
  else if (candidate.Error < enough)
  {
    plan.Choice = last;
  }
  for (int other = 0; other <= last; ++other)
  {
    if (other != plan.Choice)
    {
      plan.Candidates[static_cast<std::size_t>(other)].Integrator = nullptr;
    }
  }
}
} // namespace measuredbrdf
