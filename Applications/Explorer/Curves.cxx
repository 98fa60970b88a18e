// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Curves.h"

#include "Inspection.h"
#include "Tool.h"

#include "vtkBRDFAnalysis.h"
#include "vtkBRDFSliceSource.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr int SliceSamples = 361;
constexpr int PlaneSamples = 720;   // even ones, of which none is on the horizon
constexpr int MirrorSamples = 128;  // on each side of the mirror direction
constexpr double MirrorWidth = 4.0; // degrees on each side

//------------------------------------------------------------------------------
std::vector<double> MakePlaneAngles(double thetaI)
{
  std::vector<double> angles = { thetaI };
  const double step = 180.0 / PlaneSamples;
  for (int k = 0; k < PlaneSamples; ++k)
  {
    angles.push_back(-90.0 + (k + 0.5) * step);
  }
  for (int k = 1; k <= MirrorSamples; ++k)
  {
    const double share = static_cast<double>(k) / MirrorSamples;
    angles.push_back(thetaI - MirrorWidth * share * share);
    angles.push_back(std::min(thetaI + MirrorWidth * share * share, 90.0 - 0.5 * step));
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  return angles;
}

//------------------------------------------------------------------------------
// All around: the same, mirrored at the surface.
std::vector<double> MakeCircleAngles(double thetaI)
{
  std::vector<double> angles = MakePlaneAngles(thetaI);
  const std::size_t above = angles.size();
  for (std::size_t k = 0; k < above; ++k)
  {
    angles.push_back(angles[k] > 0.0 ? 180.0 - angles[k] : -180.0 - angles[k]);
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
Curve SampleSlice(vtkBRDF* brdf, int which, const std::array<double, 3>& at)
{
  constexpr double ends[3] = { 90.0, 90.0, 180.0 };
  double ranges[3][2];
  int samples[3];
  for (int k = 0; k < 3; ++k)
  {
    const double fixed = at[static_cast<std::size_t>(k)];
    ranges[k][0] = k == which ? 0.0 : fixed;
    ranges[k][1] = k == which ? ends[k] : fixed;
    samples[k] = k == which ? SliceSamples : 1;
  }
  vtkNew<vtkBRDFSliceSource> source;
  source->SetBRDF(brdf);
  source->SetThetaHRange(ranges[0]);
  source->SetThetaDRange(ranges[1]);
  source->SetPhiDRange(ranges[2]);
  source->SetNumberOfThetaH(samples[0]);
  source->SetNumberOfThetaD(samples[1]);
  source->SetNumberOfPhiD(samples[2]);
  source->SetUseThetaHSquared(true);
  source->Update();

  vtkTable* table = source->GetOutput();
  const char* const names[3] = { "theta_h", "theta_d", "phi_d" };
  Curve curve;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto get = [&](const char* name) { return table->GetValueByName(row, name).ToDouble(); };
    if (get("vtkValidPointMask") != 0.0)
    {
      curve.Degrees.push_back(get(names[which]));
      curve.Values.push_back({ get("red"), get("green"), get("blue") });
    }
  }
  return curve;
}

//------------------------------------------------------------------------------
Curve SamplePlaneOfIncidence(vtkBRDF* brdf, double thetaI, double phiI, vtkBTDF* transmission)
{
  const double theta = vtkMath::RadiansFromDegrees(thetaI);
  const double phi = vtkMath::RadiansFromDegrees(phiI);
  const double side[2] = { std::cos(phi), std::sin(phi) }; // where the light comes from
  const double i[3] = { std::sin(theta) * side[0], std::sin(theta) * side[1], std::cos(theta) };
  Curve curve;
  curve.Degrees = transmission ? MakeCircleAngles(thetaI) : MakePlaneAngles(thetaI);
  for (const double degrees : curve.Degrees)
  {
    const double angle = vtkMath::RadiansFromDegrees(degrees);
    const double o[3] = { -std::sin(angle) * side[0], -std::sin(angle) * side[1], std::cos(angle) };
    std::array<double, 3> f{};
    std::abs(degrees) < 90.0 ? brdf->Evaluate(i, o, f.data())
                             : transmission->Evaluate(i, o, f.data());
    curve.Values.push_back(f);
  }
  return curve;
}

//------------------------------------------------------------------------------
Curve SampleAlbedo(vtkBRDF* brdf)
{
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetBRDF(brdf);
  if (!analysis->Update())
  {
    throw tool::Error(tool::TakeErrorText());
  }
  Curve curve;
  for (int k = 0; k < analysis->GetNumberOfAngles(); ++k)
  {
    std::array<double, 3> albedo{};
    analysis->GetAlbedo(k, albedo.data());
    curve.Degrees.push_back(analysis->GetAngle(k));
    curve.Values.push_back(albedo);
  }
  return curve;
}

//------------------------------------------------------------------------------
Curve SampleTransmittance(vtkBTDF* transmission)
{
  vtkNew<vtkBRDFAnalysis> angles;
  Curve curve;
  for (int k = 0; k < angles->GetNumberOfAngles(); ++k)
  {
    const double degrees = angles->GetAngle(k);
    curve.Degrees.push_back(degrees);
    curve.Values.push_back(
      tool::MeasureTransmittance(transmission, degrees, tool::TransmissionRole::View));
  }
  return curve;
}
} // namespace explorer
