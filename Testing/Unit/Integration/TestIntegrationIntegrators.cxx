// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "SpherePairs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetRadianceIntegrator.h"

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

vtkNew<vtkBlinnPhongBRDF> NewGlossy(double exponent)
{
  vtkNew<vtkBlinnPhongBRDF> brdf;
  brdf->SetSpecular(0.3, 0.3, 0.3);
  brdf->SetExponent(exponent);
  return brdf;
}
} // namespace

//------------------------------------------------------------------------------
TEST(ExactIntegrator, LambertUnderAConstantSkyHasAClosedForm)
{
  // For n = +y the sum over texel rows has one: sum of sin(lat) dw over the upper half with exact
  // solid angles is pi / cos(dlat/2).
  const int height = 64;
  const auto environment = NewConstantEnvironment(128, height, 2.0f);
  vtkNew<vtkLambertBRDF> brdf;
  const double albedo[3] = { 0.5, 0.25, 0.125 };
  brdf->SetAlbedo(albedo[0], albedo[1], albedo[2]);
  SpherePairs pairs;
  pairs.Add(glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.3, 0.4, 0.5));
  pairs.AddRandom(40);
  const auto radiance = pairs.IntegrateExactly(brdf, environment);
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
  std::mt19937 engine(1);
  std::vector<float> pixels(3 * width * height);
  for (float& value : pixels)
  {
    value = static_cast<float>(std::exp(6.0 * engine() * 0x1p-32 - 4.0));
  }
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetPixels(width, height, pixels));
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(Pi, Pi, Pi); // f = 1
  SpherePairs pairs;
  pairs.AddRandom(10);
  const auto radiance = pairs.IntegrateExactly(brdf, environment);
  for (std::size_t k = 0; k < radiance.size(); ++k)
  {
    glm::dvec3 normal, expected(0.0);
    pairs.Normals->GetTuple(static_cast<vtkIdType>(k), &normal.x);
    for (int y = 0; y < height; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        glm::dvec3 d;
        glm::dvec3 rgb;
        environment->GetTexelDirection(x, y, &d.x);
        environment->GetPixel(x, y, &rgb.x);
        expected += std::max(glm::dot(normal, d), 0.0) * environment->GetTexelSolidAngle(y) * rgb;
      }
    }
    EXPECT_LT(glm::length(radiance[k] - expected), 1e-12 * glm::length(expected));
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
  SpherePairs pairs;
  pairs.Add(glm::dvec3(0.0, 0.0, -2.0), glm::dvec3(0.0, 0.0, -2.0));
  pairs.Add(glm::dvec3(5.0, 0.0, 0.0), glm::dvec3(5.0, 0.0, 0.0));
  // No environment: unrotated.
  auto radiance = pairs.Integrate(integrator);
  EXPECT_EQ(radiance[0].y, 0.0);
  EXPECT_NEAR(radiance[1].y, 2.0, 1e-14);
  integrator->SetEnvironment(environment);
  radiance = pairs.Integrate(integrator);
  EXPECT_NEAR(radiance[0].y, 2.0, 1e-14);
  EXPECT_NEAR(radiance[1].y, 0.0, 1e-14);
}

//------------------------------------------------------------------------------
TEST(Integrators, ErrorsLeaveTheOutputAlone)
{
  const auto environment = NewConstantEnvironment(8, 4, 1.0f);
  vtkNew<vtkLambertBRDF> brdf;
  vtkNew<vtkLightSetRadianceIntegrator> loop;
  ErrorCatcher errors(loop);
  const auto three = NewVectors(std::vector<glm::dvec3>(3, glm::dvec3(0.0, 0.0, 1.0)));
  const auto two = NewVectors(std::vector<glm::dvec3>(2, glm::dvec3(0.0, 0.0, 1.0)));
  const auto zero = NewVectors(std::vector<glm::dvec3>(3, glm::dvec3(0.0)));
  const auto nan = NewVectors(std::vector<glm::dvec3>(3, glm::dvec3(std::nan(""))));
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfTuples(3);
  vtkNew<vtkFloatArray> radiance;
  radiance->SetNumberOfTuples(1);
  radiance->SetValue(0, 42.0f);

  EXPECT_FALSE(loop->Integrate(three, three, radiance)); // no BRDF
  loop->SetBRDF(brdf);
  EXPECT_FALSE(loop->Integrate(three, three, radiance)); // no environment
  vtkNew<vtkEnvironment> empty;
  loop->SetEnvironment(empty);
  EXPECT_FALSE(loop->Integrate(three, three, radiance));
  loop->SetEnvironment(environment);
  EXPECT_FALSE(loop->Integrate(nullptr, three, radiance));
  EXPECT_FALSE(loop->Integrate(three, three, nullptr));
  EXPECT_FALSE(loop->Integrate(three, two, radiance));
  EXPECT_FALSE(loop->Integrate(three, three, radiance, two));
  EXPECT_FALSE(loop->Integrate(scalars, three, radiance));
  EXPECT_FALSE(loop->Integrate(three, zero, radiance));
  EXPECT_FALSE(loop->Integrate(nan, three, radiance));
  EXPECT_FALSE(loop->Integrate(three, three, radiance, nan));
  EXPECT_EQ(errors.Take(), 11);
  EXPECT_EQ(radiance->GetNumberOfTuples(), 1);
  EXPECT_EQ(radiance->GetValue(0), 42.0f);
  EXPECT_TRUE(loop->Integrate(three, three, radiance, zero)); // a zero tangent: any frame
  EXPECT_EQ(radiance->GetNumberOfTuples(), 3);
  EXPECT_EQ(radiance->GetNumberOfComponents(), 3);
}

//------------------------------------------------------------------------------
TEST(LightSetIntegrator, ConvergesToTheReference)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkLightSetGenerator> medianCut, importance;
  importance->SetMethodToImportance();
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(0.5, 0.5, 0.5);
  const struct
  {
    vtkSmartPointer<vtkBRDF> BRDF;
    double MedianCutBound, ImportanceBound; // at 4096 lights
  } materials[] = { { lambert.Get(), 2e-4, 1e-3 }, { NewGlossy(20.0).Get(), 5e-4, 5e-3 },
    { NewGlossy(200.0).Get(), 1e-2, 4e-2 } };
  SpherePairs pairs;
  pairs.AddRandom(60);
  for (const auto& material : materials)
  {
    const auto reference = pairs.IntegrateExactly(material.BRDF, environment);
    for (const bool useMedianCut : { true, false })
    {
      vtkNew<vtkLightSetRadianceIntegrator> loop;
      loop->SetBRDF(material.BRDF);
      loop->SetEnvironment(environment);
      loop->SetGenerator(useMedianCut ? medianCut.Get() : importance.Get());
      std::vector<double> errors;
      for (const int count : { 16, 64, 256, 1024, 4096 })
      {
        loop->SetNumberOfLights(count);
        errors.push_back(GetRelativeError(pairs.Integrate(loop), reference));
        std::printf(" N=%d: %.2e", count, errors.back());
        EXPECT_LT(errors.back(), 1.1 * (errors.size() > 1 ? *(errors.end() - 2) : 1.0));
      }
      std::printf(" of %s by %s\n", material.BRDF->GetClassName(),
        useMedianCut ? "median cut" : "importance");
      EXPECT_LT(errors.back(), 0.1 * errors.front());
      EXPECT_LT(errors.back(), useMedianCut ? material.MedianCutBound : material.ImportanceBound);
    }
  }
}
