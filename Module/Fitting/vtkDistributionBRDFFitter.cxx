// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDistributionBRDFFitter.h"

#include "DistributionFit.h"
#include "FitterSamples.h"
#include "NumberText.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSumBRDF.h"

using namespace measuredbrdf;

vtkStandardNewMacro(vtkDistributionBRDFFitter);

//------------------------------------------------------------------------------
void vtkDistributionBRDFFitter::SetNumberOfThetaSamples(int numberOfThetaSamples)
{
  if (numberOfThetaSamples != 0 && (numberOfThetaSamples < 2 || numberOfThetaSamples > 4096))
  {
    measuredbrdfRefuseMacro(
      NumberOfThetaSamples, numberOfThetaSamples, "0 or a number from 2 to 4096");
    return;
  }
  measuredbrdfAssignMacro(NumberOfThetaSamples, numberOfThetaSamples);
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkDistributionBRDFFitter, FresnelModel, int, MONOTONE, SCHLICK);
measuredbrdfSetInRangeMacro(vtkDistributionBRDFFitter, NumberOfPhiSamples, int, 0, 1024);
measuredbrdfSetInRangeMacro(vtkDistributionBRDFFitter, NumberOfFresnelSamples, int, 2, 1024);

//------------------------------------------------------------------------------
void vtkDistributionBRDFFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FresnelModel: " << this->FresnelModel << "\n";
  os << indent << "NumberOfThetaSamples: " << this->NumberOfThetaSamples << "\n";
  os << indent << "NumberOfPhiSamples: " << this->NumberOfPhiSamples << "\n";
  os << indent << "NumberOfFresnelSamples: " << this->NumberOfFresnelSamples << "\n";
}

//------------------------------------------------------------------------------
std::string vtkDistributionBRDFFitter::CheckOptions()
{
  int nTheta = 0;
  int nPhi = 0;
  this->GetSize(nTheta, nPhi);
  return nTheta * nPhi <= MaximumNumberOfCells
           ? std::string()
           : "cells of p (NumberOfThetaSamples x NumberOfPhiSamples): expected at most " +
               std::to_string(static_cast<int>(MaximumNumberOfCells)) + ", got " +
               std::to_string(nTheta * nPhi);
}

//------------------------------------------------------------------------------
void vtkDistributionBRDFFitter::GetSize(int& nTheta, int& nPhi)
{
  nPhi =
    this->NumberOfPhiSamples > 0 ? this->NumberOfPhiSamples : (this->Input->IsIsotropic() ? 1 : 32);
  nTheta = this->NumberOfThetaSamples > 0 ? this->NumberOfThetaSamples : (nPhi > 1 ? 48 : 128);
}

//------------------------------------------------------------------------------
vtkBRDFFitter::Result vtkDistributionBRDFFitter::FitTo(const std::vector<Sample>& samples)
{
  int nTheta = 0;
  int nPhi = 0;
  this->GetSize(nTheta, nPhi);
  DistributionFitOptions options;
  options.Size = { nTheta, nPhi, this->NumberOfFresnelSamples };
  options.Shape = this->FresnelModel == SCHLICK ? FresnelShape::Schlick
                  : this->FresnelModel == FREE  ? FresnelShape::Free
                                                : FresnelShape::Monotone;
  options.NumberOfStarts = this->NumberOfStarts;
  options.StartSeed = this->StartSeed;
  options.MaximumNumberOfIterations = this->MaximumNumberOfIterations;
  options.Tolerance = this->Tolerance;
  options.Progress = [this](double share) { return this->UpdateProgress(share); };
  const DistributionFitResult fit =
    FitDistribution(this->Input, ToFitSamples(samples, this->Loss), options);
  vtkNew<vtkDistributionBRDF> distribution;
  if (!distribution->SetDistribution(nTheta, nPhi, fit.Distribution) ||
      !distribution->SetFresnel(this->NumberOfFresnelSamples, fit.Fresnel))
  {
    return Result();
  }
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(fit.Albedo[0], fit.Albedo[1], fit.Albedo[2]);
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  sum->AddTerm(distribution);

  TextStream report;
  report << "diffuse albedo: " << fit.Albedo[0] << " " << fit.Albedo[1] << " " << fit.Albedo[2]
         << "\n";
  report << "p: " << nTheta << " x " << nPhi << " samples, at the normal " << fit.Distribution[0]
         << " " << fit.Distribution[1] << " " << fit.Distribution[2] << " 1/sr\n";
  const std::size_t last = fit.Fresnel.size() - 3;
  report << "F: " << this->NumberOfFresnelSamples << " samples, from " << fit.Fresnel[0] << " "
         << fit.Fresnel[1] << " " << fit.Fresnel[2] << " to " << fit.Fresnel[last] << " "
         << fit.Fresnel[last + 1] << " " << fit.Fresnel[last + 2] << " at grazing\n";
  return { sum.Get(), fit.History, fit.Converged, report.str() };
}
