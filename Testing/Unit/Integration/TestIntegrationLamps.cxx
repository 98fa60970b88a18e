// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Lamps that pixels add where they are near the lobe's axis, and that a table holds elsewhere.

#include "HalfVector.h" // for Pi
#include "Lamps.h"
#include "LobeViews.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAngularTableBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"

#include <cstdio>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr int Width = 256;
constexpr int Height = 128;

// Lamps of one texel in the dark.
struct Lamps
{
  vtkNew<vtkEnvironment> Environment;
  vtkNew<vtkLightSet> Set;

  explicit Lamps(int count, int texels = 1) // in a row
  {
    std::vector<float> rgb(3 * Width * Height, 1e-5f);
    this->Environment->SetPixels(Width, Height, rgb);
    for (int k = 0; k < count; ++k)
    {
      const int x = (37 * k + 11) % Width;
      const int y = 30 + 7 * k % 60;
      const std::size_t texel = static_cast<std::size_t>(Width * y + x);
      double direction[3];
      this->Environment->GetTexelDirection(x, y, direction);
      const double solidAngle = this->Environment->GetTexelSolidAngle(y);
      double irradiance[3];
      for (int c = 0; c < 3; ++c)
      {
        rgb[3 * texel + static_cast<std::size_t>(c)] = 1e4f / static_cast<float>(c + 1);
        irradiance[c] = 1e4 / (c + 1) * solidAngle;
      }
      this->Set->AddLight(direction, irradiance);
      for (int next = 1; next < texels; ++next)
      {
        std::copy_n(&rgb[3 * texel], 3, &rgb[3 * (texel + static_cast<std::size_t>(next))]);
      }
    }
    EXPECT_TRUE(this->Environment->SetPixels(Width, Height, rgb));
  }

  glm::dvec3 GetDirection(int index)
  {
    glm::dvec3 direction;
    this->Set->GetDirection(index, &direction.x);
    return direction;
  }
};

vtkNew<vtkHybridRadianceIntegrator> NewHybrid(vtkBRDF* brdf, vtkEnvironment* environment, int rows)
{
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  EXPECT_TRUE(hybrid->SetSizes({ rows, 12, 16, 0, 64 }));
  hybrid->SetBRDF(brdf);
  hybrid->SetEnvironment(environment);
  return hybrid;
}

vtkNew<vtkLightSetRadianceIntegrator> NewSum(vtkBRDF* brdf, vtkLightSet* lights)
{
  vtkNew<vtkLightSetRadianceIntegrator> sum;
  sum->SetBRDF(brdf);
  sum->SetLightSet(lights);
  return sum;
}

// Whose mirror directions are within 2.5 degrees of a lamp.
SpherePairs DrawAbout(Lamps& lamps, int count)
{
  SpherePairs pairs;
  for (std::uint32_t k = 1; k <= 200; ++k)
  {
    const Frame frame = FrameAbout(lamps.GetDirection(static_cast<int>(k) % count));
    const double away = 2.5 * Pi / 180.0 * RadicalInverse(k, 3);
    const glm::dvec3 axis = frame * ToDirection(std::cos(away), 2.0 * Pi * RadicalInverse(k, 5));
    const glm::dvec3 view =
      frame * ToDirection(2.0 * RadicalInverse(k, 2) - 0.98, 2.0 * Pi * RadicalInverse(k, 7));
    pairs.Add(glm::normalize(axis + view), view);
  }
  return pairs;
}
} // namespace

//------------------------------------------------------------------------------
TEST(LampWindow, EndsWithoutAnEdge)
{
  const LampWindow window;
  const double radius = LampWindow::Radius;
  const auto weight = [&](double angle) {
    return window.GetWeight({ std::sin(angle), 0.0, std::cos(angle) }, { 0.0, 0.0, 1.0 });
  };
  EXPECT_EQ(weight(0.0), 1.0);
  EXPECT_GT(weight(0.3 * radius), 0.95);
  EXPECT_LT(weight(0.9 * radius), 0.2);
  EXPECT_EQ(weight(radius * 1.0001), 0.0);
  EXPECT_LT(weight(0.999 * radius), 2e-5); // of second order in the distance to the edge
  EXPECT_NEAR(window.GetShare(), 0.5 - 0.5 * std::cos(radius), 1e-12);
}

