// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Suns as lights, the rest by a table, with maps of its sharp part: each part alone, and the sum
// against the reference; and for which materials lamps count near the lobe only.

#include "AnisotropicWarp.h"
#include "ErrorCatcher.h"
#include "ExtractedEmitters.h"
#include "HalfVector.h" // for Pi
#include "LobeSampler.h"
#include "MaterialPrecomputation.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkSmartPointer.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTabulatedBRDF.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace measuredbrdf;

namespace
{
vtkSmartPointer<vtkBRDF> NewEmbedded(const char* name)
{
  auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
  brdf->Prepare();
  return brdf;
}

glm::dvec3 NewDirection(std::mt19937& engine)
{
  const double z = engine() * 0x1p-32;
  const double phi = 2.0 * Pi * (engine() * 0x1p-32);
  const double s = std::sqrt(1.0 - z * z);
  return glm::dvec3(s * std::cos(phi), s * std::sin(phi), z);
}

vtkNew<vtkHybridRadianceIntegrator> NewHybrid(
  vtkBRDF* brdf, vtkEnvironment* environment, const std::vector<int>& sizes = { 128, 12, 16, 8 })
{
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  EXPECT_TRUE(hybrid->SetSizes(sizes));
  hybrid->SetBRDF(brdf);
  hybrid->SetEnvironment(environment);
  return hybrid;
}

// Lamps of one texel over a smooth floor.
vtkNew<vtkEnvironment> NewSunny(float peak, int suns)
{
  auto environment = NewSmallEnvironment(false);
  std::vector<float> rgb = environment->GetPixels();
  for (int k = 0; k < suns; ++k)
  {
    const std::size_t texel = static_cast<std::size_t>(128 * (12 + 3 * k) + 17 * k + 5);
    rgb[3 * texel] = peak;
    rgb[3 * texel + 1] = 0.9f * peak;
    rgb[3 * texel + 2] = 0.7f * peak;
  }
  EXPECT_TRUE(environment->SetPixels(128, 64, rgb));
  return environment;
}

// With some texels changed.
std::vector<float> GetPixels(vtkEnvironment* environment, const TexelChanges& changes)
{
  std::vector<float> pixels;
  std::vector<float> room;
  const int width = environment->GetWidth();
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    for (const int x : { 0, width / 3 }) // rows may come in parts
    {
      const int end = x == 0 ? width / 3 : width;
      const float* row = changes.GetRow(environment, y, x, end, room);
      pixels.insert(pixels.end(), row, row + 3 * (end - x));
    }
  }
  return pixels;
}
} // namespace

//------------------------------------------------------------------------------
TEST(ExtractedEmitters, LightsAndRestAddUp)
{
  const auto environment = NewSunny(1e5f, 3);
  const ExtractedEmitters bright(environment, ExtractedEmitters::DefaultShare, 16);
  EXPECT_EQ(bright.Lights.size(), 3u);
  EXPECT_EQ(ExtractedEmitters(environment, ExtractedEmitters::DefaultShare, 2).Lights.size(), 2u);
  EXPECT_TRUE(ExtractedEmitters(environment, ExtractedEmitters::DefaultShare, 0).Lights.empty());
  EXPECT_TRUE(ExtractedEmitters(environment, 1.0, 16).Lights.empty());
  EXPECT_TRUE(
    ExtractedEmitters(NewConstantEnvironment(16, 8, 3.0f), ExtractedEmitters::DefaultShare, 16)
      .Lights.empty());

  // No light is lost or gained, channel by channel.
  glm::dvec3 whole(0.0);
  glm::dvec3 parts(0.0);
  float largest = 0.0f;
  const std::vector<float> rest = GetPixels(environment, bright.Rest);
  for (std::size_t k = 0; k < rest.size(); ++k)
  {
    const double solidAngle = environment->GetTexelSolidAngle(static_cast<int>(k / 3 / 128));
    const int c = static_cast<int>(k % 3);
    whole[c] += environment->GetPixels()[k] * solidAngle;
    parts[c] += rest[k] * solidAngle;
    largest = std::max(largest, rest[k]);
    EXPECT_GE(rest[k], 0.0f);
    const std::size_t texel = k / 3;
    EXPECT_EQ(bright.Rest.Interpolate(
                environment, (texel % 128 + 0.5) / 128.0, (texel / 128 + 0.5) / 64.0)[c],
      rest[k]);
  }
  for (const ExtractedEmitters::Light& light : bright.Lights)
  {
    parts += light.Irradiance;
    EXPECT_NEAR(glm::length(light.Direction), 1.0, 1e-12);
  }
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(parts[c], whole[c], 1e-6 * whole[c]);
  }
  EXPECT_LT(largest, 1e3f);
}

