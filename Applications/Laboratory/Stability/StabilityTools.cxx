// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StabilityTools.h"

#include "Methods.h"
#include "Tool.h"

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBasisBRDF.h"
#include "vtkBasisProjector.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkNew.h"
#include "vtkRadianceMethods.h"
#include "vtkRadiancePlanner.h"
#include "vtkSumBRDF.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace
{
constexpr int Lights = 64;      // of the thesis
constexpr int SoftLights = 256; // the planner's, for anisotropic materials
constexpr int Samples = 16;     // the planner's
constexpr int ThesisOrder = 6;

using tool::stability::Vector;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> Plan(vtkBRDF* brdf, vtkEnvironment* environment)
{
  vtkNew<vtkRadiancePlanner> planner;
  planner->SetBRDF(brdf);
  planner->SetEnvironment(environment);
  if (!planner->Update())
  {
    throw tool::Error("planning: " + tool::TakeErrorText());
  }
  return vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
}

//------------------------------------------------------------------------------
template <typename Integrator>
vtkSmartPointer<Integrator> MakeFor(vtkBRDF* brdf, vtkEnvironment* environment)
{
  auto integrator = vtkSmartPointer<Integrator>::New();
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  return integrator;
}

//------------------------------------------------------------------------------
tool::stability::MethodUnderTest MakeLightContender(const std::string& method)
{
  return { method, false,
    [method](vtkBRDF* brdf, vtkEnvironment* environment)
    {
      return tool::stability::MakeLightLoop(
        brdf, environment, tool::stability::MakeLights(environment, method, Lights));
    } };
}
}

