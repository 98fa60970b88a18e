// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkExactRadianceIntegrator.h"
#include "vtkFloatArray.h"
#include "vtkImportanceLightSetGenerator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkSMPTools.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

using measuredbrdf::Pi;

namespace
{
vtkNew<vtkDoubleArray> NewVectors(const std::vector<glm::dvec3>& vectors)
{
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfComponents(3);
  for (const glm::dvec3& v : vectors)
  {
    array->InsertNextTuple(&v.x);
  }
  return array;
}

glm::dvec3 RandomDirection(std::mt19937& engine)
{
  const double z = 2.0 * (engine() * 0x1p-32) - 1.0;
  const double phi = 2.0 * Pi * (engine() * 0x1p-32);
  return glm::dvec3(
    std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z);
}

// Pairs with the view above the horizon, tangents anywhere.
struct Pairs
{
  explicit Pairs(int count, unsigned int seed = 1)
  {
    std::mt19937 engine(seed);
    for (int k = 0; k < count; ++k)
    {
      const glm::dvec3 n = RandomDirection(engine);
      glm::dvec3 v = RandomDirection(engine);
      v = glm::normalize(glm::dot(n, v) < 0.0 ? -v + 0.2 * n : v + 0.2 * n);
      this->Normals.push_back(n);
      this->Views.push_back(v);
      this->Tangents.push_back(RandomDirection(engine));
    }
  }

  Pairs Rotated(const glm::dmat3& rotation) const
  {
    Pairs rotated(*this);
    for (auto* vectors : { &rotated.Normals, &rotated.Views, &rotated.Tangents })
    {
      for (glm::dvec3& v : *vectors)
      {
        v = rotation * v;
      }
    }
    return rotated;
  }

  std::vector<glm::dvec3> Normals;
  std::vector<glm::dvec3> Views;
  std::vector<glm::dvec3> Tangents;
};

std::vector<glm::dvec3> Integrate(
  vtkRadianceIntegrator* integrator, const Pairs& pairs, bool tangents = false)
{
  const auto normals = NewVectors(pairs.Normals);
  const auto views = NewVectors(pairs.Views);
  const auto t = NewVectors(pairs.Tangents);
  vtkNew<vtkDoubleArray> radiance;
  std::vector<glm::dvec3> result;
  EXPECT_TRUE(integrator->Integrate(normals, views, radiance, tangents ? t.Get() : nullptr));
  for (vtkIdType k = 0; k < radiance->GetNumberOfTuples(); ++k)
  {
    glm::dvec3 rgb;
    radiance->GetTuple(k, &rgb.x);
    result.push_back(rgb);
  }
  EXPECT_EQ(result.size(), pairs.Normals.size());
  return result;
}

void SetConstant(vtkEnvironment* environment, int width, int height, float value = 1.0f)
{
  ASSERT_TRUE(environment->SetPixels(
    width, height, std::vector<float>(3 * std::size_t(width) * height, value)));
}

void SetRandom(vtkEnvironment* environment, int width, int height, unsigned int seed = 1)
{
  std::mt19937 engine(seed);
  std::vector<float> rgb(3 * std::size_t(width) * height);
  for (float& value : rgb)
  {
    value = static_cast<float>(std::exp(6.0 * engine() * 0x1p-32 - 4.0));
  }
  ASSERT_TRUE(environment->SetPixels(width, height, rgb));
}

vtkNew<vtkBlinnPhongBRDF> NewGlossy(double exponent)
{
  vtkNew<vtkBlinnPhongBRDF> brdf;
  brdf->SetSpecular(0.3, 0.3, 0.3);
  brdf->SetExponent(exponent);
  return brdf;
}

// RMS difference relative to the RMS of the reference, over all channels.
double RelativeError(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& reference)
{
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    difference += glm::dot(a[k] - reference[k], a[k] - reference[k]);
    sum += glm::dot(reference[k], reference[k]);
  }
  return std::sqrt(difference / sum);
}
} // namespace

//------------------------------------------------------------------------------
TEST(ExactIntegrator, LambertUnderAConstantSkyHasAClosedForm)
{
  // For n = +y the sum over texel rows has one: sum of sin(lat) dw over the upper half with exact
  // solid angles is pi / cos(dlat/2).
  const int height = 64;
  vtkNew<vtkEnvironment> environment;
  SetConstant(environment, 128, height, 2.0f);
  vtkNew<vtkLambertBRDF> brdf;
  const double albedo[3] = { 0.5, 0.25, 0.125 };
  brdf->SetAlbedo(albedo[0], albedo[1], albedo[2]);
  vtkNew<vtkExactRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  Pairs pairs(40);
  pairs.Normals[0] = glm::dvec3(0.0, 1.0, 0.0);
  pairs.Views[0] = glm::dvec3(0.3, 0.4, 0.5);
  const auto radiance = Integrate(integrator, pairs);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(radiance[0][c], 2.0 * albedo[c] / std::cos(0.5 * Pi / height), 1e-13);
    for (const glm::dvec3& rgb : radiance)
    {
      EXPECT_NEAR(rgb[c], 2.0 * albedo[c], 2e-3 * albedo[c]);
    }
  }
}

