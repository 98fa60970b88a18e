// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Filtered importance sampling against the exact sum over every texel, and what must hold exactly.

#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "SharedData.h"
#include "SpherePairs.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

using measuredbrdf::Pi;

namespace
{
// Normals and views from everywhere.
SpherePairs DrawPairs(int count)
{
  std::mt19937 engine(1);
  const auto draw = [&engine]()
  {
    const double z = 2.0 * (engine() * 0x1p-32) - 1.0;
    const double phi = 2.0 * Pi * (engine() * 0x1p-32);
    const double s = std::sqrt(1.0 - z * z);
    return glm::dvec3(s * std::cos(phi), s * std::sin(phi), z);
  };
  SpherePairs pairs;
  for (int k = 0; k < count; ++k)
  {
    const glm::dvec3 n = draw();
    const glm::dvec3 v = draw();
    pairs.Add(n, glm::normalize((glm::dot(n, v) < 0.0 ? -v : v) + 0.2 * n));
  }
  return pairs;
}

vtkNew<vtkFilteredRadianceIntegrator> NewFiltered(
  vtkBRDF* brdf, vtkEnvironment* environment, int count = 32)
{
  vtkNew<vtkFilteredRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  integrator->SetNumberOfSamples(count);
  return integrator;
}

vtkNew<vtkBlinnPhongBRDF> NewLobe(double exponent)
{
  vtkNew<vtkBlinnPhongBRDF> brdf;
  brdf->SetSpecular(0.3, 0.3, 0.3);
  brdf->SetExponent(exponent);
  return brdf;
}

} // namespace

//------------------------------------------------------------------------------
class FilteredReference : public testing::TestWithParam<bool>
{
};