//------------------------------------------------------------------------------
// A sun of several texels is one light, in the middle of them; a panel is no lamp.
TEST(ExtractedEmitters, LampsAreOneLightEach)
{
  constexpr int width = 512, height = 256;
  std::vector<float> pixels(3 * width * height, 1.0f);
  const auto light = [&](int x, int y) { pixels[3 * (y * width + x) + 1] = 1e4f; };
  for (int k = 0; k < 4; ++k) // 2 x 2 texels of 0.7 degrees
  {
    light(100 + k % 2, 120 + k / 2);
    light(300 + k % 2, 60 + k / 2);
  }
  vtkNew<vtkEnvironment> environment;
  environment->SetPixels(width, height, pixels);
  EXPECT_EQ(ExtractedEmitters(environment, ExtractedEmitters::DefaultShare, 16).Lights.size(), 8u);
  const double angle = 1.2 * Pi / 180.0;
  const ExtractedEmitters lamps = ExtractedEmitters::FindLamps(environment, angle, 16);
  ASSERT_EQ(lamps.Lights.size(), 2u);
  const std::vector<float> rest = GetPixels(environment, lamps.Rest);
  glm::dvec3 irradiance(0.0);
  glm::dvec3 expected(0.0);
  for (std::size_t k = 0; k < pixels.size() / 3; ++k)
  {
    expected.y += (pixels[3 * k + 1] - rest[3 * k + 1]) *
                  environment->GetTexelSolidAngle(static_cast<int>(k / width));
  }
  for (const ExtractedEmitters::Light& lamp : lamps.Lights)
  {
    glm::dvec3 middle(0.0);
    const bool first = std::abs(lamp.Direction.y) < 0.2; // near the horizon
    for (int k = 0; k < 4; ++k)
    {
      glm::dvec3 direction;
      environment->GetTexelDirection(
        (first ? 100 : 300) + k % 2, (first ? 120 : 60) + k / 2, &direction.x);
      middle += 0.25 * direction;
    }
    EXPECT_LT(glm::distance(lamp.Direction, glm::normalize(middle)), 1e-3);
    // Per axis: half a texel to both sides of the middle, and a triangle about each center.
    const double row = Pi / height;
    const double column = row * std::hypot(lamp.Direction.x, lamp.Direction.z);
    const double expectedSpread = 0.5 * (0.25 + 1.0 / 6.0) * (row * row + column * column);
    EXPECT_NEAR(lamp.Spread, expectedSpread, 0.01 * expectedSpread);
    ASSERT_EQ(lamp.Parts.size(), 4u);
    glm::dvec3 partsIrradiance(0.0);
    for (const ExtractedEmitters::Part& part : lamp.Parts)
    {
      partsIrradiance += part.Irradiance;
      EXPECT_NEAR(part.Spread, 0.5 / 6.0 * (row * row + column * column), 0.02 * lamp.Spread);
    }
    EXPECT_NEAR(partsIrradiance.y, lamp.Irradiance.y, 1e-9 * lamp.Irradiance.y);
    irradiance += lamp.Irradiance;
  }
  EXPECT_NEAR(irradiance.y, expected.y, 1e-6 * expected.y);
  EXPECT_GT(irradiance.y, 0.0);

  // A row of three, 1.4 degrees long, the brightest at its end: one. Five: more.
  std::vector<float> rows(3 * width * height, 1.0f);
  rows[3 * (128 * width + 200) + 1] = 2e4f;
  rows[3 * (128 * width + 201) + 1] = rows[3 * (128 * width + 202) + 1] = 1e4f;
  environment->SetPixels(width, height, rows);
  EXPECT_EQ(ExtractedEmitters::FindLamps(environment, angle, 16).Lights.size(), 1u);
  rows[3 * (128 * width + 203) + 1] = rows[3 * (128 * width + 204) + 1] = 1e4f;
  environment->SetPixels(width, height, rows);
  EXPECT_EQ(ExtractedEmitters::FindLamps(environment, angle, 16).Lights.size(), 2u);

  // Glare two texels off is the lamp's; as much light as a lamp's is another lamp.
  rows.assign(3 * width * height, 1.0f);
  rows[3 * (128 * width + 200) + 1] = 1e6f;
  rows[3 * (128 * width + 202) + 1] = 5e3f;
  environment->SetPixels(width, height, rows);
  EXPECT_EQ(ExtractedEmitters::FindLamps(environment, angle, 16).Lights.size(), 1u);
  rows[3 * (128 * width + 202) + 1] = 5e4f;
  environment->SetPixels(width, height, rows);
  EXPECT_EQ(ExtractedEmitters::FindLamps(environment, angle, 16).Lights.size(), 2u);

  for (int k = 0; k < 40 * 40; ++k) // a panel of 28 degrees
  {
    light(100 + k % 40, 100 + k / 40);
  }
  environment->SetPixels(width, height, pixels);
  EXPECT_TRUE(ExtractedEmitters::FindLamps(environment, angle, 16).Lights.empty());
}

