// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Filtered importance sampling against the exact sum over every texel, and what must hold exactly.

#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "SharedData.h"
#include "SpherePairs.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkExactRadianceIntegrator.h"
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
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using measuredbrdf::Pi;

namespace
{
// Normals and views from everywhere.
struct ViewPairs : SpherePairs
{
  void AddRandom(int count, unsigned int seed = 1)
  {
    std::mt19937 engine(seed);
    const auto direction = [&engine]()
    {
      const double z = 2.0 * (engine() * 0x1p-32) - 1.0;
      const double phi = 2.0 * Pi * (engine() * 0x1p-32);
      const double s = std::sqrt(1.0 - z * z);
      return glm::dvec3(s * std::cos(phi), s * std::sin(phi), z);
    };
    for (int k = 0; k < count; ++k)
    {
      const glm::dvec3 n = direction();
      const glm::dvec3 v = direction();
      this->Add(n, glm::normalize((glm::dot(n, v) < 0.0 ? -v : v) + 0.2 * n));
    }
  }
};

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

// Its error at N = 8, 32, 128, 512, printed.
std::vector<double> GetErrors(const std::string& name, vtkBRDF* brdf, vtkEnvironment* environment,
  const ViewPairs& pairs, const std::vector<glm::dvec3>& reference)
{
  std::vector<double> errors;
  std::printf("%-34s", name.c_str());
  for (const int count : { 8, 32, 128, 512 })
  {
    const auto filtered = NewFiltered(brdf, environment, count);
    errors.push_back(GetRelativeError(pairs.Integrate(filtered), reference));
    std::printf(" N=%d: %.4f ", count, errors.back());
  }
  std::printf("\n");
  return errors;
}
} // namespace

//------------------------------------------------------------------------------
// Both at tabulated views and between them.
TEST(FilteredIntegrator, WhiteFurnaceIsTheDirectionalAlbedo)
{
  const auto environment = NewConstantEnvironment(64, 32, 1.0f);
  std::vector<vtkSmartPointer<vtkBRDF>> materials;
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); k += 6)
  {
    materials.push_back(vtkSmartPointer<vtkBRDF>::Take(
      vtkEmbeddedMaterials::NewBRDF(vtkEmbeddedMaterials::GetName(k))));
  }
  materials.push_back(vtkSmartPointer<vtkBRDF>(vtkNew<vtkLambertBRDF>()));
  materials.push_back(vtkSmartPointer<vtkBRDF>(vtkNew<vtkDistributionBRDF>()));
  materials.push_back(vtkSmartPointer<vtkBRDF>(NewLobe(1.0)));
  materials.push_back(vtkSmartPointer<vtkBRDF>(NewLobe(300.0)));
  double worst = 0.0;
  for (vtkBRDF* brdf : materials)
  {
    ASSERT_TRUE(brdf);
    const double error =
      FurnacePairs(brdf, 1.0).GetLargestError(NewFiltered(brdf, environment, 1024));
    EXPECT_LT(error, 0.03) << brdf->GetName() << " " << brdf->GetClassName();
    worst = std::max(worst, error);
  }
  std::printf("furnace against albedo: largest relative difference %.2e\n", worst);
}

//------------------------------------------------------------------------------
class FilteredReference : public testing::TestWithParam<bool>
{
};

TEST_P(FilteredReference, Converges)
{
  std::printf("Relative L1 error against the exact sum\n");
  ViewPairs pairs;
  pairs.AddRandom(16);
  vtkNew<vtkAshikhminShirleyBRDF> ashikhminShirley;
  ashikhminShirley->SetExponents(50.0, 50.0);
  ashikhminShirley->SetDiffuse(0.3, 0.2, 0.1);
  struct
  {
    const char* Name;
    vtkSmartPointer<vtkBRDF> BRDF;
  } const materials[] = { { "Blinn-Phong 20", NewLobe(20.0).Get() },
    { "Blinn-Phong 100", NewLobe(100.0).Get() }, { "Blinn-Phong 500", NewLobe(500.0).Get() },
    { "Ashikhmin-Shirley 50", ashikhminShirley.Get() } };
  const bool hall = GetParam();
  vtkNew<vtkEnvironment> environment;
  if (hall)
  {
    environment->SetToProceduralHall();
  }
  else
  {
    environment->SetToProceduralSky();
  }
  for (const auto& material : materials)
  {
    vtkNew<vtkExactRadianceIntegrator> exact;
    exact->SetBRDF(material.BRDF);
    exact->SetEnvironment(environment);
    const auto errors = GetErrors(std::string(material.Name) + (hall ? ", hall" : ", sky"),
      material.BRDF, environment, pairs, pairs.Integrate(exact));
    EXPECT_LT(errors[1], 0.12);
    EXPECT_LT(errors[2], 0.035);
    EXPECT_LT(errors[3], 0.015);
    EXPECT_LT(errors[3], 0.2 * errors[0]);
  }
}