//------------------------------------------------------------------------------
TEST(ExactIntegrator, EqualsAPlainSum)
{
  const int width = 160;
  const int height = 90;
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, width, height);
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(Pi, Pi, Pi); // f = 1
  vtkNew<vtkExactRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  const Pairs pairs(10);
  const auto radiance = Integrate(integrator, pairs);
  for (std::size_t k = 0; k < radiance.size(); ++k)
  {
    glm::dvec3 expected(0.0);
    for (int y = 0; y < height; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        glm::dvec3 d;
        glm::dvec3 rgb;
        environment->GetTexelDirection(x, y, &d.x);
        environment->GetPixel(x, y, &rgb.x);
        expected +=
          std::max(glm::dot(pairs.Normals[k], d), 0.0) * environment->GetTexelSolidAngle(y) * rgb;
      }
    }
    EXPECT_LT(glm::length(radiance[k] - expected), 1e-12 * glm::length(expected));
  }
}

//------------------------------------------------------------------------------
TEST(Integrators, RotatingEverythingChangesNothing)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 64, 32);
  vtkNew<vtkMedianCutLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  ASSERT_TRUE(generator->Generate(environment, 64, lights));
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetExponents(10.0, 80.0); // anisotropic: the tangents turn along
  vtkNew<vtkExactRadianceIntegrator> exact;
  vtkNew<vtkLightSetRadianceIntegrator> loop;
  loop->SetLightSet(lights);
  const Pairs pairs(25);

  const glm::dvec3 x = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  const glm::dvec3 y = glm::normalize(glm::cross(x, glm::dvec3(0.9, 0.1, 0.4)));
  const glm::dmat3 rotation(x, y, glm::cross(x, y));
  double rows[9]; // its inverse by rows: the columns of the rotation
  for (int k = 0; k < 9; ++k)
  {
    rows[k] = rotation[k / 3][k % 3];
  }
  for (vtkRadianceIntegrator* integrator :
    { static_cast<vtkRadianceIntegrator*>(exact), static_cast<vtkRadianceIntegrator*>(loop) })
  {
    integrator->SetBRDF(brdf);
    integrator->SetEnvironment(environment);
    environment->SetRotationY(0.0);
    const auto before = Integrate(integrator, pairs, true);
    environment->SetWorldToEnvironment(rows);
    const auto after = Integrate(integrator, pairs.Rotated(rotation), true);
    const auto alone = Integrate(integrator, pairs, true);
    EXPECT_LT(RelativeError(after, before), 1e-10);
    EXPECT_GT(RelativeError(alone, before), 1e-2);
  }
}

//------------------------------------------------------------------------------
TEST(Integrators, RotatedEnvironmentIsSeenWhereItShouldBe)
{
  // Light from +x only; turned by 90 degrees about y it comes from -z.
  vtkNew<vtkLightSet> lights;
  const double x[3] = { 1.0, 0.0, 0.0 };
  const double irradiance[3] = { 1.0, 2.0, 3.0 };
  ASSERT_TRUE(lights->AddLight(x, irradiance));
  vtkNew<vtkEnvironment> environment;
  environment->SetRotationY(90.0);
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(Pi, Pi, Pi);
  vtkNew<vtkLightSetRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetLightSet(lights);
  Pairs pairs(2);
  pairs.Normals = pairs.Views = { glm::dvec3(0.0, 0.0, -2.0), glm::dvec3(5.0, 0.0, 0.0) };
  // No environment: unrotated.
  auto radiance = Integrate(integrator, pairs);
  EXPECT_EQ(radiance[0].y, 0.0);
  EXPECT_NEAR(radiance[1].y, 2.0, 1e-14);
  integrator->SetEnvironment(environment);
  radiance = Integrate(integrator, pairs);
  EXPECT_NEAR(radiance[0].y, 2.0, 1e-14);
  EXPECT_NEAR(radiance[1].y, 0.0, 1e-14);
}