//------------------------------------------------------------------------------
TEST(LobeViews, AxesMoveSlowly)
{
  for (const char* name : { "blue-fabric", "nickel", "pink-felt" })
  {
    const LobeViews views(NewEmbedded(name));
    EXPECT_NEAR(views.GetAxis(0.0), 0.0, 1e-9) << name;
    double fastest = 0.0;
    for (double theta = 0.01; theta <= LobeViews::GetLastAngle(); theta += 0.01)
    {
      fastest =
        std::max(fastest, std::abs(views.GetAxis(theta) - views.GetAxis(theta - 0.01)) / 0.01);
    }
    EXPECT_LT(fastest, 1.52) << name; // between views, which crowd, it is not quite straight
  }
  // A mirror's moves with the view.
  EXPECT_NEAR(LobeViews(NewEmbedded("brass")).GetAxis(0.7), 0.7, 0.01);
}

//------------------------------------------------------------------------------
TEST(LobeViews, TellsSharpFromBroad)
{
  constexpr double solidAngle = 0.3;
  EXPECT_GT(LobeViews(NewEmbedded("nickel")).GetSharpShare(solidAngle), 0.5);
  vtkNew<vtkLambertBRDF> matte;
  EXPECT_LT(LobeViews(matte).GetSharpShare(solidAngle), 1e-9);
  // More of any lobe is narrower than a wider angle.
  const LobeViews rubber(NewEmbedded("violet-rubber"));
  EXPECT_LT(rubber.GetSharpShare(solidAngle), rubber.GetSharpShare(2.0 * solidAngle));
}

