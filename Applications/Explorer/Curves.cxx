// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Curves.h"

#include "Inspection.h"
#include "LogAxis.h"
#include "Tool.h"

#include "vtkBRDFAnalysis.h"
#include "vtkBRDFSliceSource.h"
#include "vtkEnvironment.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace explorer
{
namespace
{
constexpr int SliceSamples = 361;
constexpr int PlaneSamples = 720;   // even ones, of which none is on the horizon
constexpr int MirrorSamples = 128;  // on each side of the mirror direction
constexpr double MirrorWidth = 4.0; // degrees on each side

//------------------------------------------------------------------------------
// All around: the upper half's, mirrored at the surface.
std::vector<double> MakePlaneAngles(double thetaI, bool allAround)
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
  for (std::size_t k = 0, above = angles.size(); k < above && allAround; ++k)
  {
    angles.push_back(angles[k] > 0.0 ? 180.0 - angles[k] : -180.0 - angles[k]);
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  return angles;
}
}

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
  curve.Degrees = MakePlaneAngles(thetaI, transmission != nullptr);
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

namespace
{
const QColor Channels[3] = { { 214, 64, 54 }, { 46, 140, 62 }, { 52, 98, 204 } };
constexpr double Darkest = 1e-6; // of the largest value

//------------------------------------------------------------------------------
// 1, 2 or 5 times a power of ten: three to five steps up to the largest value.
double FindStep(double largest)
{
  const double power = std::pow(10.0, std::floor(std::log10(largest / 4.0)));
  for (const double factor : { 1.0, 2.0, 5.0 })
  {
    if (factor * power >= largest / 4.0)
    {
      return factor * power;
    }
  }
  return 10.0 * power;
}
}

//------------------------------------------------------------------------------
QColor GetMaterialColor(std::size_t k)
{
  static const QColor colors[] = { { 30, 30, 30 }, { 31, 119, 180 }, { 230, 110, 10 },
    { 44, 150, 44 }, { 214, 39, 40 }, { 148, 103, 189 }, { 140, 86, 75 }, { 227, 90, 180 },
    { 0, 170, 190 } };
  return colors[k % std::size(colors)];
}

//------------------------------------------------------------------------------
std::vector<ChartLine> MakeLines(const std::vector<Curve>& curves)
{
  const bool isOne = curves.size() == 1;
  std::vector<ChartLine> lines;
  for (std::size_t k = 0; k < (isOne ? 3 : curves.size()); ++k)
  {
    const Curve& curve = curves[isOne ? 0 : k];
    ChartLine line{ isOne ? Channels[k] : GetMaterialColor(k), curve.Degrees, {} };
    for (const auto& rgb : curve.Values)
    {
      line.Values.push_back(isOne ? rgb[k] : vtkEnvironment::GetLuminance(rgb.data()));
    }
    lines.push_back(line);
  }
  return lines;
}

//------------------------------------------------------------------------------
ChartScale::ChartScale(const std::vector<ChartLine>& lines, bool logarithmic)
  : Logarithmic(logarithmic)
{
  double peak = 0.0;
  for (const ChartLine& line : lines)
  {
    for (const double value : line.Values)
    {
      peak = std::max(peak, value);
    }
  }
  this->Floor = std::max(Darkest * peak, std::numeric_limits<double>::min());
  if (!logarithmic)
  {
    this->Largest = peak > 0.0 ? 1.05 * peak : 1.0;
    const double step = FindStep(this->Largest);
    for (int k = 0; k * step <= this->Largest; ++k)
    {
      this->Ticks.emplace_back(
        this->Find(k * step), tool::FormatTick(k * step, tool::Unit::Number));
    }
    return;
  }
  tool::LogAxis axis;
  for (const ChartLine& line : lines)
  {
    for (const double value : line.Values)
    {
      axis.Take(peak > 0.0 ? std::max(value, this->Floor) : 0.0);
    }
  }
  axis.Widen();
  this->Least = axis.GetLeast();
  this->Largest = axis.GetLargest();
  for (const double exponent : axis.GetTicks())
  {
    const double value = std::pow(10.0, exponent);
    this->Ticks.emplace_back(this->Find(value), tool::FormatTick(value, tool::Unit::Number));
  }
}

//------------------------------------------------------------------------------
double ChartScale::Find(double value) const
{
  const double place =
    this->Logarithmic ? std::max(std::log10(std::max(value, this->Floor)), this->Least) : value;
  return (place - this->Least) / (this->Largest - this->Least);
}
} // namespace explorer
