// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBlinnPhongBRDFFitter.h"

#include "FitterSamples.h"
#include "LobeFit.h"
#include "Setters.h"
#include "vtkObjectFactory.h"

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
    { LobeShape::BlinnPhong, this->NumberOfLobes, false }, this,
    [this](double share) { return this->UpdateProgress(share); });
  return { fit.BRDF, fit.History, fit.Converged, fit.Report };
}
