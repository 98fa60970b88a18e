// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAshikhminShirleyBRDFFitter.h"

#include "FitterSamples.h"
#include "LobeFit.h"
#include "Setters.h"
#include "vtkObjectFactory.h"

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
    { LobeShape::AshikhminShirley, this->NumberOfLobes, anisotropic }, this,
    [this](double share) { return this->UpdateProgress(share); });
  return { fit.BRDF, fit.History, fit.Converged, fit.Report };
}
