// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBlinnPhongBRDFFitter.h"

#include "FitterSamples.h"
#include "LobeFit.h"
#include "NumberText.h"
#include "Setters.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSumBRDF.h"

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBlinnPhongBRDFFitter);

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkBlinnPhongBRDFFitter, NumberOfLobes, int, 1, 3);

//------------------------------------------------------------------------------
void vtkBlinnPhongBRDFFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLobes: " << this->NumberOfLobes << "\n";
}

//------------------------------------------------------------------------------
vtkBRDFFitter::Result vtkBlinnPhongBRDFFitter::FitTo(const std::vector<Sample>& samples)
{
  const LobeFitResult fit = FitLobes(ToFitSamples(samples, this->Loss),
    { LobeShape::BlinnPhong, this->NumberOfLobes, false },
    { this->NumberOfStarts, this->StartSeed, this->MaximumNumberOfIterations, this->Tolerance,
      [this](double share) { return this->UpdateProgress(share); } });
  if (!fit.Failure.empty() || fit.Lobes.empty())
  {
    return { nullptr, {}, false, fit.Failure };
  }
  TextStream report;
  report << "diffuse albedo: " << fit.Albedo[0] << " " << fit.Albedo[1] << " " << fit.Albedo[2]
         << "\n";
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(fit.Albedo[0], fit.Albedo[1], fit.Albedo[2]);
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  for (const FittedLobe& fitted : fit.Lobes)
  {
    vtkNew<vtkBlinnPhongBRDF> lobe;
    lobe->SetExponent(fitted.ExponentU);
    lobe->SetSpecular(fitted.Base[0], fitted.Base[1], fitted.Base[2]);
    sum->AddTerm(lobe);
    report << "lobe: exponent " << fitted.ExponentU << ", specular " << fitted.Base[0] << " "
           << fitted.Base[1] << " " << fitted.Base[2] << "\n";
  }
  return { sum.Get(), fit.History, fit.Converged, report.str() };
}
