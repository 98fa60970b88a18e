// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOcclusionPredictor.h"

#include "NumberText.h"
#include "PlanComparison.h"
#include "ScopedErrorCapture.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTracedRadianceIntegrator.h"
#include "vtkTracedScene.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr int Samples = 64;          // of each point
constexpr double SureShare = 0.25;   // of the error, as its uncertainty: sure enough
constexpr double SmallError = 0.002; // nobody asks how far below it is
constexpr int Growth = 4;            // of the points, from round to round
constexpr int Rounds = 3;
constexpr double LeastShare = 0.5; // of the tolerance, left for occlusion whatever the plan's error
} // namespace

vtkStandardNewMacro(vtkOcclusionPredictor);

//------------------------------------------------------------------------------
vtkOcclusionPredictor::vtkOcclusionPredictor() = default;
vtkOcclusionPredictor::~vtkOcclusionPredictor() = default;

//------------------------------------------------------------------------------
vtkCxxSetSmartPointerMacro(vtkOcclusionPredictor, Scene, vtkTracedScene);
vtkCxxSetSmartPointerMacro(vtkOcclusionPredictor, BRDF, vtkBRDF);
vtkCxxSetSmartPointerMacro(vtkOcclusionPredictor, Environment, vtkEnvironment);
measuredbrdfSetClampedMacro(vtkOcclusionPredictor, NumberOfPoints, int, 16, 1000000);

//------------------------------------------------------------------------------
vtkTracedScene* vtkOcclusionPredictor::GetScene() { return this->Scene; }
vtkBRDF* vtkOcclusionPredictor::GetBRDF() { return this->BRDF; }
vtkEnvironment* vtkOcclusionPredictor::GetEnvironment() { return this->Environment; }

//------------------------------------------------------------------------------
bool vtkOcclusionPredictor::Update()
{
  if (!this->Scene || !this->BRDF || !this->Environment)
  {
    vtkErrorMacro("Update: a scene, a BRDF and an environment are needed.");
    return false;
  }
  if (this->UpdateTime > std::max({ this->GetMTime(), this->Scene->GetMTime(),
                           this->BRDF->GetMTime(), this->Environment->GetMTime() }))
  {
    return true;
  }
  const double before[] = { this->Error, this->Uncertainty };
  int count = this->NumberOfPoints;
  for (int round = 0; round < Rounds; ++round, count *= Growth)
  {
    if (!this->Predict(count))
    {
      this->Error = before[0];
      this->Uncertainty = before[1];
      vtkErrorMacro(<< (this->Abort ? "Update: aborted." : "Update: nothing can be predicted."));
      return false;
    }
    if (this->Uncertainty <= SureShare * this->Error ||
        this->Error + this->Uncertainty <= SmallError)
    {
      break;
    }
  }
  this->UpdateTime.Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkOcclusionPredictor::Predict(int numberOfPoints)
{
  vtkNew<vtkPolyData> points;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> radiance;
  vtkNew<vtkDoubleArray> open;
  vtkNew<vtkTracedRadianceIntegrator> integrator;
  integrator->SetScene(this->Scene);
  integrator->SetBRDF(this->BRDF);
  integrator->SetEnvironment(this->Environment);
  integrator->SetNumberOfSamples(Samples);
  // Both sums of one set of samples: what they have in common cancels.
  integrator->UnoccludedReferenceOff();
  vtkNew<vtkCallbackCommand> follow;
  follow->SetClientData(this);
  follow->SetCallback(
    [](vtkObject* caller, unsigned long, void* self, void* progress)
    {
      auto* predictor = static_cast<vtkOcclusionPredictor*>(self);
      predictor->InvokeEvent(vtkCommand::ProgressEvent, progress);
      static_cast<vtkTracedRadianceIntegrator*>(caller)->SetAbort(predictor->Abort);
    });
  integrator->AddObserver(vtkCommand::ProgressEvent, follow);
  const measuredbrdf::ScopedErrorCapture error(integrator); // Update says it
  const double allAround[3] = { 0.0, 0.0, 0.0 };            // the cameras
  if (this->Abort || !this->Scene->DrawVisiblePoints(numberOfPoints, allAround, points, views) ||
      !integrator->Integrate(points, views, radiance, open))
  {
    return false;
  }
  measuredbrdf::PlanComparison traced;
  measuredbrdf::PlanComparison unoccluded;
  traced.Reference = radiance;
  unoccluded.Reference = open;
  const measuredbrdf::PlanError found = Compare(traced, open);
  const bool isDark = !(found.Error > 0.0) && Compare(unoccluded, radiance).Error > 0.0;
  this->Error = isDark ? HUGE_VAL : found.Error - found.Uncertainty;
  this->Uncertainty = isDark ? HUGE_VAL : found.Uncertainty;
  return true;
}

//------------------------------------------------------------------------------
std::string vtkOcclusionPredictor::GetText() { return FormatText(this->Error, this->Uncertainty); }

//------------------------------------------------------------------------------
std::string vtkOcclusionPredictor::FormatText(double error, double uncertainty)
{
  if (!std::isfinite(error))
  {
    return "unoccluded light: no light reaches this surface";
  }
  const auto toPercent = [](double share)
  {
    return (share < 0.1 ? measuredbrdf::NumberText(100.0 * share, 2)
                        : measuredbrdf::NumberText(std::round(100.0 * share), 3)) +
           " %";
  };
  return "unoccluded light: " + toPercent(error) + " on this surface (+- " +
         toPercent(uncertainty) + ")";
}

//------------------------------------------------------------------------------
bool vtkOcclusionPredictor::IsWorthModeling(double error, double planError, double tolerance)
{
  const double left = std::sqrt(std::max(tolerance * tolerance - planError * planError, 0.0));
  return error > std::max(left, LeastShare * tolerance);
}

//------------------------------------------------------------------------------
void vtkOcclusionPredictor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scene: " << this->Scene.Get() << "\n";
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
  os << indent << "Error: " << this->Error << "\n";
  os << indent << "Uncertainty: " << this->Uncertainty << "\n";
}
