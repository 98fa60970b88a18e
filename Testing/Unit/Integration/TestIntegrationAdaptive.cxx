// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The adaptive sum against the sum over every texel.

#include "ErrorCatcher.h"
#include "SpherePairs.h"
#include "TexelTree.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkEnvironmentReader.h"
#include "vtkLambertBRDF.h"

#include <cstdio>
#include <fstream>
#include <string>

using namespace measuredbrdf;

namespace
{
const std::string Data = MEASUREDBRDF_SHARED_DATA;

vtkNew<vtkAdaptiveRadianceIntegrator> NewAdaptive(vtkBRDF* brdf, vtkEnvironment* environment)
{
  vtkNew<vtkAdaptiveRadianceIntegrator> adaptive;
  adaptive->SetBRDF(brdf);
  adaptive->SetEnvironment(environment);
  return adaptive;
}

// Relative to the exact sum, over the channels: the largest of all pairs.
double GetLargestError(
  const std::vector<glm::dvec3>& radiance, const std::vector<glm::dvec3>& exact)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k)
  {
    const glm::dvec3 d = glm::abs(radiance[k] - exact[k]);
    largest = std::max(largest, (d.x + d.y + d.z) / (exact[k].x + exact[k].y + exact[k].z));
  }
  return largest;
}

vtkNew<vtkAshikhminShirleyBRDF> NewGloss(double nu, double nv)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetDiffuse(0.02, 0.01, 0.03);
  brdf->SetExponents(nu, nv);
  return brdf;
}
}

//------------------------------------------------------------------------------
TEST(TexelTree, EachLevelHoldsAllLight)
{
  vtkNew<vtkEnvironment> environment;
  std::vector<float> rgb;
  for (int k = 0; k < 3 * 133 * 67; ++k) // no powers of two
  {
    rgb.push_back(static_cast<float>(k % 7) + (k % 101 == 0 ? 500.0f : 0.0f));
  }
  ASSERT_TRUE(environment->SetPixels(133, 67, rgb));
  glm::dvec3 total;
  environment->GetTotal(&total.x);
  const TexelTree tree(environment);
  EXPECT_EQ(tree.GetNumberOfLevels(), 9); // 133, 67, 34, 17, 9, 5, 3, 2, 1
  for (int level = 0; level < tree.GetNumberOfLevels(); ++level)
  {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < tree.GetHeight(level); ++y)
    {
      for (int x = 0; x < tree.GetWidth(level); ++x)
      {
        const TexelTree::Light light = tree.Get(level, x, y);
        sum += light.Irradiance;
        EXPECT_NEAR(glm::length(light.Direction), 1.0, 1e-6);
        EXPECT_TRUE(light.Rest >= 0.0 && light.Rest <= 10.0) << light.Rest;
      }
    }
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(sum[c], total[c], 1e-6 * total[c]) << level;
    }
  }
  EXPECT_EQ(tree.Get(0, 133, 0).Irradiance, glm::dvec3(0.0));
}

//------------------------------------------------------------------------------
TEST(TexelTree, KnowsWhatQuartersLeave)
{
  // Under constant light a third; where one quarter, or one texel, has it all, everything, nothing.
  vtkNew<vtkEnvironment> environment;
  std::vector<float> rgb(3 * 256 * 128, 1.0f);
  environment->SetPixels(256, 128, rgb);
  EXPECT_NEAR(TexelTree(environment).Get(4, 3, 4).Rest, 1.0 / 3.0, 0.01);
  std::fill(rgb.begin(), rgb.end(), 0.0f);
  rgb[3 * (64 * 256 + 80)] = 1.0f;
  environment->SetPixels(256, 128, rgb);
  EXPECT_EQ(TexelTree(environment).Get(4, 5, 4).Rest, 0.0);
  rgb[3 * (65 * 256 + 82)] = 1.0f;
  environment->SetPixels(256, 128, rgb);
  EXPECT_EQ(TexelTree(environment).Get(4, 5, 4).Rest, 10.0);
}

//------------------------------------------------------------------------------
TEST(AdaptiveIntegrator, ToleranceZeroIsTheExactSum)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  ShrinkEnvironment(environment, 128, 64);
  SpherePairs pairs;
  pairs.AddRandom(10);
  for (const double exponent : { 5.0, 3000.0 })
  {
    const auto brdf = NewGloss(exponent, exponent);
    const auto adaptive = NewAdaptive(brdf, environment);
    adaptive->SetTolerance(0.0);
    EXPECT_LT(
      GetLargestError(pairs.Integrate(adaptive), pairs.IntegrateExactly(brdf, environment)), 1e-12);
  }
}

