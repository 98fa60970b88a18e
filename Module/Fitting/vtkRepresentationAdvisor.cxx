// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRepresentationAdvisor.h"

#include "LowDiscrepancy.h"
#include "NumberText.h"
#include "Setters.h"
#include "vtkBRDFResampler.h"
#include "vtkBasisProjector.h"
#include "vtkCommand.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkRepresentationAdvisor);

namespace
{
constexpr int NumberOfPairs = 1 << 14;

// Share of what a basis adds to the reference in what it is.
double MeasureOvershoot(vtkBRDF* reference, vtkBasisBRDF* basis, const double zone[2])
{
  double added = 0.0;
  double total = 0.0;
  ForZonePairs(zone, zone, NumberOfPairs,
    [&](const double i[3], const double o[3])
    {
      double f[3];
      double g[3];
      reference->Evaluate(i, o, f);
      basis->EvaluateSigned(i, o, g);
      for (int c = 0; c < 3; ++c)
      {
        added += std::max(g[c] - f[c], 0.0);
        total += std::abs(g[c]);
      }
    });
  return total > 0.0 ? added / total : 0.0;
}
}

//------------------------------------------------------------------------------
void vtkRepresentationAdvisor::SetInput(vtkBRDF* input)
{
  if (this->Input != input)
  {
    this->Input = input;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
// Run a projector or fitter; its progress becomes this object's, as does its error.
template <typename Maker>
bool vtkRepresentationAdvisor::RunWithProgress(Maker* maker, bool (Maker::*run)())
{
  struct Forwarder
  {
    vtkRepresentationAdvisor* Self;
    Maker* Source;
    std::string Error;

    void OnEvent(vtkObject*, unsigned long event, void* data)
    {
      if (event == vtkCommand::ErrorEvent)
      {
        this->Error = static_cast<const char*>(data);
        return;
      }
      this->Self->InvokeEvent(vtkCommand::ProgressEvent, data);
      if (this->Self->GetAbort())
      {
        this->Source->SetAbort(true);
      }
    }
  } forwarder{ this, maker, "" };
  maker->AddObserver(vtkCommand::ProgressEvent, &forwarder, &Forwarder::OnEvent);
  maker->AddObserver(vtkCommand::ErrorEvent, &forwarder, &Forwarder::OnEvent);
  const bool done = (maker->*run)();
  maker->RemoveAllObservers();
  if (!done && !this->Abort)
  {
    vtkErrorMacro(<< forwarder.Error);
  }
  return done;
}

//------------------------------------------------------------------------------
bool vtkRepresentationAdvisor::Update()
{
  this->Abort = false;
  if (!this->Input)
  {
    vtkErrorMacro("Update: no input.");
    return false;
  }
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(this->Input);
  projector->SetBasis(vtkBasisBRDF::ZONAL);
  projector->SetOrder(this->Order);
  projector->SetIncidentZone(this->Zone);
  projector->SetOutgoingZone(this->Zone);
  if (!this->RunWithProgress(projector.Get(), &vtkBasisProjector::Project))
  {
    return false;
  }
  this->InZoneResidual = vtkBRDFResampler::GetZoneRelativeL2Error(
    this->Input, projector->GetOutput(), this->Zone, this->Zone, NumberOfPairs);
  this->NegativeMass =
    projector->GetOutput()->GetNegativeMass(this->Zone, this->Zone, NumberOfPairs);
  this->Overshoot = MeasureOvershoot(this->Input, projector->GetOutput(), this->Zone);
  this->Recommendation = this->InZoneResidual <= this->MaximumResidual ? BASIS : FIT;
  this->Reason = std::string(this->Recommendation == BASIS ? "basis" : "fit") + ": at order " +
                 std::to_string(this->Order) + " over " + NumberText(this->Zone[0]) + " to " +
                 NumberText(this->Zone[1]) + " degrees the residual is " +
                 FixedText(100.0 * this->InZoneResidual, 1) + " % (limit " +
                 NumberText(100.0 * this->MaximumResidual) + " %), the negative mass " +
                 FixedText(100.0 * this->NegativeMass, 2) + " %";
  return true;
}

//------------------------------------------------------------------------------
bool vtkRepresentationAdvisor::Represent()
{
  if (vtkBasisBRDF::SafeDownCast(this->Input))
  {
    this->Recommendation = BASIS;
    this->Reason = "basis: it is in one already";
    this->Output = this->Input;
    return true;
  }
  if (!this->Update())
  {
    return false;
  }
  if (this->Recommendation == BASIS)
  {
    vtkNew<vtkBasisProjector> projector;
    projector->SetInput(this->Input);
    projector->SetBasis(vtkBasisBRDF::SPHERICAL_HARMONICS);
    projector->SetOrder(this->Order);
    if (!this->RunWithProgress(projector.Get(), &vtkBasisProjector::Project))
    {
      return false;
    }
    this->Output = projector->GetOutput();
    return true;
  }
  vtkNew<vtkDistributionBRDFFitter> fitter;
  fitter->SetInput(this->Input);
  if (!this->RunWithProgress(static_cast<vtkBRDFFitter*>(fitter.Get()), &vtkBRDFFitter::Fit))
  {
    return false;
  }
  this->Output = fitter->GetOutput();
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkRepresentationAdvisor, MaximumResidual, double, 0.0, 1e6);
measuredbrdfSetChecked2Macro(vtkRepresentationAdvisor, Zone, vtkBasisBRDF::FindZoneProblem);
measuredbrdfSetInRangeMacro(vtkRepresentationAdvisor, Order, int, 1, vtkBasisBRDF::MaximumOrder);

//------------------------------------------------------------------------------
void vtkRepresentationAdvisor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Input: " << this->Input.Get() << "\n";
  os << indent << "Output: " << this->Output.Get() << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "Zone: " << this->Zone[0] << " " << this->Zone[1] << "\n";
  os << indent << "MaximumResidual: " << this->MaximumResidual << "\n";
  os << indent << "InZoneResidual: " << this->InZoneResidual << "\n";
  os << indent << "NegativeMass: " << this->NegativeMass << "\n";
  os << indent << "Overshoot: " << this->Overshoot << "\n";
  os << indent << "Recommendation: " << (this->Recommendation == BASIS ? "basis" : "fit") << "\n";
  os << indent << "Reason: " << this->Reason << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
}