namespace tool::stability
{
namespace
{
//------------------------------------------------------------------------------
// And the other methods of vtkRadianceMethods, at the sizes that they come with.
std::vector<MethodUnderTest> AddOthers(std::vector<MethodUnderTest> known)
{
  for (const auto& method : vtkRadianceMethods::GetMethods())
  {
    const std::string name = method->GetMethodName();
    if (!IsOnCpuOnly(name) && name != "light-set" && // which is three of them
        std::none_of(known.begin(), known.end(),
          [&name](const MethodUnderTest& other) { return other.Name == name; }))
    {
      known.push_back({ name, true,
        [method](vtkBRDF* brdf, vtkEnvironment* environment)
        {
          auto made = vtkSmartPointer<vtkRadianceIntegrator>::Take(method->NewCopy());
          made->SetBRDF(brdf);
          made->SetEnvironment(environment);
          return made;
        } });
    }
  }
  return known;
}
}

//------------------------------------------------------------------------------
const std::vector<MethodUnderTest>& GetMethodsUnderTest()
{
  static const std::vector<MethodUnderTest> contenders = AddOthers({
    MakeLightContender("median-cut"),
    MakeLightContender("importance"),
    MakeLightContender("variance"),
    { "thesis", false,
      [](vtkBRDF* brdf, vtkEnvironment* environment)
      {
        return MakeLightLoop(Project(brdf, vtkBasisBRDF::SPHERICAL_HARMONICS, ThesisOrder),
          environment, MakeLights(environment, "median-cut", Lights));
      } },
    { "soft-lights", true,
      [](vtkBRDF* brdf, vtkEnvironment* environment)
      {
        return MakeLightLoop(
          brdf, environment, MakeLights(environment, "variance", SoftLights), true);
      } },
    { "filtered", false,
      [](vtkBRDF* brdf, vtkEnvironment* environment)
      { return MakeFiltered(brdf, environment, Samples); } },
    { "table", true,
      [](vtkBRDF* brdf, vtkEnvironment* environment)
      { return MakeTable(brdf, environment, 65, 12, 16); } },
    { "hybrid", true, MakeFor<vtkHybridRadianceIntegrator> },
    { "auto", true, Plan },
  });
  return contenders;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkLightSet> MakeLights(
  vtkEnvironment* environment, const std::string& method, int count, unsigned int seed)
{
  LightSetOptions options{ count, method, seed };
  return MakeLightSet(environment, options);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> MakeLightLoop(int count)
{
  auto loop = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  loop->SetGenerator(vtkNew<vtkMedianCutLightSetGenerator>());
  loop->SetNumberOfLights(count);
  return loop;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> MakeLightLoop(
  vtkBRDF* brdf, vtkEnvironment* environment, vtkLightSet* lights, bool soft)
{
  auto integrator = MakeFor<vtkLightSetRadianceIntegrator>(brdf, environment);
  integrator->SetLightSet(lights);
  integrator->SetSoftLights(soft);
  return integrator;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> MakeTable(
  vtkBRDF* brdf, vtkEnvironment* environment, int rows, int viewAngles, int azimuths)
{
  auto integrator = MakeFor<vtkTableRadianceIntegrator>(brdf, environment);
  integrator->SetNumberOfRows(rows);
  integrator->SetNumberOfViewAngles(viewAngles);
  integrator->SetNumberOfAzimuths(azimuths);
  return integrator;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> MakeFiltered(
  vtkBRDF* brdf, vtkEnvironment* environment, int samples)
{
  auto integrator = MakeFor<vtkFilteredRadianceIntegrator>(brdf, environment);
  integrator->SetNumberOfSamples(samples);
  return integrator;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakePlastic(double exponent)
{
  auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(MakeLambert(0.3));
  sum->AddTerm(MakeLobe(exponent));
  return sum;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakeLobe(double exponent)
{
  auto lobe = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  lobe->SetExponent(exponent);
  return lobe;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakeLambert(double albedo)
{
  auto lambert = vtkSmartPointer<vtkLambertBRDF>::New();
  lambert->SetAlbedo(albedo, albedo, albedo);
  return lambert;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> Project(vtkBRDF* brdf, int basis, int order)
{
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(brdf);
  projector->SetBasis(basis);
  projector->SetOrder(order);
  if (!projector->Project())
  {
    throw Error("projection: " + TakeErrorText());
  }
  return projector->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> MakeEnvironment(
  int width, int height, const std::function<Vector(const Vector&)>& radiance)
{
  std::vector<float> pixels;
  pixels.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      Vector direction;
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, direction.data());
      for (const double value : radiance(direction))
      {
        pixels.push_back(static_cast<float>(value));
      }
    }
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  environment->SetPixels(width, height, std::move(pixels));
  return environment;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> Shrink(vtkEnvironment* environment, int width)
{
  const int height = std::max(width / 2, 1);
  if (environment->GetWidth() <= width || environment->GetHeight() <= height)
  {
    return environment;
  }
  std::vector<double> sums(3 * static_cast<std::size_t>(width * height), 0.0);
  std::vector<double> weights(static_cast<std::size_t>(width * height), 0.0);
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    const double solidAngle = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      const auto k = static_cast<std::size_t>(
        y * height / environment->GetHeight() * width +
        static_cast<int>(static_cast<long long>(x) * width / environment->GetWidth()));
      double rgb[3];
      environment->GetPixel(x, y, rgb);
      for (std::size_t c = 0; c < 3; ++c)
      {
        sums[3 * k + c] += solidAngle * rgb[c];
      }
      weights[k] += solidAngle;
    }
  }
  std::vector<float> pixels(sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    pixels[k] = static_cast<float>(sums[k] / weights[k / 3]);
  }
  auto small = vtkSmartPointer<vtkEnvironment>::New();
  small->SetPixels(width, height, std::move(pixels));
  small->SetName(environment->GetName());
  return small;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> Roll(vtkEnvironment* environment, double columns)
{
  const int width = environment->GetWidth();
  const int whole = static_cast<int>(std::floor(columns));
  const double part = columns - whole;
  std::vector<float> pixels;
  pixels.reserve(environment->GetPixels().size());
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      double near[3];
      double far[3];
      environment->GetPixel(((x - whole) % width + width) % width, y, near);
      environment->GetPixel(((x - whole - 1) % width + width) % width, y, far);
      for (int c = 0; c < 3; ++c)
      {
        pixels.push_back(static_cast<float>((1.0 - part) * near[c] + part * far[c]));
      }
    }
  }
  auto rolled = vtkSmartPointer<vtkEnvironment>::New();
  rolled->SetPixels(width, environment->GetHeight(), std::move(pixels));
  return rolled;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> Scale(vtkEnvironment* environment, double factor)
{
  std::vector<float> pixels = environment->GetPixels();
  for (float& value : pixels)
  {
    value = static_cast<float>(value * factor);
  }
  auto scaled = vtkSmartPointer<vtkEnvironment>::New();
  scaled->SetPixels(environment->GetWidth(), environment->GetHeight(), std::move(pixels));
  return scaled;
}

//------------------------------------------------------------------------------
Vector GetSmoothRadiance(const Vector& d)
{
  return { 1.0 + 0.6 * d[1] + 0.3 * d[0] * d[2], 1.0 + 0.5 * d[0], 1.0 + 0.4 * d[1] * d[2] };
}

//------------------------------------------------------------------------------
void Pairs::Add(const Vector& normal, const Vector& view)
{
  this->Normals.insert(this->Normals.end(), normal.begin(), normal.end());
  this->Views.insert(this->Views.end(), view.begin(), view.end());
}

//------------------------------------------------------------------------------
Pairs MakeSpherePairs(int count)
{
  const double azimuth = vtkMath::RadiansFromDegrees(30.0);
  const double elevation = vtkMath::RadiansFromDegrees(20.0);
  const Vector view = { std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
    std::cos(elevation) * std::cos(azimuth) };
  Vector right;
  Vector up;
  vtkMath::Perpendiculars(view.data(), right.data(), up.data(), 0.0);
  Pairs pairs;
  for (int k = 0; k < count; ++k)
  {
    // Sunflower seeds: evenly over the disc, within the rim by a pixel of 500.
    const double r = 0.996 * std::sqrt((k + 0.5) / count);
    const double phi = vtkMath::Pi() * (3.0 - std::sqrt(5.0)) * k;
    Vector normal;
    for (std::size_t c = 0; c < 3; ++c)
    {
      normal[c] =
        r * std::cos(phi) * right[c] + r * std::sin(phi) * up[c] + std::sqrt(1.0 - r * r) * view[c];
    }
    pairs.Add(normal, view);
  }
  return pairs;
}

//------------------------------------------------------------------------------
Pairs AtAngle(const Pairs& pairs, double degrees)
{
  const double angle = vtkMath::RadiansFromDegrees(degrees);
  Pairs turned;
  for (std::size_t k = 0; k < pairs.Normals.size(); k += 3)
  {
    const double* n = &pairs.Normals[k];
    const double* v = &pairs.Views[k];
    const double cosine = vtkMath::Dot(n, v);
    double across[3] = { v[0] - cosine * n[0], v[1] - cosine * n[1], v[2] - cosine * n[2] };
    vtkMath::Normalize(across);
    Vector view;
    for (std::size_t c = 0; c < 3; ++c)
    {
      view[c] = std::cos(angle) * n[c] + std::sin(angle) * across[c];
    }
    turned.Add({ n[0], n[1], n[2] }, view);
  }
  return turned;
}

//------------------------------------------------------------------------------
Vector Turn(const Vector& v, double degrees)
{
  const double c = std::cos(vtkMath::RadiansFromDegrees(degrees));
  const double s = std::sin(vtkMath::RadiansFromDegrees(degrees));
  return { c * v[0] + s * v[2], v[1], c * v[2] - s * v[0] };
}

//------------------------------------------------------------------------------
std::vector<double> Integrate(vtkRadianceIntegrator* integrator, const Pairs& pairs)
{
  return IntegratePairs(integrator, pairs.Normals, pairs.Views);
}

//------------------------------------------------------------------------------
std::vector<double> IntegrateReference(
  vtkBRDF* brdf, vtkEnvironment* environment, const Pairs& pairs)
{
  const auto reference = MakeFor<vtkAdaptiveRadianceIntegrator>(brdf, environment);
  reference->SetTolerance(2e-4); // slopes of errors need it
  return Integrate(reference, pairs);
}

//------------------------------------------------------------------------------
std::string Say(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}
} // namespace tool::stability
