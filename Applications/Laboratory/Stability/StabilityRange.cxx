// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: very large and very small values, in textures and in sums.
#include "FilledTable.h"
#include "Stability.h"
#include "Surface.h"

#include "vtkBlinnPhongBRDF.h"
#include "vtkLightSet.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

using namespace tool::stability;

namespace
{
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
void AddRangeCases(std::vector<Case>& cases)
{
  cases.push_back(
    { "half-float", "range", "tables whose values 16-bit floats can't hold", RunHalfFloat });
  cases.push_back({ "scales", "range", "radiance times 1e-6 to 1e6", RunScales });
  cases.push_back({ "sun", "range", "one texel of 2e5 times the mean", RunSun });
}
} // namespace tool::stability