//------------------------------------------------------------------------------
TEST(Integrators, ErrorsLeaveTheOutputAlone)
{
  vtkNew<vtkEnvironment> environment;
  SetConstant(environment, 8, 4);
  vtkNew<vtkLambertBRDF> brdf;
  vtkNew<vtkExactRadianceIntegrator> exact;
  ErrorCatcher errors(exact);
  const auto three = NewVectors(std::vector<glm::dvec3>(3, glm::dvec3(0.0, 0.0, 1.0)));
  const auto two = NewVectors(std::vector<glm::dvec3>(2, glm::dvec3(0.0, 0.0, 1.0)));
  const auto zero = NewVectors(std::vector<glm::dvec3>(3, glm::dvec3(0.0)));
  const auto nan = NewVectors(std::vector<glm::dvec3>(3, glm::dvec3(std::nan(""))));
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfTuples(3);
  vtkNew<vtkFloatArray> radiance;
  radiance->SetNumberOfTuples(1);
  radiance->SetValue(0, 42.0f);

  EXPECT_FALSE(exact->Integrate(three, three, radiance)); // no BRDF
  exact->SetBRDF(brdf);
  EXPECT_FALSE(exact->Integrate(three, three, radiance)); // no environment
  vtkNew<vtkEnvironment> empty;
  exact->SetEnvironment(empty);
  EXPECT_FALSE(exact->Integrate(three, three, radiance));
  exact->SetEnvironment(environment);
  EXPECT_FALSE(exact->Integrate(nullptr, three, radiance));
  EXPECT_FALSE(exact->Integrate(three, three, nullptr));
  EXPECT_FALSE(exact->Integrate(three, two, radiance));
  EXPECT_FALSE(exact->Integrate(three, three, radiance, two));
  EXPECT_FALSE(exact->Integrate(scalars, three, radiance));
  EXPECT_FALSE(exact->Integrate(three, zero, radiance));
  EXPECT_FALSE(exact->Integrate(nan, three, radiance));
  EXPECT_FALSE(exact->Integrate(three, three, radiance, nan));
  EXPECT_EQ(errors.Take(), 11);
  EXPECT_EQ(radiance->GetNumberOfTuples(), 1);
  EXPECT_EQ(radiance->GetValue(0), 42.0f);
  EXPECT_TRUE(exact->Integrate(three, three, radiance, zero)); // a zero tangent: any frame
  EXPECT_EQ(radiance->GetNumberOfTuples(), 3);
  EXPECT_EQ(radiance->GetNumberOfComponents(), 3);

  vtkNew<vtkLightSetRadianceIntegrator> loop;
  loop->SetBRDF(brdf);
  ErrorCatcher loopErrors(loop);
  EXPECT_FALSE(loop->Integrate(three, three, radiance));
  EXPECT_EQ(loopErrors.Take(), 1);
}

//------------------------------------------------------------------------------
TEST(LightSetIntegrator, ConvergesToTheReference)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkMedianCutLightSetGenerator> medianCut;
  vtkNew<vtkImportanceLightSetGenerator> importance;
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(0.5, 0.5, 0.5);
  const auto broad = NewGlossy(20.0);
  const auto sharp = NewGlossy(200.0);
  struct
  {
    vtkBRDF* BRDF;
    const char* Name;
    double MedianCutBound, ImportanceBound; // at 4096 lights
  } const materials[] = { { lambert, "Lambert", 2e-4, 1e-3 },
    { broad.Get(), "Blinn-Phong 20", 5e-4, 5e-3 }, { sharp.Get(), "Blinn-Phong 200", 1e-2, 4e-2 } };
  const int counts[] = { 16, 64, 256, 1024, 4096 };
  const Pairs pairs(60);

  std::printf("RMS error of the light loop relative to the exact sum, procedural sky\n");
  std::printf("%-16s %-11s", "material", "lights by");
  for (int count : counts)
  {
    std::printf(" N=%-7d", count);
  }
  std::printf("\n");
  for (const auto& material : materials)
  {
    vtkNew<vtkExactRadianceIntegrator> exact;
    exact->SetBRDF(material.BRDF);
    exact->SetEnvironment(environment);
    const auto reference = Integrate(exact, pairs);
    for (bool useMedianCut : { true, false })
    {
      vtkLightSetGenerator* generator = importance;
      if (useMedianCut)
      {
        generator = medianCut;
      }
      std::vector<double> errors;
      for (int count : counts)
      {
        vtkNew<vtkLightSet> lights;
        ASSERT_TRUE(generator->Generate(environment, count, lights));
        vtkNew<vtkLightSetRadianceIntegrator> loop;
        loop->SetBRDF(material.BRDF);
        loop->SetLightSet(lights);
        errors.push_back(RelativeError(Integrate(loop, pairs), reference));
      }
      std::printf("%-16s %-11s", material.Name, useMedianCut ? "median cut" : "importance");
      for (double error : errors)
      {
        std::printf(" %-9.2e", error);
      }
      std::printf("\n");
      for (std::size_t k = 1; k < errors.size(); ++k)
      {
        EXPECT_LT(errors[k], 1.1 * errors[k - 1]) << counts[k];
      }
      EXPECT_LT(errors.back(), 0.1 * errors.front());
      EXPECT_LT(errors.back(), useMedianCut ? material.MedianCutBound : material.ImportanceBound);
    }
  }
}
