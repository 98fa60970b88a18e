// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkResampledBRDF.h"

#include "HalfDifferenceFill.h"
#include "HalfTurn.h"
#include "Printable.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <mutex>

using namespace measuredbrdf;

struct vtkResampledBRDF::Shared
{
  std::mutex Mutex; // guards all
  Made Last;
};

namespace
{
// phi_d, theta_d, phi_h over a full turn, theta_h: even ones first, then for what is steep at the
// horizon (phi_d, theta_d) and for sharp lobes (theta_h).
constexpr int Ladder[][4] = { { 12, 8, 24, 24 }, { 16, 12, 32, 32 }, { 16, 16, 48, 32 },
  { 32, 32, 32, 32 }, { 24, 16, 48, 64 }, { 32, 24, 48, 48 }, { 24, 12, 48, 128 } };
constexpr int ChoosingPairs = 1 << 13;
constexpr int ReportingPairs = 1 << 15;

vtkSmartPointer<vtkTabulatedBRDF> MakeAnisotropicTable(
  vtkBRDF* source, const int step[4], bool half)
{
  const int size[4] = { step[0], step[1], half ? step[2] / 2 : step[2], step[3] };
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  table->Resample(source, half ? vtkTabulatedBRDF::HALF_TURN : vtkTabulatedBRDF::FULL_TURN, size);
  return table;
}

// A table of f cos(theta_o) whose relative L2 error (vtkBRDFResampler::GetRelativeL2Error) is
// within the tolerance, or the best of seven sizes, the largest of 1.8 million cells (10.6 MB as
// 16-bit RGB; half as many where half a turn changes nothing). Its ResamplingError holds the error,
// of pairs that chose nothing.
vtkSmartPointer<vtkTabulatedBRDF> ResampleAnisotropic(vtkBRDF* source, double tolerance)
{
  const bool half = IsSameAfterHalfATurn(source);
  vtkSmartPointer<vtkTabulatedBRDF> best;
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

//------------------------------------------------------------------------------
vtkResampledBRDF::vtkResampledBRDF()
  : Common(std::make_shared<Shared>())
{
}

//------------------------------------------------------------------------------
vtkResampledBRDF::~vtkResampledBRDF() = default;

//------------------------------------------------------------------------------
void vtkResampledBRDF::ResetRenderable()
{
  this->Common = std::make_shared<Shared>();
  this->Own = Made();
}

//------------------------------------------------------------------------------
void vtkResampledBRDF::ShareRenderable(vtkResampledBRDF* original)
{
  this->Common = original->Common;
}

//------------------------------------------------------------------------------
// Whether Own is what is asked for: its own, or what a copy has made. Under the mutex.
bool vtkResampledBRDF::HasRenderable()
{
  const auto fits = [this](const Made& made)
  { return made.Table && made.Tolerance == this->ResamplingTolerance; };
  if (!fits(this->Own) && fits(this->Common->Last))
  {
    this->Own = this->Common->Last;
  }
  return fits(this->Own);
}

//------------------------------------------------------------------------------
vtkBRDF* vtkResampledBRDF::GetRenderable()
{
  const std::lock_guard<std::mutex> lock(this->Common->Mutex);
  if (this->HasRenderable())
  {
    return this->Own.Table;
  }
  vtkSmartPointer<vtkTabulatedBRDF> made;
  if (this->IsIsotropic())
  {
    vtkNew<vtkBRDFResampler> resampler;
    resampler->SetInput(this);
    resampler->SetTolerance(this->ResamplingTolerance);
    resampler->Resample();
    made = resampler->GetOutput();
    made->SetPrecision(vtkTabulatedBRDF::SHARED_EXPONENT);
  }
  else
  {
    made = ResampleAnisotropic(this, this->ResamplingTolerance);
  }
  const double error = made->GetResamplingError();
  if (error > this->ResamplingTolerance)
  {
    vtkWarningMacro(<< Quote(this->Name) << ": resampling for shaders keeps an error of " << error
                    << ", asked for " << this->ResamplingTolerance << ".");
  }
  NameAfter(this, made);
  this->Own = this->Common->Last = { made, this->ResamplingTolerance };
  return made;
}

//------------------------------------------------------------------------------
vtkBRDF* vtkResampledBRDF::NewQuickRenderable()
{
  const std::unique_lock<std::mutex> lock(this->Common->Mutex, std::try_to_lock);
  if (lock && this->HasRenderable())
  {
    this->Own.Table->Register(nullptr);
    return this->Own.Table;
  }
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  if (this->IsIsotropic())
  {
    FillHalfDifference(this, false, QuickSize, table);
    table->SetPrecision(vtkTabulatedBRDF::SHARED_EXPONENT);
  }
  else
  {
    table = MakeAnisotropicTable(this, Ladder[0], IsSameAfterHalfATurn(this));
  }
  NameAfter(this, table);
  table->Register(nullptr);
  return table;
}

//------------------------------------------------------------------------------
void vtkResampledBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  this->GetRenderable()->GetShaderInputs(inputs);
}