//------------------------------------------------------------------------------
// Every pixel, not the mean of them.
TEST(AdaptiveIntegrator, KeepsItsToleranceAtEachPair)
{
  SpherePairs pairs;
  pairs.AddRandom(60);
  for (const bool hall : { false, true })
  {
    vtkNew<vtkEnvironment> environment;
    hall ? environment->SetToProceduralHall() : environment->SetToProceduralSky();
    environment->SetRotationY(77.0);
    for (const auto& [nu, nv] :
      { std::pair(10.0, 10.0), { 300.0, 300.0 }, { 1e4, 1e4 }, { 30.0, 3000.0 } })
    {
      const auto brdf = NewGloss(nu, nv);
      const auto adaptive = NewAdaptive(brdf, environment);
      const double error =
        GetLargestError(pairs.Integrate(adaptive), pairs.IntegrateExactly(brdf, environment));
      std::printf(
        "%s, exponents %g and %g: %.4f %%\n", hall ? "hall" : "sky", nu, nv, 100.0 * error);
      EXPECT_LT(error, 3e-3) << nu << " " << nv;
    }
  }
}

//------------------------------------------------------------------------------
// A lamp of one texel and a lobe that no middle of a square meets.
TEST(AdaptiveIntegrator, MissesNothingNarrow)
{
  vtkNew<vtkEnvironment> environment;
  std::vector<float> rgb(3 * 512 * 256, 0.01f);
  for (int c = 0; c < 3; ++c)
  {
    rgb[3 * (200 * 512 + 133) + c] = 1e4f;
  }
  environment->SetPixels(512, 256, rgb);
  const auto brdf = NewGloss(1e5, 1e5);
  glm::dvec3 lamp;
  environment->GetTexelDirection(133, 200, &lamp.x);
  const glm::dvec3 normal = glm::normalize(lamp + glm::dvec3(0.2, 0.1, 1.0));
  SpherePairs pairs; // mirrored onto the lamp, and beside it
  for (const double offset : { 0.0, 0.002, 0.01, 0.1 })
  {
    pairs.Add(normal, glm::normalize(glm::reflect(-lamp, normal) + glm::dvec3(offset, 0.0, 0.0)));
  }
  EXPECT_LT(GetLargestError(pairs.Integrate(NewAdaptive(brdf, environment)),
              pairs.IntegrateExactly(brdf, environment)),
    3e-3);
}

//------------------------------------------------------------------------------
TEST(AdaptiveIntegrator, RealMaterials)
{
  SpherePairs pairs;
  pairs.AddRandom(40);
  for (const auto& [material, light] : { std::pair("acrylic_felt_white", "studio"),
         { "satin_purple", "interior" }, { "chm_light_blue", "studio" } })
  {
    const std::string path = Data + "/materials/rgl/" + material + "_rgb.bsdf";
    if (!std::ifstream(path).good())
    {
      GTEST_SKIP() << "no measured data at " << Data;
    }
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(path);
    ASSERT_TRUE(reader->Read());
    vtkNew<vtkEnvironmentReader> environment;
    environment->SetFileName(Data + "/environments/" + light + ".exr");
    ASSERT_TRUE(environment->Read());
    const double error = GetLargestError(
      pairs.Integrate(NewAdaptive(reader->GetBRDF(), environment->GetEnvironment())),
      pairs.IntegrateExactly(reader->GetBRDF(), environment->GetEnvironment()));
    std::printf("%s, %s: %.4f %%\n", material, light, 100.0 * error);
    EXPECT_LT(error, 3e-3);
  }
}

//------------------------------------------------------------------------------
TEST(AdaptiveIntegrator, BlackAndMissing)
{
  vtkNew<vtkEnvironment> black;
  black->SetPixels(2, 1, std::vector<float>(6, 0.0f));
  vtkNew<vtkLambertBRDF> brdf;
  SpherePairs pairs;
  pairs.AddRandom(3);
  const auto adaptive = NewAdaptive(brdf, black);
  for (const glm::dvec3& rgb : pairs.Integrate(adaptive))
  {
    EXPECT_EQ(rgb, glm::dvec3(0.0));
  }
  adaptive->SetEnvironment(nullptr);
  ErrorCatcher errors(adaptive);
  vtkNew<vtkDoubleArray> radiance;
  EXPECT_FALSE(adaptive->Integrate(pairs.Normals, pairs.Views, radiance));
  EXPECT_EQ(errors.Take(), 1);
}