//------------------------------------------------------------------------------
// E[f cos / density] is the directional albedo, and hardly varies.
TEST(LobeSampler, DrawsByTheKernel)
{
  for (const char* name : { "nickel", "violet-rubber", "pink-felt", "brass" })
  {
    const auto brdf = NewEmbedded(name);
    for (const double degrees : { 0.0, 40.0, 75.0 })
    {
      const glm::dvec3 o(std::sin(degrees * Pi / 180.0), 0.0, std::cos(degrees * Pi / 180.0));
      const LobeSampler lobe(brdf, o);
      ASSERT_FALSE(lobe.IsBlack());
      constexpr int count = 4096;
      double mean = 0.0;
      double squares = 0.0;
      for (int k = 0; k < count; ++k)
      {
        double density = 0.0;
        const glm::dvec3 i = lobe.Sample(
          glm::dvec2((k + 0.5) / count, std::fmod(k * 0.6180339887498949, 1.0)), density);
        EXPECT_NEAR(glm::length(i), 1.0, 1e-9);
        glm::dvec3 f(0.0);
        if (i.z > 0.0)
        {
          brdf->Evaluate(&i.x, &o.x, &f.x);
        }
        const double weight = (f.x + f.y + f.z) * std::max(i.z, 0.0) / density;
        mean += weight / count;
        squares += weight * weight / count;
      }
      glm::dvec3 albedo;
      brdf->GetDirectionalAlbedo(&o.x, &albedo.x);
      const double expected = albedo.x + albedo.y + albedo.z;
      std::printf("%s at %g degrees: albedo %.4f, drawn %.4f, variance of a weight %.3f\n", name,
        degrees, expected, mean, squares / (mean * mean) - 1.0);
      EXPECT_NEAR(mean, expected, 0.02 * expected);
      EXPECT_LT(squares / (mean * mean) - 1.0, 0.1);
    }
  }
  vtkNew<vtkLambertBRDF> black;
  black->SetAlbedo(0.0, 0.0, 0.0);
  EXPECT_TRUE(LobeSampler(black, glm::dvec3(0.0, 0.0, 1.0)).IsBlack());
}

//------------------------------------------------------------------------------
// What each part gains, against the exact sum.
TEST(HybridIntegrator, EveryPartPays)
{
  SpherePairs pairs;
  pairs.AddRandom(60);
  const auto environment = NewSunny(2e5f, 2);
  for (const double exponent : { 200.0, 3000.0 })
  {
    const auto brdf = NewCoating(exponent);
    const auto reference = pairs.IntegrateExactly(brdf, environment);
    vtkNew<vtkTableRadianceIntegrator> table;
    table->SetBRDF(brdf);
    table->SetEnvironment(environment);
    table->SetNumberOfRows(33);
    const double whole = GetRelativeError(pairs.Integrate(table), reference);
    const auto hybrid = NewHybrid(brdf, environment, { 33, 12, 16, 0 });
    const double lit = GetRelativeError(pairs.Integrate(hybrid), reference);
    EXPECT_EQ(hybrid->GetNumberOfLights(), 2);
    ASSERT_TRUE(hybrid->SetSizes({ 128, 12, 16, 8 }));
    const double both = GetRelativeError(pairs.Integrate(hybrid), reference);
    std::printf(
      "exponent %g: table %.4f, with lights %.4f, and maps %.4f\n", exponent, whole, lit, both);
    EXPECT_LT(lit, 0.2 * whole);
    EXPECT_LT(both, 0.01);
  }
}

//------------------------------------------------------------------------------
TEST(HybridIntegrator, ShaderInputs)
{
  const auto hybrid = NewHybrid(NewCoating(200.0), NewSunny(1e6f, 2));
  vtkBRDFShaderInputs inputs;
  ASSERT_TRUE(hybrid->GetShaderInputs(inputs));
  ASSERT_EQ(inputs.Terms.size(), 2u);
  EXPECT_EQ(inputs.Terms[0].Shader, "vtkBRDFEnvironmentCore");
  EXPECT_EQ(inputs.Terms[1].Shader, "vtkBRDFLightSet");
  EXPECT_TRUE(hybrid->UsesBRDFOnGPU());
  EXPECT_NE(inputs.Description.find("2 directional lights"), std::string::npos)
    << inputs.Description;
}

