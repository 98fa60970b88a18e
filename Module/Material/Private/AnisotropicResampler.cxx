// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnisotropicResampler.h"

#include "HalfTurn.h"
#include "vtkBRDFResampler.h"

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

vtkSmartPointer<vtkAnisotropicTabulatedBRDF> MakeTable(
  vtkBRDF* source, const int step[4], bool half)
{
  const int size[4] = { step[0], step[1], half ? step[2] / 2 : step[2], step[3] };
  auto table = vtkSmartPointer<vtkAnisotropicTabulatedBRDF>::New();
  table->Resample(source,
    half ? vtkAnisotropicTabulatedBRDF::HALF_TURN : vtkAnisotropicTabulatedBRDF::FULL_TURN, size);
  return table;
}
}

vtkSmartPointer<vtkAnisotropicTabulatedBRDF> ResampleAnisotropic(vtkBRDF* source, double tolerance)
{
  const bool half = IsSameAfterHalfATurn(source);
  vtkSmartPointer<vtkAnisotropicTabulatedBRDF> best;
  double least = 0.0;
  for (const int* step : Ladder)
  {
    const auto table = MakeTable(source, step, half);
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

vtkSmartPointer<vtkAnisotropicTabulatedBRDF> ResampleAnisotropicQuickly(vtkBRDF* source)
{
  return MakeTable(source, Ladder[0], IsSameAfterHalfATurn(source));
}
} // namespace measuredbrdf
