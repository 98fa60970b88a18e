// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: too few lights, too few samples, samples in the wrong place.
#include "Stability.h"
#include "Surface.h"

#include "vtkBRDFShaderInputs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLightSet.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace tool::stability;

namespace
{
const char* const TooFew = "too few lights, functions or samples for so sharp a lobe";

//------------------------------------------------------------------------------
/// Reflects back to where light comes from, and a little everywhere; but its sampling believes that
/// it is a mirror.
class MistakenBRDF : public vtkBRDF
{
public:
  static MistakenBRDF* New();
  vtkTypeMacro(MistakenBRDF, vtkBRDF);

  void GetBounds(double, double lower[3], double upper[3]) override
  {
    std::fill_n(lower, 3, Base);
    std::fill_n(upper, 3, Base + Peak);
  }
  void GetShaderInputs(vtkBRDFShaderInputs& form) override { form = vtkBRDFShaderInputs(); }

protected:
  MistakenBRDF() { this->Belief->SetExponent(500.0); }
  ~MistakenBRDF() override = default;

  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    std::fill_n(f, 3, Base + Peak * std::pow(std::max(vtkMath::Dot(i, o), 0.0), Exponent));
  }
  bool SampleAbove(const double o[3], double u1, double u2, double i[3]) override
  {
    return this->Belief->Sample(o, u1, u2, i);
  }
  double PdfAbove(const double i[3], const double o[3]) override { return this->Belief->Pdf(i, o); }

private:
  static constexpr double Base = 0.05;
  static constexpr double Peak = 0.8;
  static constexpr double Exponent = 60.0;
  vtkNew<vtkBlinnPhongBRDF> Belief;
};
vtkStandardNewMacro(MistakenBRDF);

//------------------------------------------------------------------------------
void RunDots(Context& context)
{
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(500.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("hall", 128);
  const Pairs pairs = MakeSpherePairs(context.Short ? 150 : 500);
  const std::vector<double> reference = IntegrateReference(brdf, environment, pairs);
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    const std::vector<double> radiance = Integrate(contender.Make(brdf, environment), pairs);
    context.Add(contender.Name, "RMS error, exponent 500", GetRelativeRMS(radiance, reference),
      { 0.1,
        { { "median-cut", 1.0 }, { "importance", 1.0 }, { "variance", 0.4 }, { "thesis", 1.2 },
          { "filtered", 0.4 } },
        TooFew });
    context.Add(contender.Name, "median error, exponent 500", GetMedianError(radiance, reference),
      { 0.02,
        { { "median-cut", 0.15 }, { "importance", 0.2 }, { "variance", 0.12 }, { "thesis", 0.5 },
          { "filtered", 0.2 } },
        TooFew });
  }
  context.Shown =
    MakeSphereSheet(context, "Few lights draw a sharp lobe as dots (exponent 500, built-in hall)",
      brdf, context.MakeEnvironment("hall", 64), GetMethodsUnderTest());
}

//------------------------------------------------------------------------------
void RunFireflies(Context& context)
{
  const int width = 64;
  vtkSmartPointer<vtkEnvironment> sky = MakeEnvironment(width, width / 2, GetSmoothRadiance);
  std::vector<float> pixels = sky->GetPixels();
  for (std::size_t k = 0; k < 4; ++k)
  {
    const std::size_t texel = (k * 743 + 211) % (pixels.size() / 3);
    std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(3 * texel), 3, 2e4f);
  }
  sky->SetPixels(width, width / 2, std::move(pixels));
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(20.0));
  const Pairs pairs = MakeSpherePairs(context.Short ? 200 : 600);
  const std::vector<double> reference = IntegrateReference(brdf, sky, pairs);
  const auto measure = [&](vtkRadianceIntegrator* integrator)
  {
    std::vector<double> excess = Integrate(integrator, pairs);
    double mean = 0.0;
    for (std::size_t k = 0; k < excess.size(); ++k)
    {
      excess[k] = std::max(0.0, excess[k] - reference[k]);
      mean += reference[k] / static_cast<double>(reference.size());
    }
    return GetLargest(excess) / mean;
  };
  const std::string figure = "largest excess over the mean radiance";
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    context.Add(contender.Name, figure, measure(contender.Make(brdf, sky)), { 0.5, {}, "" });
  }
}