//------------------------------------------------------------------------------
// Table and window together are the lamps, whatever the lobe's width; and the table alone, of as
// many rows, is far from it.
TEST(HybridLamps, AddUpToTheLamps)
{
  SpherePairs pairs;
  pairs.AddRandom(300);
  Lamps lamps(5);
  for (const double exponent : { 20.0, 300.0 })
  {
    const auto brdf = NewCoating(exponent);
    const auto exact = pairs.Integrate(NewSum(brdf, lamps.Set));
    const auto hybrid = NewHybrid(brdf, lamps.Environment, 65);
    const double error = GetRelativeError(pairs.Integrate(hybrid), exact);
    ASSERT_TRUE(hybrid->SetSizes({ 65, 12, 16, 0, 0 })); // no lights
    const double table = GetRelativeError(pairs.Integrate(hybrid), exact);
    std::printf("exponent %g: %.4f, table alone %.4f\n", exponent, error, table);
    EXPECT_LT(error, 0.012);
    EXPECT_LT(error, table);
  }
}

//------------------------------------------------------------------------------
// Against a sum over directions that are drawn from the lamp, across the lobe and along it.
TEST(LampBRDF, IsTheMeanOverALamp)
{
  const auto brdf = NewCoating(5000.0);
  const double deviation = 0.5 * Pi / 180.0;
  const auto areas = LampBRDF::Make(brdf, deviation * deviation);
  double difference = 0.0, point = 0.0, sum = 0.0;
  std::uint32_t number = 0;
  for (const double cosine : { 0.95, 0.6, 0.2 })
  {
    const glm::dvec3 view = ToDirection(cosine, 0.7);
    const Frame frame = FrameAbout(glm::dvec3(-view.x, -view.y, view.z));
    for (const double away : { 0.0, 0.3, 0.8, 1.5, 4.0 }) // degrees
    {
      for (const double turn : { 0.4, 1.7, 3.3 })
      {
        const glm::dvec3 light = frame * ToDirection(std::cos(away * Pi / 180.0), turn);
        const Frame about = FrameAbout(light);
        constexpr int draws = 4000;
        glm::dvec3 mean(0.0);
        for (int k = 0; k < draws; ++k)
        {
          ++number;
          const double radius = std::sqrt(-2.0 * std::log(1.0 - RadicalInverse(number, 2)));
          const double phi = 2.0 * Pi * RadicalInverse(number, 3);
          const glm::dvec3 at = glm::normalize(
            light + about * (deviation * radius * glm::dvec3(std::cos(phi), std::sin(phi), 0.0)));
          glm::dvec3 f;
          brdf->Evaluate(&at.x, &view.x, &f.x);
          mean += f / static_cast<double>(draws);
        }
        glm::dvec3 found, f;
        areas->Evaluate(&light.x, &view.x, &found.x);
        brdf->Evaluate(&light.x, &view.x, &f.x);
        difference += std::abs(found.x - mean.x) * cosine; // as the table holds it
        point += std::abs(f.x - mean.x) * cosine;
        sum += mean.x * cosine;
      }
    }
  }
  std::printf("%.4f, of a point %.4f\n", difference / sum, point / sum);
  EXPECT_LT(difference / sum, 0.02);
  EXPECT_GT(point / sum, 0.2);
}