TEST_P(FilteredReference, Converges)
{
  const SpherePairs pairs = DrawPairs(16);
  vtkNew<vtkEnvironment> environment;
  GetParam() ? environment->SetToProceduralHall() : environment->SetToProceduralSky();
  const auto broad = NewLobe(20.0), narrow = NewLobe(500.0);
  const auto coat = NewCoating(50.0);
  const auto sum = NewExactSum(nullptr, environment);
  for (vtkBRDF* brdf :
    { static_cast<vtkBRDF*>(broad), static_cast<vtkBRDF*>(narrow), static_cast<vtkBRDF*>(coat) })
  {
    sum->SetBRDF(brdf);
    const auto reference = pairs.Integrate(sum);
    double first = 0.0;
    for (const auto& [count, limit] :
      { std::pair(8, 1.0), { 32, 0.12 }, { 128, 0.035 }, { 512, 0.015 } })
    {
      const double error =
        GetRelativeError(pairs.Integrate(NewFiltered(brdf, environment, count)), reference);
      std::printf("%s, N=%d: %.4f\n", brdf->GetClassName(), count, error);
      EXPECT_LT(error, limit);
      first = count == 8 ? error : first;
      EXPECT_LT(error, count == 512 ? 0.2 * first : 1.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Procedural, FilteredReference, testing::Bool(),
  [](const auto& info) { return info.param ? "hall" : "sky"; });

//------------------------------------------------------------------------------
// Its sun is 2e5 times the mean and above half float's range.
TEST(FilteredIntegrator, RealSun)
{
  const std::string name = SharedData + "/environments/pmndrs_sunrise.hdr";
  if (!std::ifstream(name))
  {
    GTEST_SKIP() << "no " << name;
  }
  vtkNew<vtkEnvironmentReader> reader;
  reader->SetFileName(name);
  ASSERT_TRUE(reader->Read());
  vtkEnvironment* environment = reader->GetEnvironment();
  const SpherePairs pairs = DrawPairs(25);
  const auto sum = NewExactSum(nullptr, environment);
  for (const double exponent : { 20.0, 200.0 })
  {
    const auto brdf = NewLobe(exponent);
    sum->SetBRDF(brdf);
    const auto reference = pairs.Integrate(sum);
    const auto filtered = NewFiltered(brdf, environment, 64);
    const double error = GetRelativeError(pairs.Integrate(filtered), reference);
    EXPECT_GT(filtered->GetNumberOfExtractedLights(), 0);
    EXPECT_TRUE(filtered->UsesBRDFOnGPU());
    vtkBRDFShaderInputs inputs;
    ASSERT_TRUE(filtered->GetShaderInputs(inputs));
    EXPECT_EQ(inputs.Terms.size(), 2u);
    EXPECT_TRUE(inputs.Terms[0].Textures[0].HalfFloat); // in its range without the sun
    std::printf("sunrise, Blinn-Phong %g, N=64: %.4f\n", exponent, error);
    EXPECT_LT(error, 0.05);
  }
}

//------------------------------------------------------------------------------
// Few draws of a broad lobe hit a small panel, none of whose texels is a lamp: 16, 64 and 256 of
// the whole material had 17, 5 and 1.6 % here.
TEST(FilteredIntegrator, BroadLobesSeeSmallPanels)
{
  constexpr int width = 256;
  constexpr int height = 128;
  std::vector<float> rgb;
  for (int k = 0; k < width * height; ++k)
  {
    const int x = k % width;
    const int y = k / width;
    const bool panel = x >= 100 && x < 130 && y >= 30 && y < 60;
    rgb.insert(rgb.end(), 3, panel ? 40.0f : 0.1f);
  }
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetPixels(width, height, rgb));
  vtkNew<vtkAshikhminShirleyBRDF> coated;
  coated->SetDiffuse(0.3, 0.3, 0.3);
  coated->SetReflectance(0.1, 0.1, 0.1);
  coated->SetExponents(200.0, 200.0);
  const SpherePairs pairs = DrawPairs(40);
  const auto reference = pairs.IntegrateExactly(coated, environment);
  for (const auto& [count, limit] : { std::pair(16, 0.06), { 64, 0.025 }, { 256, 0.006 } })
  {
    const auto filtered = NewFiltered(coated, environment, count);
    const double error = GetRelativeError(pairs.Integrate(filtered), reference);
    std::printf("small panel, N=%d: %.4f\n", count, error);
    EXPECT_LT(error, limit);
    EXPECT_EQ(filtered->GetNumberOfExtractedLights(), 0);
    vtkBRDFShaderInputs inputs;
    ASSERT_TRUE(filtered->GetShaderInputs(inputs));
    vtkIdType bytes = 0;
    for (const auto& texture : inputs.Terms[0].Textures)
    {
      bytes += static_cast<vtkIdType>(texture.Data.size()) * (texture.HalfFloat ? 2 : 4);
    }
    EXPECT_NEAR(filtered->EstimateTextureBytes(), bytes, 2e4);
  }
}

//------------------------------------------------------------------------------
// A mirror-like lobe shows the radiance where it looks: the map's way there and back.
TEST(FilteredIntegrator, MirrorShowsTheEnvironment)
{
  const int width = 256;
  const int height = 128;
  std::vector<float> rgb;
  vtkNew<vtkEnvironment> environment;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      double d[3];
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, d);
      for (const double v : d)
      {
        rgb.push_back(static_cast<float>(2.0 + v)); // linear in the direction
      }
    }
  }
  ASSERT_TRUE(environment->SetPixels(width, height, rgb));
  vtkNew<vtkAshikhminShirleyBRDF> mirror;
  mirror->SetExponents(1e5, 1e5);
  mirror->SetReflectance(1.0, 1.0, 1.0);
  const SpherePairs pairs = DrawPairs(12);
  const auto radiance = pairs.Integrate(NewFiltered(mirror, environment, 256));
  for (int k = 0; k < 12; ++k)
  {
    glm::dvec3 n, v;
    pairs.Normals->GetTuple(k, &n.x);
    pairs.Views->GetTuple(k, &v.x);
    const glm::dvec3 i = 2.0 * glm::dot(n, v) * n - v;
    const double cosine = glm::dot(n, v);
    glm::dvec3 albedo;
    const double o[3] = { std::sqrt(1.0 - cosine * cosine), 0.0, cosine };
    mirror->GetDirectionalAlbedo(o, &albedo.x);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(radiance[std::size_t(k)][c], albedo[c] * (2.0 + i[c]), 0.04) << k;
    }
  }
}

//------------------------------------------------------------------------------
// A material that stops the preparation from inside.
class AbortingBRDF : public vtkLambertBRDF
{
public:
  static AbortingBRDF* New();
  vtkTypeMacro(AbortingBRDF, vtkLambertBRDF);
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    this->Superclass::EvaluateAbove(i, o, f);
    if (this->Integrator)
    {
      this->Integrator->SetAbort(true);
    }
  }
  vtkRadianceIntegrator* Integrator = nullptr;
};
vtkStandardNewMacro(AbortingBRDF);

TEST(FilteredIntegrator, PreparationCanBeAborted)
{
  vtkNew<AbortingBRDF> brdf;
  const auto filtered = NewFiltered(brdf, NewConstantEnvironment(8, 4, 1.0f));
  ErrorCatcher errors(filtered);
  brdf->Integrator = filtered;
  EXPECT_FALSE(filtered->Prepare());
  EXPECT_EQ(errors.Take(), 1);
  brdf->Integrator = nullptr;
  EXPECT_TRUE(filtered->Prepare()); // afresh
  EXPECT_EQ(errors.Take(), 0);
}