//------------------------------------------------------------------------------
// A light that sets must fade with the cosine.
void RunHorizon(Context& context)
{
  double worst = 0.0;
  std::string name;
  for (int m = 0; m < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++m)
  {
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(
      vtkEmbeddedMaterials::NewBRDF(vtkEmbeddedMaterials::GetName(m)));
    vtkNew<vtkLightSet> lights;
    const double irradiance[3] = { 1.0, 1.0, 1.0 };
    const double direction[3] = { 1.0, 0.0, 0.0 };
    lights->AddLight(direction, irradiance);
    Pairs pairs;
    for (const double cosine : { 0.02, 1e-3, 1e-5, -1e-5 })
    {
      const Vector n = { cosine, 0.0, std::sqrt(1.0 - cosine * cosine) };
      pairs.Add(n, { -0.6, 0.0, 0.8 });
    }
    const std::vector<double> radiance = Integrate(MakeLightLoop(brdf, nullptr, lights), pairs);
    double last = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      const double before = radiance[c] > 0.0 ? radiance[c] : 1.0;
      last = std::max({ last, radiance[6 + c] / before, radiance[9 + c] });
    }
    if (last >= worst)
    {
      worst = last;
      name = vtkEmbeddedMaterials::GetName(m);
    }
  }
  context.Add("light loop",
    "radiance at cosine 1e-5 over that at 0.02, the worst of the embedded materials", worst, 0.05,
    name);

  // And a strip of light along the horizon, by every method, with the surface level.
  const vtkSmartPointer<vtkEnvironment> strip =
    MakeEnvironment(context.Short ? 64 : 128, context.Short ? 32 : 64,
      [](const Vector& d)
      {
        const double value = std::exp(-400.0 * d[1] * d[1]);
        return Vector{ value, value, value };
      });
  Pairs pairs;
  for (int k = 0; k < 150; ++k)
  {
    // Normals within 6 degrees of the pole, views 10 to 80 degrees from it.
    const double tilt = vtkMath::RadiansFromDegrees(6.0) * std::sqrt((k + 0.5) / 150.0);
    const double phi = 2.4 * k;
    const double angle = vtkMath::RadiansFromDegrees(10.0 + 70.0 * ((k * 37) % 150) / 150.0);
    pairs.Add({ std::sin(tilt) * std::cos(phi), std::cos(tilt), std::sin(tilt) * std::sin(phi) },
      { std::sin(angle), std::cos(angle), 0.0 });
  }
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(50.0));
  const std::vector<double> reference = IntegrateReference(brdf, strip, pairs);
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    context.Add(contender.Name, "error, a strip of light on the horizon",
      GetRelativeL1(Integrate(contender.Make(brdf, strip), pairs), reference),
      { 0.05,
        { { "median-cut", 0.15 }, { "importance", 0.3 }, { "variance", 0.3 }, { "thesis", 0.3 },
          { "filtered", 10.0 } },
        "cells and wide samples carry light across the horizon" });
  }
}

//------------------------------------------------------------------------------
// Albedo by the midpoint rule.
double SumAlbedo(vtkBRDF* brdf, const double o[3])
{
  constexpr int rows = 400;
  constexpr int columns = 800;
  double sum = 0.0;
  for (int y = 0; y < rows; ++y)
  {
    const double cosine = (y + 0.5) / rows;
    const double sine = std::sqrt(1.0 - cosine * cosine);
    for (int x = 0; x < columns; ++x)
    {
      const double phi = 2.0 * vtkMath::Pi() * (x + 0.5) / columns;
      const double i[3] = { sine * std::cos(phi), sine * std::sin(phi), cosine };
      double f[3];
      brdf->Evaluate(i, o, f);
      sum += f[0] * cosine;
    }
  }
  return sum * 2.0 * vtkMath::Pi() / (rows * columns);
}

//------------------------------------------------------------------------------
void RunMissedLobe(Context& context)
{
  vtkNew<MistakenBRDF> brdf;
  const double o[3] = { 0.6, 0.0, 0.8 };
  const double expected = SumAlbedo(brdf, o);
  double albedo[3];
  brdf->GetDirectionalAlbedo(o, albedo);
  context.Add("albedo", "relative error of GetDirectionalAlbedo",
    std::abs(albedo[0] - expected) / expected, 0.01);

  // What its own samples alone make of it.
  constexpr int count = 4096;
  double naive = 0.0;
  for (int k = 0; k < count; ++k)
  {
    double i[3];
    const double u = std::fmod(0.5 + 0.6180339887498949 * k, 1.0);
    if (brdf->Sample(o, (k + 0.5) / count, u, i))
    {
      double f[3];
      brdf->Evaluate(i, o, f);
      naive += f[0] * i[2] / brdf->Pdf(i, o) / count;
    }
  }
  context
    .Add("own samples", "relative error of the albedo, 4096 samples",
      std::abs(naive - expected) / expected, 0.01)
    .KnownUpTo(Unlimited, "no mixture: shown on purpose");

  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 64);
  const Pairs pairs = MakeSpherePairs(context.Short ? 150 : 300);
  const std::vector<double> reference = IntegrateReference(brdf, environment, pairs);
  for (const int samples : { 16, 256 })
  {
    Finding& finding = context.Add("filtered", "error, " + std::to_string(samples) + " samples",
      GetRelativeL1(Integrate(MakeFiltered(brdf, environment, samples), pairs), reference), 0.05);
    if (samples == 16)
    {
      finding.KnownUpTo(0.5, "the cosine's half of the mixture finds the lobe with few samples");
    }
  }
}
}

namespace tool::stability
{
//------------------------------------------------------------------------------
void AddSamplingCases(std::vector<Case>& cases)
{
  cases.push_back({ "dots", "sampling", "few lights on a sharp lobe", RunDots });
  cases.push_back(
    { "fireflies", "sampling", "bright texels that samples hit or miss", RunFireflies });
  cases.push_back({ "horizon", "sampling", "lights that set", RunHorizon });
  cases.push_back({ "missed-lobe", "sampling", "sampling that misses a lobe", RunMissedLobe });
}
} // namespace tool::stability
