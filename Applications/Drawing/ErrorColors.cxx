// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorColors.h"

namespace
{
// Nine colors of viridis at equal steps (S. van der Walt, N. Smith, CC0): even for the eye, and
// for eyes that tell fewer colors.
constexpr double Viridis[9][3] = { { 0.267, 0.005, 0.329 }, { 0.279, 0.175, 0.483 },
  { 0.230, 0.322, 0.546 }, { 0.173, 0.449, 0.558 }, { 0.128, 0.567, 0.551 },
  { 0.158, 0.684, 0.502 }, { 0.369, 0.789, 0.383 }, { 0.678, 0.864, 0.190 },
  { 0.993, 0.906, 0.144 } };
}

namespace tool
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkColorTransferFunction> MakeErrorColors()
{
  auto colors = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (int k = 0; k < 9; ++k)
  {
    colors->AddRGBPoint(LowestError + (HighestError - LowestError) * k / 8.0, Viridis[k][0],
      Viridis[k][1], Viridis[k][2]);
  }
  colors->SetBelowRangeColor(0.87, 0.87, 0.87);
  colors->UseBelowRangeColorOn();
  colors->Build();
  return colors;
}
} // namespace tool