//------------------------------------------------------------------------------
TEST(LampBRDF, IsForLobesAsNarrowAsLamps)
{
  const double spread = 1e-4; // a deviation of 0.57 degrees
  const auto isNeeded = [spread](double exponent)
  {
    const auto brdf = NewCoating(exponent);
    return LampBRDF::IsWidthSeen(LobeViews(brdf), spread);
  };
  EXPECT_FALSE(isNeeded(100.0));
  EXPECT_TRUE(isNeeded(20000.0));
  EXPECT_FALSE(LampBRDF::IsWidthSeen(LobeViews(NewCoating(20000.0)), 0.0));
}

//------------------------------------------------------------------------------
// Lamps of one texel, as wide as the lobe, near the mirror direction: beside the table and in it.
TEST(HybridLamps, AreAreasForNarrowLobes)
{
  const auto brdf = NewCoating(5000.0);
  for (const int count : { 1, 5 })
  {
    Lamps lamps(count);
    const SpherePairs pairs = DrawAbout(lamps, count);
    vtkNew<vtkAdaptiveRadianceIntegrator> reference;
    reference->SetBRDF(brdf);
    reference->SetEnvironment(lamps.Environment);
    const auto exact = pairs.Integrate(reference);
    const double points = GetRelativeError(pairs.Integrate(NewSum(brdf, lamps.Set)), exact);
    const auto hybrid = NewHybrid(brdf, lamps.Environment, 65);
    const vtkIdType bytes = hybrid->EstimateTextureBytes();
    const double areas = GetRelativeError(pairs.Integrate(hybrid), exact);
    std::printf("%d lamps as areas: %.4f, as points: %.4f\n", count, areas, points);
    EXPECT_LT(areas, 0.08); // a triangle is no normal distribution
    EXPECT_GT(points, 4.0 * areas);
    EXPECT_FALSE(hybrid->UsesBRDFOnGPU());
    EXPECT_EQ(hybrid->EstimateTextureBytes(), bytes);
    vtkBRDFShaderInputs inputs;
    ASSERT_TRUE(hybrid->GetShaderInputs(inputs));
    EXPECT_NEAR(static_cast<double>(inputs.GetTextureBytes()), static_cast<double>(bytes),
      0.02 * static_cast<double>(bytes));
  }
}

//------------------------------------------------------------------------------
// Along a path that takes a lamp out of the window, radiance is as smooth as the exact sum's.
TEST(HybridLamps, NothingShowsWhereTheWindowEnds)
{
  Lamps lamps(1);
  const glm::dvec3 lamp = lamps.GetDirection(0);
  const glm::dvec3 aside = glm::normalize(glm::cross(lamp, glm::dvec3(0.0, 1.0, 0.0)));
  SpherePairs pairs;
  constexpr int steps = 300; // of a tenth of a degree in the mirror direction
  for (int k = 0; k < steps; ++k)
  {
    const double turn = 0.05 * k * Pi / 180.0;
    const glm::dvec3 view = glm::normalize(lamp + 0.7 * glm::cross(lamp, aside));
    const glm::dvec3 half = glm::normalize(lamp + view);
    pairs.Add(std::cos(turn) * half + std::sin(turn) * aside, view);
  }
  const auto brdf = NewCoating(60.0); // whose lobe is wider than the window
  const auto exact = pairs.Integrate(NewSum(brdf, lamps.Set));
  const auto drawn = pairs.Integrate(NewHybrid(brdf, lamps.Environment, 65));
  double jump = 0.0; // beyond the exact sum's, between neighbors
  double peak = 0.0;
  for (std::size_t k = 0; k + 1 < steps; ++k)
  {
    jump = std::max(jump, std::abs((drawn[k + 1].x - drawn[k].x) - (exact[k + 1].x - exact[k].x)));
    peak = std::max(peak, exact[k].x);
  }
  std::printf("largest jump %.2e of the peak\n", jump / peak);
  EXPECT_LT(jump, 0.01 * peak); // texels of 9 bits
  EXPECT_LT(GetRelativeError(drawn, exact), 0.01);
}

