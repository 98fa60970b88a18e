// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bases.h"

#include "vtkBRDFAnalysis.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace tool
{
const char* const BasisNames[4] = { "spherical-harmonics", "hemispherical", "zonal",
  "legendre-fourier" };

//------------------------------------------------------------------------------
int FindBasis(const std::string& name)
{
  return static_cast<int>(
    std::find(std::begin(BasisNames), std::end(BasisNames), name) - std::begin(BasisNames));
}

//------------------------------------------------------------------------------
std::string FormatShare(const std::string& label, double share)
{
  char text[40];
  std::snprintf(text, sizeof(text), ": %.3g %%\n", 100.0 * share);
  return label + text;
}

//------------------------------------------------------------------------------
double GetZoneError(vtkBRDF* reference, vtkBRDF* brdf, const double zone[2])
{
  return vtkBRDFResampler::GetZoneRelativeL2Error(reference, brdf, zone, zone, 1 << 16);
}

//------------------------------------------------------------------------------
double GetNegativeMass(vtkBasisBRDF* brdf)
{
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetAngles(0, nullptr);
  analysis->SetBRDF(brdf);
  analysis->Update();
  return analysis->GetNegativeMass();
}
} // namespace tool