INSTANTIATE_TEST_SUITE_P(Procedural, FilteredReference, testing::Bool(),
  [](const auto& info) { return info.param ? "hall" : "sky"; });

//------------------------------------------------------------------------------
// Radiance computed with the RGL authors' own code: 12 pairs each.
class FilteredMeasured : public testing::TestWithParam<const char*>
{
};

TEST_P(FilteredMeasured, TwelvePairs)
{
  if (!std::ifstream(SharedData + "/expected/satin_purple.studio.csv"))
  {
    GTEST_SKIP() << "no measured data at " << SharedData;
  }
  const std::string light = GetParam();
  vtkNew<vtkEnvironmentReader> environment;
  environment->SetFileName(SharedData + "/environments/" + light + ".exr");
  ASSERT_TRUE(environment->Read()) << environment->GetErrorMessage();
  for (const std::string material : { "chm_light_blue", "cc_ibiza_sunset", "satin_purple" })
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(SharedData + "/materials/rgl/" + material + "_rgb.bsdf");
    ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
    std::ifstream file(SharedData + "/expected/" + material + "." + light + ".csv");
    ViewPairs pairs;
    std::vector<glm::dvec3> expected;
    for (std::string line; std::getline(file, line);)
    {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream text(line);
      glm::dvec3 n, v, rgb;
      if (text >> n.x >> n.y >> n.z >> v.x >> v.y >> v.z >> rgb.x >> rgb.y >> rgb.z)
      {
        pairs.Add(n, v);
        expected.push_back(rgb);
      }
    }
    ASSERT_EQ(expected.size(), 12u);
    const auto filtered = NewFiltered(reader->GetBRDF(), environment->GetEnvironment(), 128);
    const double error = GetRelativeError(pairs.Integrate(filtered), expected);
    std::printf("%s, %s: N=128: %.4f\n", material.c_str(), light.c_str(), error);
    EXPECT_LT(error, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(RGL, FilteredMeasured, testing::Values("studio", "interior"),
  [](const auto& info) { return std::string(info.param); });

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
  ViewPairs pairs;
  pairs.AddRandom(25);
  for (const double exponent : { 20.0, 200.0 })
  {
    const auto brdf = NewLobe(exponent);
    vtkNew<vtkExactRadianceIntegrator> exact;
    exact->SetBRDF(brdf);
    exact->SetEnvironment(environment);
    const auto reference = pairs.Integrate(exact);
    const auto filtered = NewFiltered(brdf, environment, 64);
    const double error = GetRelativeError(pairs.Integrate(filtered), reference);
    EXPECT_GT(filtered->GetNumberOfExtractedLights(), 0);
    EXPECT_TRUE(filtered->UsesBRDFOnGPU());
    vtkBRDFShaderInputs form;
    ASSERT_TRUE(filtered->GetShaderInputs(form));
    EXPECT_EQ(form.Terms.size(), 2u);
    EXPECT_TRUE(form.Terms[0].Textures[0].HalfFloat); // in its range without the sun
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
  ViewPairs pairs;
  pairs.AddRandom(40);
  vtkNew<vtkExactRadianceIntegrator> exact;
  exact->SetBRDF(coated);
  exact->SetEnvironment(environment);
  const auto reference = pairs.Integrate(exact);
  for (const auto& [count, limit] : { std::pair(16, 0.06), { 64, 0.025 }, { 256, 0.006 } })
  {
    const auto filtered = NewFiltered(coated, environment, count);
    const double error = GetRelativeError(pairs.Integrate(filtered), reference);
    std::printf("small panel, N=%d: %.4f\n", count, error);
    EXPECT_LT(error, limit);
    EXPECT_EQ(filtered->GetNumberOfExtractedLights(), 0);
    vtkBRDFShaderInputs form;
    ASSERT_TRUE(filtered->GetShaderInputs(form));
    vtkIdType bytes = 0;
    for (const auto& texture : form.Terms[0].Textures)
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
  ViewPairs pairs;
  pairs.AddRandom(50);
  const auto radiance = pairs.Integrate(NewFiltered(mirror, environment, 256));
  for (int k = 0; k < 50; ++k)
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
