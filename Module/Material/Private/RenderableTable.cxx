// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderableTable.h"

#include "AnisotropicResampler.h"
#include "Printable.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"

#include <sstream>

namespace measuredbrdf
{
vtkBRDF* RenderableTable::Get(vtkBRDF* material, std::string& problem)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const double tolerance = material->GetResamplingTolerance();
  if (this->Table && this->Tolerance == tolerance)
  {
    return this->Table;
  }
  double error = 0.0;
  if (material->IsIsotropic())
  {
    vtkNew<vtkBRDFResampler> resampler;
    resampler->SetInput(material);
    resampler->SetTolerance(tolerance);
    resampler->Resample();
    error = resampler->GetOutput()->GetResamplingError();
    resampler->GetOutput()->SetPrecision(vtkTabulatedBRDF::SHARED_EXPONENT);
    this->Table = resampler->GetOutput();
  }
  else
  {
    const auto table = ResampleAnisotropic(material, tolerance);
    error = table->GetResamplingError();
    this->Table = table;
  }
  if (error > tolerance)
  {
    std::ostringstream text;
    text << Quote(material->GetName()) << ": resampling for shaders keeps an error of " << error
         << ", asked for " << tolerance << ".";
    problem = text.str();
  }
  this->Table->SetResamplingTolerance(tolerance);
  this->Table->SetName(material->GetName());
  this->Table->SetSource(material->GetSource());
  this->Table->Prepare(); // which would write to it
  this->Tolerance = tolerance;
  return this->Table;
}
} // namespace measuredbrdf
