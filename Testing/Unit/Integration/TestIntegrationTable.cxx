// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Tables of radiance against the exact sum over every texel, and what must hold exactly.

#include "GatedBRDF.h"
#include "HalfVector.h" // for Pi
#include "SpherePairs.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTableRadianceIntegrator.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

using measuredbrdf::Pi;

namespace
{
vtkNew<vtkTableRadianceIntegrator> NewTable(
  vtkBRDF* brdf, vtkEnvironment* environment, int rows = 17, int angles = 8, int azimuths = 8)
{
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetBRDF(brdf);
  table->SetEnvironment(environment);
  table->SetNumberOfRows(rows);
  table->SetNumberOfViewAngles(angles);
  table->SetNumberOfAzimuths(azimuths);
  return table;
}

vtkNew<vtkBlinnPhongBRDF> NewPhong(double exponent)
{
  vtkNew<vtkBlinnPhongBRDF> brdf;
  brdf->SetSpecular(0.4, 0.3, 0.2);
  brdf->SetExponent(exponent);
  return brdf;
}

// Counts progress events, checks that they rise.
struct ProgressWatch
{
  explicit ProgressWatch(vtkRadianceIntegrator* integrator)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* value)
      {
        auto* watch = static_cast<ProgressWatch*>(self);
        EXPECT_GT(*static_cast<double*>(value), watch->Last);
        watch->Last = *static_cast<double*>(value);
        ++watch->Count;
      });
    integrator->AddObserver(vtkCommand::ProgressEvent, this->Command);
  }

  vtkNew<vtkCallbackCommand> Command;
  double Last = 0.0;
  int Count = 0;
};
} // namespace

//------------------------------------------------------------------------------
class TableReference : public testing::TestWithParam<std::tuple<bool, int>>
{
};

TEST_P(TableReference, ErrorFallsWithSize)
{
  const bool hall = std::get<0>(GetParam());
  const auto environment = NewSmallEnvironment(hall);
  SpherePairs pairs;
  pairs.AddRandom(60);
  vtkNew<vtkLambertBRDF> lambert;
  const struct
  {
    const char* Name;
    vtkSmartPointer<vtkBRDF> BRDF;
    double Limits[3];
    // Irradiance has 9 bits: a step is at most 1/256 of the largest channel, so that rounding is
    // off by at most 1/1024 of it in the mean, and by a larger part of smaller channels.
  } cases[] = { { "Lambert", lambert.Get(), { 1.2e-3, 1.2e-3, 1.2e-3 } },
    { "Blinn-Phong 5", NewPhong(5.0).Get(), { 0.02, 0.006, 0.005 } },
    { "Blinn-Phong 40", NewPhong(40.0).Get(), { 0.1, 0.03, 0.015 } },
    { "Ashikhmin-Shirley 50", NewCoating(50.0).Get(), { 0.1, 0.05, 0.015 } } };
  const auto& material = cases[std::get<1>(GetParam())];
  const auto reference = pairs.IntegrateExactly(material.BRDF, environment);
  const int sizes[3][3] = { { 17, 8, 8 }, { 33, 12, 16 }, { 65, 16, 16 } };
  double last = 1.0;
  for (int k = 0; k < 3; ++k)
  {
    const auto table = NewTable(material.BRDF, environment, sizes[k][0], sizes[k][1], sizes[k][2]);
    const double error = GetRelativeError(pairs.Integrate(table), reference);
    std::printf("%s, %s, %d rows: relative L1 %.4f\n", material.Name, hall ? "hall" : "sky",
      sizes[k][0], error);
    EXPECT_LT(error, material.Limits[k]) << material.Name;
    // The sum over texels' centers, which stands for the integral here, is off by a little itself.
    EXPECT_LE(error, last + 2e-4) << material.Name;
    last = error;
  }
}

INSTANTIATE_TEST_SUITE_P(Procedural, TableReference,
  testing::Combine(testing::Bool(), testing::Range(0, 4)),
  [](const auto& info)
  {
    return std::string(std::get<0>(info.param) ? "hall" : "sky") +
           std::to_string(std::get<1>(info.param));
  });

