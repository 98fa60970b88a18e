// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Lamps that pixels add where they are near the lobe's axis, and that a table holds elsewhere.

#include "HalfVector.h" // for Pi
#include "LampWindow.h"
#include "SpherePairs.h"
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

  explicit Lamps(int count)
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

vtkNew<vtkAshikhminShirleyBRDF> NewGloss(double exponent)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetDiffuse(0.3, 0.2, 0.1);
  brdf->SetExponents(exponent, exponent);
  return brdf;
}

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
  for (const double exponent : { 20.0, 300.0, 5000.0 })
  {
    const auto brdf = NewGloss(exponent);
    const auto exact = pairs.Integrate(NewSum(brdf, lamps.Set));
    const auto hybrid = NewHybrid(brdf, lamps.Environment, 65);
    const double error = GetRelativeError(pairs.Integrate(hybrid), exact);
    ASSERT_TRUE(hybrid->SetSizes({ 65, 12, 16, 0, 0 })); // no lights
    const double table = GetRelativeError(pairs.Integrate(hybrid), exact);
    std::printf("exponent %g: %.4f, table alone %.4f\n", exponent, error, table);
    EXPECT_LT(error, 0.012);
    EXPECT_LT(error, exponent > 1000.0 ? 0.1 * table : table);
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
  const auto brdf = NewGloss(60.0); // whose lobe is wider than the window
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
    const auto hybrid = NewHybrid(NewGloss(100.0), lamps.Environment, 17);
    vtkBRDFShaderInputs form;
    ASSERT_TRUE(hybrid->GetShaderInputs(form));
    EXPECT_EQ(hybrid->GetNumberOfLights(), count);
    EXPECT_TRUE(hybrid->UsesBRDFOnGPU());
    ASSERT_EQ(form.Terms.size(), 1u);
    std::size_t directions = 0;
    for (const vtkBRDFShaderInputs::Uniform& uniform : form.Terms[0].Uniforms)
    {
      directions += uniform.Name.find("brdfDirection") == 0 ? 1 : 0;
    }
    EXPECT_EQ(directions, count > 32 ? 0u : static_cast<std::size_t>(count));
    EXPECT_NE(
      form.Description.find(std::to_string(count) + " directional lights"), std::string::npos)
      << form.Description;
  }
}
