// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderableTable.h"

#include "HalfDifferenceFill.h"
#include "HalfTurn.h"
#include "NumberText.h"
#include "Printable.h"
#include "vtkAnisotropicTabulatedBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

namespace measuredbrdf
{
namespace
{
// phi_d, theta_d, phi_h over a full turn, theta_h: even ones first, then for what is steep at the
// horizon (phi_d, theta_d) and for sharp lobes (theta_h).
constexpr int Ladder[][4] = { { 12, 8, 24, 24 }, { 16, 12, 32, 32 }, { 16, 16, 48, 32 },
  { 32, 32, 32, 32 }, { 24, 16, 48, 64 }, { 32, 24, 48, 48 }, { 24, 12, 48, 128 } };
constexpr int ChoosingPairs = 1 << 13;
constexpr int ReportingPairs = 1 << 15;

vtkSmartPointer<vtkAnisotropicTabulatedBRDF> MakeAnisotropicTable(
  vtkBRDF* source, const int step[4], bool half)
{
  const int size[4] = { step[0], step[1], half ? step[2] / 2 : step[2], step[3] };
  auto table = vtkSmartPointer<vtkAnisotropicTabulatedBRDF>::New();
  table->Resample(source,
    half ? vtkAnisotropicTabulatedBRDF::HALF_TURN : vtkAnisotropicTabulatedBRDF::FULL_TURN, size);
  return table;
}

// A table of f cos(theta_o) whose relative L2 error (vtkBRDFResampler::GetRelativeL2Error) is
// within the tolerance, or the best of seven sizes, the largest of 1.8 million cells (10.6 MB as
// 16-bit RGB; half as many where half a turn changes nothing). Its ResamplingError holds the error,
// of pairs that chose nothing.
vtkSmartPointer<vtkAnisotropicTabulatedBRDF> ResampleAnisotropic(vtkBRDF* source, double tolerance)
{
  const bool half = IsSameAfterHalfATurn(source);
  vtkSmartPointer<vtkAnisotropicTabulatedBRDF> best;
  double least = 0.0;
  for (const int* step : Ladder)
  {
    const auto table = MakeAnisotropicTable(source, step, half);
    const double error = vtkBRDFResampler::GetRelativeL2Error(source, table, ChoosingPairs);
    if (!best || error < least)
    {
      best = table;
      least = error;
    }
    if (least <= tolerance)
    {
      break;
    }
  }
  best->SetResamplingError(vtkBRDFResampler::GetRelativeL2Error(source, best, ReportingPairs));
  return best;
}

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

RenderableTable::RenderableTable()
  : Common(std::make_shared<Shared>())
{
}

RenderableTable::RenderableTable(const RenderableTable& other)
  : Common(other.Common)
{
}

// Whether Own is what is asked for: its own, or what a copy has made.
bool RenderableTable::TakeUp(double tolerance)
{
  if (!this->Own.Fits(tolerance) && this->Common->Last.Fits(tolerance))
  {
    this->Own = this->Common->Last;
  }
  return this->Own.Fits(tolerance);
}

vtkBRDF* RenderableTable::Get(vtkBRDF* material, std::string& problem)
{
  const std::lock_guard<std::mutex> lock(this->Common->Mutex);
  const double tolerance = material->GetResamplingTolerance();
  if (this->TakeUp(tolerance))
  {
    return this->Own.Table;
  }
  vtkSmartPointer<vtkBRDF> made;
  double error = 0.0;
  if (material->IsIsotropic())
  {
    vtkNew<vtkBRDFResampler> resampler;
    resampler->SetInput(material);
    resampler->SetTolerance(tolerance);
    resampler->Resample();
    error = resampler->GetOutput()->GetResamplingError();
    resampler->GetOutput()->SetPrecision(vtkTabulatedBRDF::SHARED_EXPONENT);
    made = resampler->GetOutput();
  }
  else
  {
    const auto table = ResampleAnisotropic(material, tolerance);
    error = table->GetResamplingError();
    made = table;
  }
  if (error > tolerance)
  {
    TextStream text;
    text << Quote(material->GetName()) << ": resampling for shaders keeps an error of " << error
         << ", asked for " << tolerance << ".";
    problem = text.str();
  }
  NameAfter(material, made);
  this->Own = this->Common->Last = { made, tolerance };
  return made;
}

vtkBRDF* RenderableTable::NewQuick(vtkBRDF* material)
{
  const std::unique_lock<std::mutex> lock(this->Common->Mutex, std::try_to_lock);
  if (lock && this->TakeUp(material->GetResamplingTolerance()))
  {
    this->Own.Table->Register(nullptr);
    return this->Own.Table;
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
    table = MakeAnisotropicTable(material, Ladder[0], IsSameAfterHalfATurn(material));
  }
  NameAfter(material, table);
  table->Register(nullptr);
  return table;
}
} // namespace measuredbrdf
