// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: materials that no sample can be; very large and very small values, in textures and in
// sums.
#include "FilledTable.h"
#include "Stability.h"
#include "Surface.h"
#include "Tool.h"

#include "vtkBRDFAnalysis.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkLightSet.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

using namespace tool::stability;

namespace
{
constexpr int TableSize = 32;

//------------------------------------------------------------------------------
/// A table of a plastic, each cell changed: (cell, its value) -> value.
vtkSmartPointer<vtkBRDF> MakeMaterial(
  const std::function<double(std::size_t, double)>& change, int range = vtkTabulatedBRDF::HALF_TURN)
{
  const vtkSmartPointer<vtkBRDF> plastic = MakePlastic(20.0);
  return FillTable({ 12, 24, 32 }, range,
    [&](std::size_t cell, const double* i, const double* o)
    {
      std::array<double, 3> f = { 0.1, 0.1, 0.1 };
      if (i)
      {
        plastic->Evaluate(i, o, f.data());
      }
      for (double& value : f)
      {
        value = change(cell, value);
      }
      return f;
    });
}

/// In [0, 1), by cell.
double Hash(std::size_t cell)
{
  return std::fmod(0.6180339887498949 * static_cast<double>(cell), 1.0);
}

//------------------------------------------------------------------------------
struct Oddity
{
  std::string Name;
  vtkSmartPointer<vtkBRDF> BRDF;
  tool::stability::Limits Limits = { 0.1, {}, "" };
};

std::vector<Oddity> MakeOddities()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return { { "albedo 4", MakeLambert(4.0) },
    { "not reciprocal", MakeMaterial([](std::size_t cell, double value)
                          { return value * ((cell + 3) % 12 < 6 ? 1.6 : 0.4); },
                          vtkTabulatedBRDF::FULL_TURN) },
    { "no mirror symmetry",
      MakeMaterial([](std::size_t cell, double value)
        { return value * (cell % 12 < 6 ? 1.6 : 0.4); },
        vtkTabulatedBRDF::FULL_TURN),
      { 0.1, { { "table", 0.8 }, { "factored", 0.8 } },
        "taken as symmetric about the plane of incidence; the planner tries and refuses it" } },
    { "negative cells",
      MakeMaterial(
        [](std::size_t cell, double value) { return value - (Hash(cell) < 0.2 ? 0.3 : 0.0); }),
      { 0.1,
        { { "thesis", 0.4 }, { "table", 0.4 }, { "factored", 0.4 }, { "anisotropic-table", 0.4 } },
        "noise from cell to cell is finer than rows, view angles and functions" } },
    { "missing cells", MakeMaterial([nan](std::size_t cell, double value)
                         { return Hash(cell) < 0.3 ? nan : value; }) },
    { "values of 1e30", MakeMaterial([](std::size_t, double value) { return 1e30 * value; }) },
    { "no valid cell", MakeMaterial([nan](std::size_t, double) { return nan; }) },
    { "zero", MakeMaterial([](std::size_t, double) { return 0.0; }) } };
}

//------------------------------------------------------------------------------
void RunOddities(Context& context)
{
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 128);
  const Pairs pairs = MakeSpherePairs(100);
  StabilityRenderer offscreen(context);
  for (const Oddity& oddity : MakeOddities())
  {
    if (context.Short && (oddity.Name == "albedo 4" || oddity.Name == "not reciprocal" ||
                           oddity.Name == "values of 1e30" || oddity.Name == "zero"))
    {
      continue;
    }
    const std::vector<double> reference = IntegrateReference(oddity.BRDF, environment, pairs);
    for (const MethodUnderTest& contender : GetMethodsUnderTest())
    {
      const vtkSmartPointer<vtkRadianceIntegrator> integrator =
        contender.Make(oddity.BRDF, environment);
      const std::vector<double> radiance = Integrate(integrator, pairs);
      offscreen.SetIntegrator(integrator);
      offscreen.Draw(TableSize);
      context.Add(contender.Name, "negative or not finite: " + oddity.Name,
        CountBad(radiance) + offscreen.GetNumberOfBad(), 0.0);
      context.Add(
        contender.Name, "error: " + oddity.Name, GetRelativeL1(radiance, reference), oddity.Limits);
    }
  }
}

//------------------------------------------------------------------------------
// What `info` tells of them.
void RunDetection(Context& context)
{
  const auto analyze = [](vtkBRDF* brdf)
  {
    auto analysis = vtkSmartPointer<vtkBRDFAnalysis>::New();
    analysis->SetBRDF(brdf);
    analysis->SetNumberOfPairs(4000);
    if (!analysis->Update())
    {
      throw tool::Error("analysis: " + tool::TakeErrorText());
    }
    return analysis;
  };
  const std::vector<Oddity> oddities = MakeOddities();
  context.Add(
    "analysis", "albedo above 1 not noticed", !analyze(oddities[0].BRDF)->GetGainsEnergy(), 0.0);
  context.Add("analysis", "asymmetry not noticed",
    !(analyze(oddities[1].BRDF)->GetReciprocityError() > 0.01), 0.0);
  context.Add("analysis", "negative values not noticed",
    !(analyze(oddities[3].BRDF)->GetNegativeMass() > 0.01), 0.0);
  const auto plastic = analyze(MakePlastic(20.0));
  context.Add("analysis", "false alarms for a physical material",
    plastic->GetGainsEnergy() + (plastic->GetReciprocityError() > 1e-6) +
      (plastic->GetNegativeMass() > 0.0),
    0.0);
}

constexpr double Sun = 2e5; // times the mean: what photographs of the sky hold

