// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderableTable.h"

#include "AnisotropicResampler.h"
#include "HalfDifferenceFill.h"
#include "NumberText.h"
#include "Printable.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"

namespace measuredbrdf
{
namespace
{
// phi_d, theta_d, theta_h: fine where lobes are sharp.
constexpr int QuickSize[3] = { 16, 16, 128 };

void NameAfter(vtkBRDF* material, vtkBRDF* table)
{
  table->SetResamplingTolerance(material->GetResamplingTolerance());
  table->SetName(material->GetName());
  table->SetSource(material->GetSource());
  table->Prepare(); // which would write to it
}
}

vtkBRDF* RenderableTable::Get(vtkBRDF* material, std::string& problem)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const double tolerance = material->GetResamplingTolerance();
  if (this->IsMade(tolerance))
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
    TextStream text;
    text << Quote(material->GetName()) << ": resampling for shaders keeps an error of " << error
         << ", asked for " << tolerance << ".";
    problem = text.str();
  }
  NameAfter(material, this->Table);
  this->Tolerance = tolerance;
  return this->Table;
}

vtkBRDF* RenderableTable::NewQuick(vtkBRDF* material)
{
  const std::unique_lock<std::mutex> lock(this->Mutex, std::try_to_lock);
  if (lock && this->IsMade(material->GetResamplingTolerance()))
  {
    this->Table->Register(nullptr);
    return this->Table;
  }
  vtkSmartPointer<vtkBRDF> table;
  if (material->IsIsotropic())
  {
    auto quick = vtkSmartPointer<vtkTabulatedBRDF>::New();
    FillHalfDifference(material, false, QuickSize, quick);
    quick->SetPrecision(vtkTabulatedBRDF::SHARED_EXPONENT);
    table = quick;
  }
  else
  {
    table = ResampleAnisotropicQuickly(material);
  }
  NameAfter(material, table);
  table->Register(nullptr);
  return table;
}
} // namespace measuredbrdf