//------------------------------------------------------------------------------
// They are found in the shader's text by unrolled comparisons, or, if there are many, in a loop.
TEST(HybridLamps, ShaderInputs)
{
  for (const int count : { 3, 40 })
  {
    Lamps lamps(count);
    const auto hybrid = NewHybrid(NewCoating(100.0), lamps.Environment, 17);
    vtkBRDFShaderInputs inputs;
    ASSERT_TRUE(hybrid->GetShaderInputs(inputs));
    EXPECT_EQ(hybrid->GetNumberOfLights(), count);
    EXPECT_TRUE(hybrid->UsesBRDFOnGPU());
    ASSERT_EQ(inputs.Terms.size(), 1u);
    std::size_t directions = 0;
    for (const vtkBRDFShaderInputs::Uniform& uniform : inputs.Terms[0].Uniforms)
    {
      directions += uniform.Name.find("brdfDirection") == 0 ? 1 : 0;
    }
    EXPECT_EQ(directions, count > 32 ? 0u : static_cast<std::size_t>(count));
    EXPECT_NE(
      inputs.Description.find(std::to_string(count) + " directional lights"), std::string::npos)
      << inputs.Description;
  }
}

//------------------------------------------------------------------------------
// Lamps of four texels: of more than two lamps, each is the sum of them; else it is one normal
// distribution, which lacks their shape.
TEST(HybridLamps, HaveParts)
{
  const auto brdf = NewCoating(5000.0);
  const auto getError = [&brdf](int count)
  {
    Lamps lamps(count, 4);
    const SpherePairs pairs = DrawAbout(lamps, count);
    vtkNew<vtkAdaptiveRadianceIntegrator> reference;
    reference->SetBRDF(brdf);
    reference->SetEnvironment(lamps.Environment);
    const auto hybrid = NewHybrid(brdf, lamps.Environment, 65);
    EXPECT_TRUE(hybrid->SetSizes({ 65, 12, 16, 0, 64, 40 })); // of 4 degrees: each is one lamp
    const double error = GetRelativeError(pairs.Integrate(hybrid), pairs.Integrate(reference));
    EXPECT_EQ(hybrid->GetNumberOfLights(), count);
    return error;
  };
  const double whole = getError(2);
  const double parts = getError(3);
  std::printf("lamps of four texels, whole %.4f, in parts %.4f\n", whole, parts);
  EXPECT_LT(parts, 0.3 * whole);
}

//------------------------------------------------------------------------------
// Whatever their lobe: else lights would need a resampled form. Others show lamps themselves.
TEST(HybridLamps, MaterialsWithoutGLSLTakeTheTableOfMeans)
{
  const auto wide = NewCoating(20.0);
  vtkNew<vtkAngularTableBRDF> measured;
  const std::vector<float> polar = { 0.0f, 30.0f, 60.0f, 90.0f };
  const vtkAngularTableBRDF::Nodes light = { polar, { 0.0f } };
  const vtkAngularTableBRDF::Nodes view = { polar, vtkAngularTableBRDF::GetEvenAzimuths(8) };
  ASSERT_EQ(measured->SetValues(
              light, view, std::vector<float>(3 * 4 * 4 * 8, 0.2f), vtkAngularTableBRDF::LIGHT),
    "");
  EXPECT_FALSE(measured->IsRenderable());
  SpherePairs pairs;
  pairs.AddRandom(100);
  for (const int count : { 1, 5 })
  {
    Lamps lamps(count);
    const auto hybrid = NewHybrid(measured, lamps.Environment, 17);
    const auto exact = pairs.Integrate(NewSum(measured, lamps.Set));
    EXPECT_LT(GetRelativeError(pairs.Integrate(hybrid), exact), 0.02);
    EXPECT_FALSE(hybrid->UsesBRDFOnGPU());
    const auto other = NewHybrid(wide, lamps.Environment, 17);
    pairs.Integrate(other);
    EXPECT_TRUE(other->UsesBRDFOnGPU());
  }
}
