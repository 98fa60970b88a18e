// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: does the error fall with size as theory has it?
#include "Stability.h"

#include "vtkLightSet.h"

#include <cmath>

using namespace tool::stability;

namespace
{
struct Series
{
  std::string Method;
  std::string Unit;
  std::vector<double> Sizes;
  double Order; // theory: error ~ size^-Order
  std::string Why;
  std::function<vtkSmartPointer<vtkRadianceIntegrator>(vtkBRDF*, vtkEnvironment*, int, int)> Make;
  double Exponent = 20.0; // of the plastic: where errors stay above those of the reference
};

//------------------------------------------------------------------------------
std::vector<Series> GetSeries(bool isShort)
{
  const std::vector<double> lights = { 16.0, 64.0, 256.0, 1024.0 };
  const auto loop = [](const std::string& method)
  {
    return [method](vtkBRDF* brdf, vtkEnvironment* environment, int size, int seed)
    {
      return MakeLightLoop(
        brdf, environment, MakeLights(environment, method, size, static_cast<unsigned int>(seed)));
    };
  };
  return {
    { "median-cut", "lights", lights, 1.0, "midpoints of cells in two dimensions",
      loop("median-cut") },
    { "variance", "lights", lights, 1.0, "midpoints of cells in two dimensions", loop("variance") },
    { "importance", "lights", lights, 0.5, "random; strata help", loop("importance") },
    { "soft-lights", "lights", lights, 1.0, "midpoints of cells in two dimensions",
      [](vtkBRDF* brdf, vtkEnvironment* environment, int size, int) {
        return MakeLightLoop(brdf, environment, MakeLights(environment, "variance", size), true);
      } },
    { "filtered", "samples", { 8.0, 32.0, 128.0, 512.0 }, 0.5,
      "GPU Gems 3, ch. 20: at least random",
      [](vtkBRDF* brdf, vtkEnvironment* environment, int size, int)
      { return MakeFiltered(brdf, environment, size); } },
    { "table", "rows, all sizes in proportion",
      isShort ? std::vector<double>{ 9.0, 13.0, 17.0 }
              : std::vector<double>{ 9.0, 11.0, 13.0, 17.0 },
      1.0,
      "linear interpolation of smooth radiance: 2, until the 9 bits of the texels show at 0.04 %",
      [](vtkBRDF* brdf, vtkEnvironment* environment, int size, int)
      { return MakeTable(brdf, environment, size, 2 * size / 3, size); },
      100.0 },
    { "basis", "functions", { 4.0, 8.0, 16.0, 32.0 }, 1.0,
      "smooth kernels: faster than any power, to the maps' error",
      [](vtkBRDF* brdf, vtkEnvironment* environment, int size, int)
      { return MakeBasis(brdf, environment, size); } },
  };
}

//------------------------------------------------------------------------------
void RunConvergence(Context& context)
{
  const vtkSmartPointer<vtkEnvironment> environment =
    context.Environment ? Shrink(context.Environment, 128)
                        : MakeEnvironment(128, 64, GetSmoothRadiance);
  const Pairs pairs = MakeSpherePairs(context.Short ? 120 : 300);
  for (const Series& series : GetSeries(context.Short))
  {
    const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(series.Exponent));
    const std::vector<double> reference = IntegrateReference(brdf, environment, pairs);
    std::vector<double> errors;
    std::string text;
    const int seeds = series.Method == "importance" ? 4 : 1;
    for (const double size : series.Sizes)
    {
      double error = 0.0;
      for (int seed = 1; seed <= seeds; ++seed)
      {
        error += GetRelativeL1(
          Integrate(series.Make(brdf, environment, static_cast<int>(size), seed), pairs),
          reference);
      }
      errors.push_back(error / seeds);
      text += (text.empty() ? "" : ", ") + Say(100.0 * errors.back()) + " %";
    }
    context.Add(series.Method, "slope of log error against log " + series.Unit,
      FitSlope(series.Sizes, errors), { -0.75 * series.Order, {}, "" });
    context.Findings.back().Note =
      "theory -" + Say(series.Order) + " (" + series.Why + "); " + text;
  }
}
}

namespace tool::stability
{
//------------------------------------------------------------------------------
void AddConvergenceCases(std::vector<Case>& cases)
{
  cases.push_back(
    { "convergence", "convergence", "order of convergence of every method", RunConvergence });
}
} // namespace tool::stability
