// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Laboratory.h"

#include "Tool.h"

#include "vtkBRDFAnalysis.h"
#include "vtkBasisProjector.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkNew.h"

#include <cstdio>

namespace laboratory
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkBasisBRDF> ProjectOnto(
  vtkBRDF* brdf, int basis, int order, const double zone[2], const std::string& name)
{
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(brdf);
  projector->SetBasis(basis);
  projector->SetOrder(order);
  if (basis >= vtkBasisBRDF::ZONAL)
  {
    projector->SetIncidentZone(zone[0], zone[1]);
    projector->SetOutgoingZone(zone[0], zone[1]);
  }
  if (!tool::RunWithProgress(projector.Get(), &vtkBasisProjector::Project, "projecting"))
  {
    throw tool::Error(name + ": projection: " + tool::TakeErrorText());
  }
  return projector->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> FitDistribution(vtkBRDF* brdf, const std::string& name)
{
  vtkNew<vtkDistributionBRDFFitter> fitter;
  fitter->SetInput(brdf);
  if (!tool::RunWithProgress(fitter.Get(), &vtkDistributionBRDFFitter::Fit, "fitting"))
  {
    throw tool::Error(name + ": D-BRDF: " + tool::TakeErrorText());
  }
  return fitter->GetOutput();
}

//------------------------------------------------------------------------------
double GetNegativeMass(vtkBasisBRDF* brdf)
{
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetAngles(0, nullptr);
  analysis->SetBRDF(brdf);
  analysis->Update();
  return analysis->GetNegativeMass();
}

//------------------------------------------------------------------------------
std::string FormatShare(const std::string& label, double share)
{
  char text[40];
  std::snprintf(text, sizeof(text), ": %.3g %%\n", 100.0 * share);
  return label + text;
}
} // namespace laboratory
