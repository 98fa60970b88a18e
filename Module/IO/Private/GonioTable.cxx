// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GonioTable.h"

#include "GonioGrid.h"
#include "GonioScatter.h"
#include "NumberText.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr float HalfTurn = 180.0f;

// Nodes of a grid for each reading; small grids may be emptier.
constexpr double GridNodesPerReading = 4.0;
constexpr double SmallGrid = 4096.0;

// In [0, 360).
float Wrap(float phi)
{
  const float turned = phi - FullTurn * std::floor(phi / FullTurn);
  return turned < FullTurn - 0.5f * GonioAngles::Same ? turned : 0.0f;
}

//------------------------------------------------------------------------------
// Azimuths in [0, 360), and from the light's where that is the same in all.
bool TurnAzimuths(std::vector<GonioAngles>& readings)
{
  const GonioAngles* first = nullptr;
  bool isotropic = true;
  for (GonioAngles& reading : readings)
  {
    reading.PhiI = Wrap(reading.PhiI);
    if (!reading.IsLightAlongNormal()) // there it means nothing
    {
      first = first ? first : &reading;
      const float apart = std::abs(reading.PhiI - first->PhiI);
      isotropic = isotropic && std::min(apart, FullTurn - apart) < GonioAngles::Same;
    }
  }
  for (GonioAngles& reading : readings)
  {
    reading.PhiO = Wrap(isotropic ? reading.PhiO - reading.PhiI : reading.PhiO);
    reading.PhiI = isotropic ? 0.0f : reading.PhiI;
  }
  return isotropic;
}

//------------------------------------------------------------------------------
// Whether anything was added.
bool Mirror(GonioReadings& readings)
{
  const std::vector<GonioAngles> angles = readings.Angles;
  if (std::any_of(angles.begin(), angles.end(),
        [](const GonioAngles& reading) { return reading.PhiO > HalfTurn + GonioAngles::Same; }))
  {
    return false;
  }
  for (std::size_t k = 0; k < angles.size(); ++k)
  {
    GonioAngles mirrored = angles[k];
    if (mirrored.PhiO > GonioAngles::Same && mirrored.PhiO < HalfTurn - GonioAngles::Same &&
        !mirrored.IsViewAlongNormal())
    {
      mirrored.PhiO = FullTurn - mirrored.PhiO;
      readings.Angles.push_back(mirrored);
      for (std::size_t c = 0; c < readings.Channels; ++c)
      {
        const float value = readings.Values[k * readings.Channels + c];
        readings.Values.push_back(value);
      }
    }
  }
  return readings.Angles.size() > angles.size();
}

// Where the readings are.
std::string DescribeAngles(const GonioReadings& readings)
{
  const auto range = [&readings](const float GonioAngles::*member)
  {
    const auto [low, high] = std::minmax_element(readings.Angles.begin(), readings.Angles.end(),
      [member](const GonioAngles& a, const GonioAngles& b) { return a.*member < b.*member; });
    return NumberText((*low).*member, 3) + " to " + NumberText((*high).*member, 3);
  };
  return "Measured with light at " + range(&GonioAngles::ThetaI) + " and views at " +
         range(&GonioAngles::ThetaO) + " degrees from the normal; constant outside these angles.";
}

// What the material reflects toward a view at 30 degrees, where that is strange.
std::string DescribeAlbedo(vtkBRDF* brdf)
{
  constexpr double darkest = 0.005; // soot reflects more
  const double o[3] = { 0.5, 0.0, std::sqrt(0.75) };
  double albedo[3];
  brdf->GetDirectionalAlbedo(o, albedo);
  const double largest = *std::max_element(albedo, albedo + 3);
  if (largest <= 1.0 && largest >= darkest)
  {
    return "";
  }
  return "The material reflects " + NumberText(largest, 3) +
         " times the light toward a view at 30 degrees: its values may be in another unit than "
         "1/sr.";
}

// Relative root mean square.
double GetError(vtkBRDF* brdf, const GonioReadings& readings)
{
  double error = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < readings.Angles.size(); ++k)
  {
    const GonioAngles& reading = readings.Angles[k];
    double i[3];
    double o[3];
    double f[3];
    PointGonio(reading.ThetaI, reading.PhiI, i);
    PointGonio(reading.ThetaO, reading.PhiO, o);
    if (i[2] > 0.0 && o[2] > 0.0)
    {
      brdf->Evaluate(i, o, f);
      const std::array<double, 3> color = readings.GetColor(k);
      for (std::size_t c = 0; c < 3; ++c)
      {
        error += (f[c] - std::max(color[c], 0.0)) * (f[c] - std::max(color[c], 0.0));
        sum += color[c] * color[c];
      }
    }
  }
  return sum > 0.0 ? std::sqrt(error / sum) : 0.0;
}
}

//------------------------------------------------------------------------------
std::string GonioTable::Make(GonioReadings readings)
{
  if (readings.Angles.empty())
  {
    return "found no readings";
  }
  this->Notes.push_back(DescribeAngles(readings));
  const bool isotropic = TurnAzimuths(readings.Angles);
  if (isotropic && Mirror(readings))
  {
    this->Notes.emplace_back("Views lie on one side of the plane of incidence: mirrored.");
  }
  GonioGrid grid = FindGonioGrid(readings.Angles);
  const double lights = double(grid.Light.Theta.size()) * double(grid.Light.Phi.size());
  const double views = double(grid.View.Theta.size()) * double(grid.View.Phi.size());
  const double most = vtkAngularTableBRDF::MaximumNodes / 2.0; // the horizon is added
  const bool isGrid =
    lights <= most && views <= most && lights * views <= MaximumGonioNodes &&
    lights * views <= std::max(GridNodesPerReading * double(readings.Angles.size()), SmallGrid);

  std::vector<float> rgb;
  if (isGrid)
  {
    GonioValues values = FillGonioGrid(grid, readings);
    rgb = std::move(values.RGB);
    if (values.Filled > 0)
    {
      this->Notes.push_back(std::to_string(values.Filled) +
                            " values are missing in the grid of angles: filled from their "
                            "neighbors.");
    }
    if (values.Repeated > 0)
    {
      this->Notes.push_back(
        std::to_string(values.Repeated) + " values repeat others' angles: averaged.");
    }
  }
  else
  {
    const std::string problem = ScatterGonioReadings(grid, readings, rgb);
    if (!problem.empty())
    {
      return problem;
    }
  }
  CloseGonioGrid(grid, isotropic, rgb);
  vtkNew<vtkAngularTableBRDF> table;
  const std::string problem = table->SetValues(grid.Light, grid.View, std::move(rgb),
    isotropic ? vtkAngularTableBRDF::LIGHT : vtkAngularTableBRDF::TANGENT);
  if (!problem.empty())
  {
    return problem;
  }
  if (!isGrid)
  {
    this->Notes.push_back("The views are scattered: interpolated onto " +
                          std::to_string(grid.View.Theta.size()) + " x " +
                          std::to_string(grid.View.Phi.size()) +
                          " even nodes, whose relative RMS difference from the readings is " +
                          NumberText(GetError(table, readings), 3) + ".");
  }
  const std::string albedo = DescribeAlbedo(table);
  if (!albedo.empty())
  {
    this->Notes.push_back(albedo);
  }
  this->BRDF = table;
  return "";
}
} // namespace measuredbrdf