//------------------------------------------------------------------------------
Pairs MakeDrawnPairs(int count)
{
  Pairs all = MakeSpherePairs(count);
  // Not those next to the rim, where 32-bit normals decide.
  Pairs kept;
  for (std::size_t k = 0; k < all.Normals.size(); k += 3)
  {
    const double* n = &all.Normals[k];
    const double* v = &all.Views[k];
    if (n[0] * v[0] + n[1] * v[1] + n[2] * v[2] > 0.05)
    {
      kept.Add({ n[0], n[1], n[2] }, { v[0], v[1], v[2] });
    }
  }
  return kept;
}

//------------------------------------------------------------------------------
// A table of a lobe whose values span far more than 16-bit floats do.
vtkSmartPointer<vtkBRDF> MakeWideTable(double exponent, double scale, int precision)
{
  const vtkSmartPointer<vtkBRDF> lobe = MakeLobe(exponent);
  const auto table = FillTable({ 4, 16, 64 }, vtkTabulatedBRDF::HALF_TURN,
    [&](std::size_t, const double* i, const double* o)
    {
      std::array<double, 3> f = { 0.0, 0.0, 0.0 };
      if (i)
      {
        lobe->Evaluate(i, o, f.data());
      }
      for (double& value : f)
      {
        value *= scale;
      }
      return f;
    });
  table->SetPrecision(precision);
  return table;
}

//------------------------------------------------------------------------------
void RunHalfFloat(Context& context)
{
  const Pairs pairs = MakeDrawnPairs(200);
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 32);
  const vtkSmartPointer<vtkLightSet> lights = MakeLights(environment, "variance", 64);
  for (const double scale : { 1e-7, 1.0, 1e6 })
  {
    for (const int precision : { vtkTabulatedBRDF::FLOAT16, vtkTabulatedBRDF::FLOAT32 })
    {
      const vtkSmartPointer<vtkBRDF> table = MakeWideTable(300.0, scale, precision);
      const vtkSmartPointer<vtkRadianceIntegrator> loop = MakeLightLoop(table, environment, lights);
      context.Add(precision == vtkTabulatedBRDF::FLOAT16 ? "16-bit table" : "32-bit table",
        "GPU against double, values times " + Say(scale),
        GetRelativeL1(tool::DrawPairs(loop, pairs.Normals, pairs.Views), Integrate(loop, pairs)),
        precision == vtkTabulatedBRDF::FLOAT16 ? 2e-3 : 2e-4);
    }
  }
}

//------------------------------------------------------------------------------
// Radiance times a factor must come out as the factor: nothing may overflow or vanish.
void RunScales(Context& context)
{
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(50.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 64);
  const Pairs pairs = MakeDrawnPairs(150);
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    const std::vector<double> reference = Integrate(contender.Make(brdf, environment), pairs);
    for (const double scale :
      context.Short ? std::vector<double>{ 1e-6 } : std::vector<double>{ 1e-6, 1.0, 1e6 })
    {
      const vtkSmartPointer<vtkRadianceIntegrator> integrator =
        contender.Make(brdf, Scale(environment, scale));
      std::vector<double> drawn = tool::DrawPairs(integrator, pairs.Normals, pairs.Views);
      for (double& value : drawn)
      {
        value /= scale;
      }
      context.Add(contender.Name, "GPU against double, radiance times " + Say(scale),
        GetRelativeL1(drawn, reference), 2e-3);
    }
  }
}

//------------------------------------------------------------------------------
void RunSun(Context& context)
{
  const int width = context.Short ? 64 : 256;
  vtkSmartPointer<vtkEnvironment> sky = MakeEnvironment(width, width / 2, GetSmoothRadiance);
  std::vector<float> pixels = sky->GetPixels();
  const std::size_t at = 3 * (static_cast<std::size_t>(width / 2 * 3 / 4) * width + width * 2 / 3);
  std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(at), 3, static_cast<float>(Sun));
  sky->SetPixels(width, width / 2, std::move(pixels));
  const Pairs pairs = MakeSpherePairs(context.Short ? 150 : 300);
  for (const double exponent : { 0.0, 50.0 })
  {
    const vtkSmartPointer<vtkBRDF> brdf = exponent > 0.0 ? MakePlastic(exponent) : MakeLambert(0.5);
    const std::vector<double> reference = IntegrateReference(brdf, sky, pairs);
    for (const MethodUnderTest& contender : GetMethodsUnderTest())
    {
      context.Add(contender.Name,
        "error, " + std::string(exponent > 0.0 ? "plastic, exponent 50" : "Lambert"),
        GetRelativeL1(Integrate(contender.Make(brdf, sky), pairs), reference),
        { 0.05, { { "thesis", 0.15 } }, "the basis rings under one light" });
    }
  }
  if (!context.Short) // `dots` draws such a sheet in any case
  {
    context.Shown = MakeSphereSheet(context, "A texel 2e5 times the mean, plastic of exponent 50",
      MakePlastic(50.0), Shrink(sky, 64), GetMethodsUnderTest());
  }
}
}

namespace tool::stability
{
//------------------------------------------------------------------------------
void AddDataCases(std::vector<Case>& cases)
{
  cases.push_back(
    { "oddities", "data", "albedo above 1, asymmetry, negative and missing values", RunOddities });
  cases.push_back({ "detection", "data", "whether such data are noticed", RunDetection });
}

//------------------------------------------------------------------------------
void AddRangeCases(std::vector<Case>& cases)
{
  cases.push_back(
    { "half-float", "range", "tables whose values 16-bit floats can't hold", RunHalfFloat });
  cases.push_back({ "scales", "range", "radiance times 1e-6 to 1e6", RunScales });
  cases.push_back({ "sun", "range", "one texel of 2e5 times the mean", RunSun });
}
} // namespace tool::stability
