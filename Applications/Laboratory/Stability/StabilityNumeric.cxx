// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: conditioning, local optima, precision, orders of convergence.
#include "Progress.h"
#include "Stability.h"
#include "Surface.h"
#include "Tool.h"

#include "vtkAshikhminShirleyBRDFFitter.h"
#include "vtkBRDFResampler.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDFFitter.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLightSet.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace tool::stability;

namespace
{
//------------------------------------------------------------------------------
// Of the Gram matrix of a basis' functions over polar angles in degrees, with a penalty
// lambda (l(l+1))^2.
double GetCondition(int basis, int order, const double zone[2], double lambda)
{
  const int rows = 96;
  const int columns = 4 * order + 4;
  const auto n = static_cast<std::size_t>((order + 1) * (order + 1));
  std::vector<double> gram(n * n, 0.0);
  const double near = std::cos(vtkMath::RadiansFromDegrees(zone[0]));
  const double far = std::cos(vtkMath::RadiansFromDegrees(zone[1]));
  const double weight = (near - far) / rows * 2.0 * vtkMath::Pi() / columns;
  for (int y = 0; y < rows; ++y)
  {
    const double cosine = far + (near - far) * (y + 0.5) / rows;
    const double sine = std::sqrt(1.0 - cosine * cosine);
    for (int x = 0; x < columns; ++x)
    {
      const double phi = 2.0 * vtkMath::Pi() * (x + 0.5) / columns;
      const double direction[3] = { sine * std::cos(phi), sine * std::sin(phi), cosine };
      const std::vector<double> values = vtkBasisBRDF::EvaluateBasis(basis, order, zone, direction);
      for (std::size_t a = 0; a < n; ++a)
      {
        for (std::size_t b = 0; b < n; ++b)
        {
          gram[a * n + b] += weight * values[a] * values[b];
        }
      }
    }
  }
  for (std::size_t a = 0; a < n; ++a)
  {
    const double l = std::floor(std::sqrt(static_cast<double>(a)));
    gram[a * n + a] += lambda * l * l * (l + 1.0) * (l + 1.0);
  }
  std::vector<double*> rowsOf;
  std::vector<double> vectors(n * n);
  std::vector<double*> vectorsOf;
  for (std::size_t a = 0; a < n; ++a)
  {
    rowsOf.push_back(&gram[a * n]);
    vectorsOf.push_back(&vectors[a * n]);
  }
  std::vector<double> values(n);
  vtkMath::JacobiN(rowsOf.data(), static_cast<int>(n), values.data(), vectorsOf.data());
  return values.front() / std::max(values.back(), 1e-300);
}

//------------------------------------------------------------------------------
void RunGram(Context& context)
{
  const double hemisphere[2] = { 0.0, 90.0 };
  const double zone[2] = { 9.0, 57.0 };
  const double threshold = 1e4; // 32-bit coefficients keep three digits
  for (const int order : context.Short ? std::vector<int>{ 4 } : std::vector<int>{ 4, 6 })
  {
    const std::string suffix = " " + std::to_string(order);
    const auto add =
      [&](const std::string& name, int basis, const double* where, double lambda, bool known)
    {
      Finding& finding = context.Add(name + suffix,
        std::string("condition of the Gram matrix, ") +
          (where == zone ? "9 to 57 degrees" : "hemisphere"),
        GetCondition(basis, order, where, lambda), threshold);
      if (known)
      {
        finding.KnownUpTo(Unlimited, "not orthogonal there; the product adds a penalty");
      }
    };
    add("zonal", vtkBasisBRDF::ZONAL, zone, 0.0, false);
    add("Leg.xFourier", vtkBasisBRDF::LEGENDRE_FOURIER, zone, 0.0, false);
    add("hemisph.", vtkBasisBRDF::HEMISPHERICAL, hemisphere, 0.0, false);
    add("harm.", vtkBasisBRDF::SPHERICAL_HARMONICS, hemisphere, 0.0, true);
    add("harm.", vtkBasisBRDF::SPHERICAL_HARMONICS, zone, 0.0, true);
    add("harm.+pen.", vtkBasisBRDF::SPHERICAL_HARMONICS, hemisphere, 1e-6, true);
    add("harm.+pen.", vtkBasisBRDF::SPHERICAL_HARMONICS, zone, 1e-5, true);
  }
}

//------------------------------------------------------------------------------
// Share of the runs whose result is another material than the best of them: what differs by more
// than 5 % of L2 is another optimum. Random starts with the same pairs, then other pairs.
void RunFits(Context& context)
{
  const unsigned int runs = context.Short ? 6 : 100;
  constexpr double different = 0.05;
  auto material = context.BRDF;
  if (!material)
  {
    material = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint"));
  }
  const auto lobes = [](int count)
  {
    return [count]() -> vtkSmartPointer<vtkBRDFFitter>
    {
      auto fitter = vtkSmartPointer<vtkAshikhminShirleyBRDFFitter>::New();
      fitter->SetNumberOfLobes(count);
      return fitter;
    };
  };
  const std::vector<std::pair<std::string, std::function<vtkSmartPointer<vtkBRDFFitter>()>>>
    kinds = { { "A.-S., 1 lobe", lobes(1) }, { "A.-S., 2 lobes", lobes(2) },
      { "Blinn-Phong",
        []() -> vtkSmartPointer<vtkBRDFFitter>
        { return vtkSmartPointer<vtkBlinnPhongBRDFFitter>::New(); } },
      { "D-BRDF", []() -> vtkSmartPointer<vtkBRDFFitter> {
         return vtkSmartPointer<vtkDistributionBRDFFitter>::New();
       } } };
  for (const auto& [name, make] : kinds)
  {
    for (const bool starts : { true, false })
    {
      std::vector<vtkSmartPointer<vtkBRDF>> results;
      std::size_t best = 0;
      double least = Unlimited;
      for (unsigned int seed = 1; seed <= runs; ++seed)
      {
        tool::Interruptible::Check();
        const vtkSmartPointer<vtkBRDFFitter> fitter = make();
        fitter->SetInput(material);
        fitter->SetNumberOfSamples(4096);
        if (starts)
        {
          fitter->SetStartSeed(seed);
        }
        else
        {
          fitter->SetSeed(seed);
        }
        if (!fitter->Fit())
        {
          throw tool::Error("fit: " + tool::TakeErrorText());
        }
        results.push_back(fitter->GetOutput());
        if (fitter->GetResidual() < least)
        {
          least = fitter->GetResidual();
          best = results.size() - 1;
        }
      }
      double others = 0.0;
      double farthest = 0.0;
      for (const auto& result : results)
      {
        const double distance =
          vtkBRDFResampler::GetRelativeL2Error(results[best], result, 1 << 12);
        others += distance > different;
        farthest = std::max(farthest, distance);
      }
      context.Add(name,
        "share of " + std::to_string(runs) + (starts ? " random starts" : " draws of the pairs") +
          " that end at another optimum",
        others / runs,
        starts ? Limits{ 0.05, {}, "" }
               : Limits{ 0.05, { { "D-BRDF", 1.0 } },
                   "a tabulated p(h) follows the 4096 pairs that each seed draws" });
      context.Findings.back().Note = "farthest " + Say(100.0 * farthest) + " % of L2 from the best";
    }
  }
}

//------------------------------------------------------------------------------
// Sums of many terms in the shader's 32 bits.
void RunPrecision(Context& context)
{
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(100.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 128);
  // One view, so that all are one picture.
  Pairs same = MakeSpherePairs(150);
  same.Normals.resize(3 * 120);
  same.Views.resize(3 * 120);
  struct Size
  {
    std::string Name;
    vtkSmartPointer<vtkRadianceIntegrator> Integrator;
    double Threshold;
  };
  const std::vector<Size> sizes = {
    { "4096 lights", MakeLightLoop(brdf, environment, MakeLights(environment, "variance", 4096)),
      1e-5 },
    { "256 samples", MakeFiltered(brdf, environment, 256), 1e-3 },
    { "table", MakeTable(brdf, environment, 65, 12, 16), 2e-3 }
  };
  for (const Size& size : sizes)
  {
    context.Add(size.Name, "shader in 32 bits against double",
      GetRelativeL1(tool::DrawPairs(size.Integrator, same.Normals, same.Views),
        Integrate(size.Integrator, same)),
      size.Threshold);
  }
}

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
void AddNumericCases(std::vector<Case>& cases)
{
  cases.push_back({ "gram", "numeric", "how well bases are conditioned", RunGram });
  cases.push_back({ "fits", "numeric", "fits from many starts: the same optimum?", RunFits });
  cases.push_back({ "precision", "numeric", "32 bits against 64", RunPrecision });
}

//------------------------------------------------------------------------------
void AddConvergenceCases(std::vector<Case>& cases)
{
  cases.push_back(
    { "convergence", "convergence", "order of convergence of every method", RunConvergence });
}
} // namespace tool::stability
