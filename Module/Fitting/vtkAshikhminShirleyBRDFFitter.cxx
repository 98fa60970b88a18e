// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAshikhminShirleyBRDFFitter.h"

#include "FitterSamples.h"
#include "LobeFit.h"
#include "NumberText.h"
#include "Setters.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSumBRDF.h"

using namespace measuredbrdf;

vtkStandardNewMacro(vtkAshikhminShirleyBRDFFitter);

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkAshikhminShirleyBRDFFitter, Anisotropy, int, AS_INPUT, ANISOTROPIC);
measuredbrdfSetInRangeMacro(vtkAshikhminShirleyBRDFFitter, NumberOfLobes, int, 1, 3);

//------------------------------------------------------------------------------
void vtkAshikhminShirleyBRDFFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLobes: " << this->NumberOfLobes << "\n";
  os << indent << "Anisotropy: " << this->Anisotropy << "\n";
}

//------------------------------------------------------------------------------
vtkBRDFFitter::Result vtkAshikhminShirleyBRDFFitter::FitTo(const std::vector<Sample>& samples)
{
  const bool anisotropic = this->Anisotropy == ANISOTROPIC ||
                           (this->Anisotropy == AS_INPUT && !this->Input->IsIsotropic());
  const LobeFitResult fit = FitLobes(ToFitSamples(samples, this->Loss),
    { LobeShape::AshikhminShirley, this->NumberOfLobes, anisotropic },
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
    double scale[3], reflectance[3];
    for (int c = 0; c < 3; ++c)
    {
      scale[c] = fitted.Base[c] + fitted.Rise[c];
      reflectance[c] = scale[c] > 0.0 ? fitted.Base[c] / scale[c] : 0.0;
    }
    vtkNew<vtkAshikhminShirleyBRDF> lobe;
    lobe->SetExponents(fitted.ExponentU, fitted.ExponentV);
    lobe->SetSpecularScale(scale);
    lobe->SetReflectance(reflectance);
    sum->AddTerm(lobe);
    report << "lobe: exponents " << fitted.ExponentU << " " << fitted.ExponentV << ", scale "
           << scale[0] << " " << scale[1] << " " << scale[2] << ", reflectance " << reflectance[0]
           << " " << reflectance[1] << " " << reflectance[2] << "\n";
  }
  return { sum.Get(), fit.History, fit.Converged, report.str() };
}