//------------------------------------------------------------------------------
// Steps of 1e-5 across the poles, the seam of the azimuth, and the view along the normal.
TEST(TableIntegrator, Continuous)
{
  const auto environment = NewSmallEnvironment(true);
  const double e = 0.5e-5;
  for (const double exponent : { 5.0, 200.0 })
  {
    const auto table = NewTable(NewCoating(exponent), environment, 33, 12, 16);
    const auto getLargestStep = [&](const char* what, const SpherePairs& pairs)
    {
      const auto radiance = pairs.Integrate(table);
      double step = 0.0;
      double largest = 0.0;
      for (std::size_t k = 0; k < radiance.size(); k += 2)
      {
        for (int c = 0; c < 3; ++c)
        {
          step = std::max(step, std::abs(radiance[k][c] - radiance[k + 1][c]));
          largest = std::max(largest, radiance[k][c]);
        }
      }
      std::printf(
        "exponent %g, %s: steps up to %.1e of the largest\n", exponent, what, step / largest);
      return step / largest;
    };
    SpherePairs poles, seam, along, axes;
    for (int k = 0; k < 48; ++k)
    {
      const double phi = 2.0 * Pi * k / 48;
      const glm::dvec3 rim(std::cos(phi), 0.0, std::sin(phi));
      const glm::dvec3 pole(0.0, k % 2 == 0 ? 1.0 : -1.0, 0.0);
      const glm::dvec3 view = glm::normalize(pole + glm::dvec3(0.5, 0.1, 0.3));
      poles.Add(glm::normalize(pole + e * rim), view);
      poles.Add(glm::normalize(pole - e * rim), view);
      // The lobe's axis through the pole: near the mirror direction, which is the pole.
      const glm::dvec3 n = glm::normalize(pole + 0.7 * rim);
      const glm::dvec3 mirrored = glm::normalize(2.0 * glm::dot(n, pole) * n - pole);
      const glm::dvec3 side = glm::normalize(glm::cross(n, rim + glm::dvec3(0.1, 0.2, 0.3)));
      axes.Add(n, glm::normalize(mirrored + e * side));
      axes.Add(n, glm::normalize(mirrored - e * side));
      // The azimuth of (z, x) jumps at z < 0, x = 0, that of (x, z) at x < 0, z = 0.
      const glm::dvec3 at(0.0, std::sin(phi), -std::cos(phi));
      const glm::dvec3 across = k % 2 == 0 ? glm::dvec3(e, 0.0, 0.0) : glm::dvec3(0.0, 0.0, e);
      const glm::dvec3 base = k % 2 == 0 ? at : glm::dvec3(at.z, at.y, 0.0);
      const glm::dvec3 oblique = glm::normalize(base + glm::dvec3(0.2, 0.4, 0.1));
      seam.Add(glm::normalize(base + across), oblique);
      seam.Add(glm::normalize(base - across), oblique);
      const glm::dvec3 normal = glm::normalize(rim + glm::dvec3(0.1, 0.6 * std::sin(5 * phi), 0));
      const glm::dvec3 aside = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 1.0, phi)));
      along.Add(normal, glm::normalize(normal + e * aside));
      along.Add(normal, glm::normalize(normal - e * aside));
    }
    EXPECT_LT(getLargestStep("normals over the poles", poles), 1e-4);
    EXPECT_LT(getLargestStep("axes over the poles", axes), 1e-4);
    EXPECT_LT(getLargestStep("normals over the seam", seam), 1e-4);
    // There the table's azimuths are alike to 5e-6, and each is rounded to nine bits: in a few
    // texels two come out a step of 1/512 apart. Which ones is a matter of chance.
    EXPECT_LT(getLargestStep("views through the normal", along), 5e-4);
  }
}

//------------------------------------------------------------------------------
// One texel 2e5 and 1e7 times the rest, whose table is beyond half float.
TEST(TableIntegrator, Suns)
{
  SpherePairs pairs;
  pairs.AddRandom(60);
  const auto environment = NewConstantEnvironment(128, 64, 1.0f);
  std::vector<float> rgb = environment->GetPixels();
  const struct
  {
    float Peak;
    double Exponent;
  } cases[] = { { 2e5f, 5.0 }, { 1e7f, 50.0 } };
  for (const auto& sun : cases)
  {
    rgb[3 * (45 * 128 + 30)] = rgb[3 * (45 * 128 + 30) + 1] = sun.Peak;
    ASSERT_TRUE(environment->SetPixels(128, 64, rgb));
    const auto brdf = NewCoating(sun.Exponent);
    const auto table = NewTable(brdf, environment, 65, 16, 16);
    const double error =
      GetRelativeError(pairs.Integrate(table), pairs.IntegrateExactly(brdf, environment));
    vtkBRDFShaderInputs inputs;
    ASSERT_TRUE(table->GetShaderInputs(inputs));
    float largest = 0.0f;
    for (const float value : inputs.Terms[0].Textures[1].Data)
    {
      largest = std::max(largest, std::abs(value));
    }
    std::printf("one texel of %g, exponent %g: relative L1 %.4f, largest stored %g\n", sun.Peak,
      sun.Exponent, error, largest);
    EXPECT_LT(error, 0.05);
    EXPECT_LE(largest, 32768.0f * 1.001f); // half float ends at 65504
  }
}