//------------------------------------------------------------------------------
// Brushed metal under lamps: as lights, beside a small table, they cost a fraction of the error
// that they are in the table.
TEST(Hybrid, AnisotropicMaterialsUnderLamps)
{
  const auto sunny = NewSunny(3000.0f, 2);
  const auto brushed = NewBrushedMetal(0.15, 0.4);
  const auto hybrid = NewHybrid(brushed, sunny, { 25, 8, 20, 0, 16 });
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetSizes({ 25, 8, 20, 8 });
  table->SetBRDF(brushed);
  table->SetEnvironment(sunny);
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(brushed);
  reference->SetEnvironment(sunny);
  SpherePairs pairs;
  pairs.AddRandom(150);
  const std::vector<glm::dvec3> exact = pairs.Integrate(reference);
  const auto compare = [&](vtkRadianceIntegrator* integrator)
  {
    const std::vector<glm::dvec3> values = pairs.Integrate(integrator);
    double difference = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < exact.size(); ++k)
    {
      difference += glm::dot(glm::abs(values[k] - exact[k]), glm::dvec3(1.0));
      sum += glm::dot(exact[k], glm::dvec3(1.0));
    }
    return difference / sum;
  };
  const double withLights = compare(hybrid);
  const double without = compare(table);
  std::printf(
    "hybrid %.3g, table %.3g, %d lights\n", withLights, without, hybrid->GetNumberOfLights());
  EXPECT_GT(hybrid->GetNumberOfLights(), 1);
  EXPECT_LT(withLights, 0.02);
  EXPECT_LT(withLights, 0.3 * without);

  ErrorCatcher errors(hybrid);
  hybrid->SetNumberOfMaps(4);
  EXPECT_FALSE(hybrid->Prepare()); // maps are for isotropic materials
  EXPECT_EQ(errors.Take(), 1);
}

//------------------------------------------------------------------------------
namespace
{
// A lobe of a cosine power of 20 over a diffuse base, cell by cell, then changed.
vtkSmartPointer<vtkTabulatedBRDF> NewTable(
  int range, const std::function<double(std::size_t, double)>& change)
{
  const std::array<int, 3> dimensions{ 12, 24, 32 };
  std::vector<float> rgb;
  for (int cell = 0; cell < 12 * 24 * 32; ++cell)
  {
    double i[3], o[3];
    double value = 0.1;
    if (vtkTabulatedBRDF::GetCellDirections(vtkTabulatedBRDF::HALF_DIFFERENCE, range,
          dimensions.data(), cell % 12, cell / 12 % 24, cell / (12 * 24), i, o))
    {
      const double h = std::hypot(i[0] + o[0], i[1] + o[1], i[2] + o[2]);
      value += std::pow((i[2] + o[2]) / h, 20.0);
    }
    rgb.insert(rgb.end(), 3, static_cast<float>(change(static_cast<std::size_t>(cell), value)));
  }
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, range, dimensions.data(), std::move(rgb));
  return table;
}
}

TEST(TailRegularity, OfMaterials)
{
  const auto areWindowed = [](vtkBRDF* brdf, int lights = 8)
  { return vtkHybridRadianceIntegrator::AreWindowed(brdf, lights); };
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const auto brdf =
      vtk::TakeSmartPointer(vtkEmbeddedMaterials::NewBRDF(vtkEmbeddedMaterials::GetName(k)));
    EXPECT_EQ(areWindowed(brdf), brdf->IsIsotropic()) << brdf->GetName();
    EXPECT_FALSE(areWindowed(brdf, 1)) << brdf->GetName();
  }
  EXPECT_FALSE(areWindowed(nullptr));
}

TEST(TailRegularity, OfOddTables)
{
  const auto isWindowed = [](vtkBRDF* brdf)
  { return vtkHybridRadianceIntegrator::AreWindowed(brdf, 8); };
  const auto same = [](std::size_t, double value) { return value; };
  const auto oneSide = [](std::size_t cell, double value)
  { return value * (cell % 12 < 6 ? 1.6 : 0.4); };
  const auto noise = [](std::size_t cell, double value)
  { return value - (cell * 2654435761u % 1000 < 200 ? 0.3 : 0.0); };
  EXPECT_TRUE(isWindowed(NewTable(vtkTabulatedBRDF::HALF_TURN, same)));
  EXPECT_FALSE(isWindowed(NewTable(vtkTabulatedBRDF::FULL_TURN, oneSide)));
  EXPECT_FALSE(isWindowed(NewTable(vtkTabulatedBRDF::HALF_TURN, noise)));
}
