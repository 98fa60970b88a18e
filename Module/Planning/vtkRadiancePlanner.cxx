// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiancePlanner.h"

#include "EnvironmentPrecomputation.h"
#include "MaterialPrecomputation.h"
#include "NumberText.h"
#include "PlanSearch.h"
#include "RecentlyUsed.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkBRDFModels.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr int SpherePairs = 8192; // of which the comparison takes a sample
constexpr vtkIdType FewestPairs = 16;
constexpr vtkIdType MostPairs = 16384;

// What the texture units of graphics cards lose by interpolating with weights of 8 bits: relative
// L1 of the smallest table, in the mean of seven materials under three maps. Larger tables and
// other methods lose 0.0003 to 0.0008 (docs/methods/pixel-cost.md, "The weights of texture units").
constexpr double FilterWeights = 0.0013;

// What plans of one material have in common is kept for the next plan of it: views and kernels,
// about 1 MB once they are trimmed to what most plans need.
using MaterialParts = std::shared_ptr<vtkRadianceIntegrator::Precomputation>;
constexpr std::size_t MostMaterials = 12;
constexpr int MostAngles = 12; // of views that kernels are kept for
constexpr int MostNodes = 64;  // but those of large tables

// By the materials' content. A planner takes the parts, so that they are nobody else's meanwhile.
SharedCache<std::string, MaterialParts>& GetKnownMaterials()
{
  static auto& known = SharedCache<std::string, MaterialParts>::MakeForProcess(MostMaterials);
  return known;
}

// Those of a sphere: many of them see a sun or a lamp, which decide for mirror-like materials.
PlanPairs DrawPairsOfAllViews(const PlanTask& task)
{
  const auto bright = task.Environment->GetParts().GetExtractedEmitters(task.Environment,
    ExtractedEmitters::DefaultShare, MostReferenceSuns, [&task]() { return !task.IsAborted(); });
  // In the environment's frame, where they do not depend on its rotation.
  double rows[9];
  task.Environment->GetWorldToEnvironment(rows);
  PlanPairs pairs =
    DrawSpherePairs(SpherePairs, bright ? bright->Lights : std::vector<ExtractedEmitters::Light>());
  Turn(rows, pairs);
  return pairs;
}
} // namespace

struct vtkRadiancePlanner::Internals
{
  PlanPairs Given; // what a camera sees, if that was said
  measuredbrdf::Plan Plan;
  vtkTimeStamp Time;

  // An empty one where the index is out of range.
  const PlanCandidate& GetCandidate(int index) const
  {
    static const PlanCandidate& none = *new PlanCandidate; // for threads, too
    return index >= 0 && index < static_cast<int>(this->Plan.Candidates.size())
             ? this->Plan.Candidates[static_cast<std::size_t>(index)]
             : none;
  }
};

vtkStandardNewMacro(vtkRadiancePlanner);

//------------------------------------------------------------------------------
vtkRadiancePlanner::vtkRadiancePlanner()
  : Impl(new Internals)
{
}

//------------------------------------------------------------------------------
vtkRadiancePlanner::~vtkRadiancePlanner() = default;

