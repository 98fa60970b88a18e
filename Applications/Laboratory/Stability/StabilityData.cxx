// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: materials that no sample can be.
#include "FilledTable.h"
#include "Stability.h"
#include "Tool.h"

#include "vtkBRDFAnalysis.h"
#include "vtkNew.h"

#include <array>
#include <cmath>
#include <limits>

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
        { { "thesis", 0.4 }, { "basis", 0.3 }, { "table", 0.4 }, { "factored", 0.4 },
          { "anisotropic-table", 0.4 } },
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
} // namespace tool::stability