//------------------------------------------------------------------------------
TEST(TableIntegrator, AChannelThatReflectsNothingStaysBlack)
{
  vtkNew<vtkBlinnPhongBRDF> red;
  red->SetSpecular(0.5, 0.0, 0.0);
  red->SetExponent(20.0);
  vtkNew<vtkLambertBRDF> blue;
  blue->SetAlbedo(0.0, 0.0, 0.5);
  const auto environment = NewSmallEnvironment(true);
  SpherePairs pairs;
  pairs.AddRandom(60);
  for (const glm::dvec3& rgb : pairs.Integrate(NewTable(red, environment)))
  {
    EXPECT_EQ(rgb.y, 0.0);
    EXPECT_EQ(rgb.z, 0.0);
  }
  for (const glm::dvec3& rgb : pairs.Integrate(NewTable(blue, environment)))
  {
    EXPECT_EQ(rgb.x, 0.0);
    EXPECT_EQ(rgb.y, 0.0);
    EXPECT_GT(rgb.z, 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(TableIntegrator, ProgressRisesToOne)
{
  const auto table = NewTable(NewCoating(20.0), NewSmallEnvironment(false), 9, 4, 4);
  ProgressWatch watch(table);
  EXPECT_TRUE(table->Prepare());
  EXPECT_GE(watch.Count, 3);
  EXPECT_EQ(watch.Last, 1.0);
}

//------------------------------------------------------------------------------
TEST(TableIntegrator, ShaderInputs)
{
  const auto table = NewTable(NewCoating(20.0), NewSmallEnvironment(false), 9, 5, 6);
  vtkBRDFShaderInputs inputs;
  ASSERT_TRUE(table->GetShaderInputs(inputs));
  EXPECT_FALSE(table->UsesBRDFOnGPU());
  ASSERT_EQ(inputs.Terms.size(), 1u);
  EXPECT_EQ(inputs.Terms[0].Shader, "vtkBRDFEnvironmentTable");
  ASSERT_EQ(inputs.Terms[0].Textures.size(), 3u);
  std::size_t bytes = 0;
  for (const vtkBRDFShaderInputs::Texture& texture : inputs.Terms[0].Textures)
  {
    const std::size_t texels = static_cast<std::size_t>(texture.Dimensions[0]) *
                               static_cast<std::size_t>(texture.Dimensions[1]) *
                               static_cast<std::size_t>(texture.Dimensions[2]);
    const bool isPacked = !texture.SharedExponents.empty();
    const std::size_t channels = texture.Name == "brdfTableProfile" ? 4 : 3;
    EXPECT_EQ(texture.Data.size(), isPacked ? 0 : channels * texels) << texture.Name;
    EXPECT_EQ(texture.SharedExponents.size(), isPacked ? texels : 0) << texture.Name;
    EXPECT_EQ(texture.GetBytes(), texels * (isPacked ? 4 : 16)) << texture.Name;
    bytes += texture.GetBytes();
    for (const float value : texture.Data)
    {
      ASSERT_TRUE(std::isfinite(value)) << texture.Name;
    }
  }
  EXPECT_EQ(inputs.GetTextureBytes(), bytes);
  const vtkBRDFShaderInputs::Texture& volume = inputs.Terms[0].Textures[1];
  EXPECT_EQ(volume.Dimensions[0], 16);
  EXPECT_EQ(volume.Dimensions[1], 9);
  EXPECT_EQ(volume.Dimensions[2], 5 * 7); // the first azimuth again after the last
  EXPECT_TRUE(volume.ThreeD && !volume.SharedExponents.empty() && volume.Repeat[0]);
  EXPECT_NE(inputs.Description.find("16 x 9"), std::string::npos) << inputs.Description;

  // Without a Lambert part there is no map of irradiance.
  table->SetBRDF(NewPhong(1e4)); // 0 far from the lobe, to the last bit
  ASSERT_TRUE(table->GetShaderInputs(inputs));
  EXPECT_EQ(inputs.Terms[0].Textures.size(), 2u);
}

// A quick one differs by less than a tenth of what a stand-in may be wrong by, for a fifth of the
// evaluations.
TEST(Tables, QuickOnesEvaluateLittle)
{
  const auto sky =
    vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("room"));
  for (const double exponent : { 5.0, 60.0 })
  {
    vtkNew<GatedBRDF> brdf;
    brdf->SetExponent(exponent);
    brdf->SetSpecular(0.4, 0.3, 0.2);
    SpherePairs pairs;
    pairs.AddRandom(200);
    vtkNew<vtkDoubleArray> radiance[2];
    long evaluations[2] = {};
    for (const int quick : { 0, 1 })
    {
      const auto table = NewTable(brdf, sky, 33);
      table->SetQuick(quick == 1);
      brdf->Door->TakePasses();
      ASSERT_TRUE(table->Prepare());
      evaluations[quick] = brdf->Door->TakePasses();
      table->Integrate(pairs.Normals, pairs.Views, radiance[quick]);
    }
    double difference = 0.0;
    double sum = 0.0;
    for (vtkIdType k = 0; k < radiance[0]->GetNumberOfValues(); ++k)
    {
      difference += std::abs(radiance[1]->GetValue(k) - radiance[0]->GetValue(k));
      sum += radiance[0]->GetValue(k);
    }
    RecordProperty("difference", std::to_string(difference / sum));
    EXPECT_LT(difference, 0.02 * sum) << exponent;
    EXPECT_LT(5 * evaluations[1], evaluations[0]) << exponent;
  }
}