//------------------------------------------------------------------------------
vtkCxxSetSmartPointerMacro(vtkRadiancePlanner, BRDF, vtkBRDF);
vtkCxxSetSmartPointerMacro(vtkRadiancePlanner, Environment, vtkEnvironment);
vtkBRDF* vtkRadiancePlanner::GetBRDF() { return this->BRDF; }
vtkEnvironment* vtkRadiancePlanner::GetEnvironment() { return this->Environment; }

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::SetPairs(vtkDataArray* normals, vtkDataArray* views)
{
  Internals& impl = *this->Impl;
  if (!normals && !views)
  {
    if (impl.Given.Normals)
    {
      impl.Given = PlanPairs();
      this->Modified();
    }
    return true;
  }
  const vtkIdType count = normals && views ? normals->GetNumberOfTuples() : 0;
  if (!views || count != views->GetNumberOfTuples() || count < FewestPairs || count > MostPairs ||
      normals->GetNumberOfComponents() != 3 || views->GetNumberOfComponents() != 3)
  {
    vtkErrorMacro("SetPairs: expected two arrays of as many tuples of 3, from "
                  << FewestPairs << " to " << MostPairs << ".");
    return false;
  }
  PlanPairs given = MakeEmptyPairs();
  given.Normals->DeepCopy(normals);
  given.Views->DeepCopy(views);
  for (vtkIdType k = 0; k < 3 * count; ++k)
  {
    if (!std::isfinite(given.Normals->GetValue(k)) || !std::isfinite(given.Views->GetValue(k)))
    {
      vtkErrorMacro("SetPairs: pair " << k / 3 << " has a value that is not finite.");
      return false;
    }
  }
  impl.Given = given;
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::Fail(const std::string& problem)
{
  vtkErrorMacro("Update: " << (this->Abort ? "aborted." : problem));
  return false;
}

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::Update()
{
  Internals& impl = *this->Impl;
  // Whatever way this run ends, the next one begins without an abort.
  const std::shared_ptr<std::atomic<bool>> end(
    &this->Abort, [](std::atomic<bool>* abort) { *abort = false; });
  if (!this->BRDF || !this->Environment || this->Environment->GetPixels().empty())
  {
    return this->Fail(
      this->BRDF ? "there is no environment, or it is empty." : "there is no BRDF.");
  }
  if (impl.Plan.Choice < 0 || impl.Time <= std::max({ this->GetMTime(), this->BRDF->GetMTime(),
                                             this->Environment->GetPixelsMTime() }))
  {
    this->BRDF->Prepare();
    if (!this->Search())
    {
      return false;
    }
    impl.Time.Modified();
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::Search()
{
  Internals& impl = *this->Impl;
  PlanTask task;
  task.BRDF = this->BRDF;
  task.Environment = this->Environment;
  task.Tolerance = this->ErrorTolerance;
  task.All = this->EvaluateAll;
  task.MaximumBytes = this->MaximumTextureBytes;
  task.MaximumCost = this->MaximumCost;
  task.IsAborted = [this]() { return this->GetAbort(); };
  const std::string material =
    this->BRDF->IsIsotropic() ? vtkBRDFModels::GetContentKey(this->BRDF) : "";
  task.Shared = GetKnownMaterials().Take(material).value_or(
    std::make_shared<vtkRadianceIntegrator::Precomputation>());
  if (this->BRDF->IsIsotropic())
  {
    task.Shared->GetViews(this->BRDF, this->Abort); // which all that follows asks for
  }
  if (this->Abort)
  {
    return this->Fail(""); // candidates would want the views whole
  }
  const std::string bytes = std::to_string(this->MaximumTextureBytes) + " bytes";
  std::string givenUp;
  std::vector<PlanCandidate> ladder = ListCandidates(task, givenUp);
  if (ladder.empty())
  {
    return this->Fail("nothing fits into MaximumTextureBytes, " + bytes + ", and MaximumCost, " +
                      NumberText(this->MaximumCost) + ".");
  }
  PlanComparison comparison;
  comparison.Pairs = impl.Given.Normals ? impl.Given : DrawPairsOfAllViews(task);
  measuredbrdf::Plan plan;
  std::string problem =
    "nothing fits into MaximumTextureBytes, " + bytes + ", with the textures of the material.";
  try
  {
    SamplePairs(task, ladder, comparison.Pairs);
    MakeReference(task, comparison);
    comparison.ReferenceError = std::hypot(comparison.ReferenceError, FilterWeights);
    Climb(task, comparison, std::move(ladder), plan,
      [this](double progress) { this->InvokeEvent(vtkCommand::ProgressEvent, &progress); });
  }
  catch (const PlanFailure& failure)
  {
    problem = failure.what();
  }
  if (!plan.Warnings.empty())
  {
    vtkWarningMacro("Update: left out what could not be prepared: " << plan.Warnings);
  }
  if (plan.Choice < 0)
  {
    return this->Fail(problem);
  }
  if (!material.empty()) // it says what it is; and nothing was aborted
  {
    task.Shared->Trim(MostAngles, MostNodes);
    GetKnownMaterials().Put(material, task.Shared);
  }
  impl.Plan = std::move(plan);
  impl.Plan.Reason = ExplainChoice(impl.Plan, this->ErrorTolerance, givenUp);
  return true;
}

//------------------------------------------------------------------------------
int vtkRadiancePlanner::GetNumberOfCandidates()
{
  return static_cast<int>(this->Impl->Plan.Candidates.size());
}

//------------------------------------------------------------------------------
#define measuredbrdfCandidateMacro(Name, Type, Member) \
  Type vtkRadiancePlanner::Get##Name(int index) { return this->Impl->GetCandidate(index).Member; }

measuredbrdfCandidateMacro(MethodName, std::string, Method);
measuredbrdfCandidateMacro(Description, std::string, Description);
measuredbrdfCandidateMacro(PredictedError, double, Error);
measuredbrdfCandidateMacro(ErrorUncertainty, double, Uncertainty);
measuredbrdfCandidateMacro(PredictedPercentile95, double, Percentiles[0]);
measuredbrdfCandidateMacro(PredictedPercentile99, double, Percentiles[1]);
measuredbrdfCandidateMacro(PredictedPictureError, double, Picture);
measuredbrdfCandidateMacro(PredictedCost, double, Cost);
measuredbrdfCandidateMacro(TextureBytes, vtkIdType, Bytes);
measuredbrdfCandidateMacro(SetUpMilliseconds, double, SetUp);

//------------------------------------------------------------------------------
int vtkRadiancePlanner::GetChoice() { return this->Impl->Plan.Choice; }
int vtkRadiancePlanner::GetInteractiveChoice() { return this->Impl->Plan.Interactive; }
bool vtkRadiancePlanner::GetMeetsTolerance() { return this->Impl->Plan.Meets; }
std::string vtkRadiancePlanner::GetReason() { return this->Impl->Plan.Reason; }
std::string vtkRadiancePlanner::GetPlan() { return DescribePlan(this->Impl->Plan); }

//------------------------------------------------------------------------------
vtkRadianceIntegrator* vtkRadiancePlanner::NewIntegrator(int index)
{
  const PlanCandidate& candidate = this->Impl->GetCandidate(index);
  const vtkSmartPointer<vtkRadianceIntegrator> integrator =
    candidate.Integrator ? candidate.Integrator
                         : MakeIntegrator(candidate, this->BRDF, this->Environment);
  if (integrator)
  {
    integrator->Register(nullptr);
  }
  return integrator;
}

//------------------------------------------------------------------------------
vtkRadianceIntegrator* vtkRadiancePlanner::NewIntegrator()
{
  return this->NewIntegrator(this->Impl->Plan.Choice);
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkRadiancePlanner, ErrorTolerance, double, 1e-3, 1.0);
measuredbrdfSetInRangeMacro(vtkRadiancePlanner, MaximumTextureBytes, vtkIdType, 0, VTK_ID_MAX);
measuredbrdfSetClampedMacro(vtkRadiancePlanner, MaximumCost, double, 1.0, 1e6);

//------------------------------------------------------------------------------
void vtkRadiancePlanner::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  os << indent << "Pairs: "
     << (this->Impl->Given.Normals ? this->Impl->Given.Normals->GetNumberOfTuples() : 0) << "\n";
  os << indent << "EvaluateAll: " << (this->EvaluateAll ? "On" : "Off") << "\n";
  os << indent << "MaximumTextureBytes: " << this->MaximumTextureBytes << "\n";
  os << indent << "MaximumCost: " << this->MaximumCost << "\n";
  os << indent << "Plan: " << this->GetPlan() << "\n";
}
