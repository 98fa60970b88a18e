// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Soft light on tables: levels of a half/difference volume against the closed forms they were
// tabulated from.

#include "HalfVector.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

using measuredbrdf::Pi;

namespace
{
vtkSmartPointer<vtkTabulatedBRDF> Tabulate(
  vtkBRDF* brdf, bool reciprocal, int nPhiD, int nThetaD, int nThetaH)
{
  vtkNew<vtkBRDFResampler> resampler;
  resampler->SetInput(brdf);
  resampler->SetReciprocal(reciprocal);
  EXPECT_TRUE(resampler->ResampleTo(nPhiD, nThetaD, nThetaH));
  return resampler->GetOutput();
}

// Calls visit(i, weight) for directions i above the horizon, dense about the mirror direction of o;
// weights: cos(theta_i) times i's solid angle.
template <typename Visitor>
void VisitLights(const double o[3], Visitor visit)
{
  const glm::dvec3 view = glm::make_vec3(o);
  constexpr int nTheta = 120;
  constexpr int nPhi = 32;
  for (int k = 0; k < nTheta; ++k)
  {
    const double u = (k + 0.5) / nTheta;
    const double theta = measuredbrdf::UnitToThetaH(u);
    for (int m = 0; m < nPhi; ++m)
    {
      const double phi = 2.0 * Pi * (m + 0.5) / nPhi;
      const glm::dvec3 h(
        std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      const double c = glm::dot(h, view);
      const glm::dvec3 i = measuredbrdf::ReflectAbout(view, h);
      if (c > 0.0 && i.z > 0.0)
      {
        const double ring = std::sin(theta) * Pi * u / nTheta * 2.0 * Pi / nPhi;
        visit(glm::value_ptr(i), i.z * 4.0 * c * ring);
      }
    }
  }
}

std::vector<double> GetView(double degrees)
{
  const double theta = degrees * Pi / 180.0;
  return { std::sin(theta), 0.0, std::cos(theta) };
}

// Relative L2 distance of soft f over lights and views.
double GetDistance(vtkBRDF* a, vtkBRDF* b, double spread, double viewDegrees)
{
  double differences = 0.0;
  double squares = 0.0;
  const std::vector<double> o = GetView(viewDegrees);
  VisitLights(o.data(),
    [&](const double i[3], double weight)
    {
      double f[3], g[3];
      a->EvaluateSoft(i, o.data(), spread, f);
      b->EvaluateSoft(i, o.data(), spread, g);
      differences += weight * (f[1] - g[1]) * (f[1] - g[1]);
      squares += weight * f[1] * f[1];
    });
  return std::sqrt(differences / squares);
}

double GetAlbedo(vtkBRDF* brdf, double spread, double viewDegrees)
{
  double albedo = 0.0;
  const std::vector<double> o = GetView(viewDegrees);
  VisitLights(o.data(),
    [&](const double i[3], double weight)
    {
      double f[3];
      brdf->EvaluateSoft(i, o.data(), spread, f);
      albedo += weight * f[1];
    });
  return albedo;
}
}

TEST(SoftTables, WithoutHalfVectorsStayHard)
{
  vtkNew<vtkTabulatedBRDF> table;
  const double i[3] = { 0.3, 0.1, 0.8 }, o[3] = { -0.2, 0.1, 0.9 };
  double hard[3], soft[3];
  table->EvaluateSoft(i, o, 0.1, soft); // empty
  EXPECT_EQ(soft[1], 0.0);
  const int dimensions[3] = { 2, 3, 4 };
  std::vector<float> rgb;
  for (int k = 0; k < 24; ++k)
  {
    rgb.insert(rgb.end(), 3, static_cast<float>(k));
  }
  ASSERT_TRUE(table->SetVolume(
    vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::HALF_TURN, dimensions, rgb));
  table->Evaluate(i, o, hard);
  table->EvaluateSoft(i, o, 0.1, soft);
  EXPECT_GT(hard[1], 0.0);
  EXPECT_EQ(soft[1], hard[1]);
  vtkBRDFShaderInputs inputs;
  inputs.SoftLights = true;
  table->GetShaderInputs(inputs);
  EXPECT_TRUE(inputs.Terms[0].SoftSource.empty());
}

// What was made for one distribution does not serve the next.
TEST(SoftTables, FollowTheDistribution)
{
  const double i[3] = { 0.3, 0.1, 0.8 }, o[3] = { -0.2, 0.1, 0.9 };
  const auto evaluate = [&](vtkDistributionBRDF* brdf)
  {
    double soft[3];
    brdf->EvaluateSoft(i, o, 0.05, soft);
    return soft[1];
  };
  vtkNew<vtkDistributionBRDF> changed, fresh;
  changed->SetBlinnDistribution(400.0);
  const double before = evaluate(changed);
  changed->SetBlinnDistribution(4.0);
  fresh->SetBlinnDistribution(4.0);
  EXPECT_EQ(evaluate(changed), evaluate(fresh));
  EXPECT_NE(evaluate(changed), before);
}

// As measured materials have it: a sharp lobe on a wide one, each blurred for itself.
TEST(SoftTables, LobesOfADistributionAddUp)
{
  vtkNew<vtkDistributionBRDF> brdf;
  const auto evaluate = [&](double degrees)
  {
    const glm::dvec3 i =
      measuredbrdf::ReflectAbout({ 0, 0, 1 }, { std::sin(measuredbrdf::ToRadians(degrees)), 0.0,
                                                std::cos(measuredbrdf::ToRadians(degrees)) });
    const double o[3] = { 0.0, 0.0, 1.0 };
    double soft[3];
    brdf->EvaluateSoft(&i.x, o, 0.02, soft);
    return soft[1];
  };
  for (const double degrees : { 0.0, 4.0, 12.0, 30.0 })
  {
    brdf->SetBlinnDistribution(500.0);
    std::vector<float> both = brdf->GetDistribution();
    const double sharp = evaluate(degrees);
    brdf->SetBlinnDistribution(5.0);
    const double wide = evaluate(degrees);
    for (std::size_t k = 0; k < both.size(); ++k)
    {
      both[k] = 0.05f * both[k] + brdf->GetDistribution()[k];
    }
    ASSERT_TRUE(brdf->SetDistribution(256, 1, both));
    EXPECT_NEAR(evaluate(degrees) / (0.05 * sharp + wide), 1.0, 0.1) << degrees;
  }
}

TEST(SoftTables, AgreeWithTheClosedForm)
{
  // Both forms widen the same lobe; a table holds it in samples and steps of width, and the factors
  // about the lobe (1 / max(cos) of Ashikhmin and Shirley) are blurred with it.
  for (double n : { 20.0, 200.0, 2000.0 })
  {
    vtkNew<vtkBlinnPhongBRDF> phong;
    phong->SetExponent(n);
    vtkNew<vtkAshikhminShirleyBRDF> shirley;
    shirley->SetExponents(n, n);
    shirley->SetReflectance(0.5, 0.5, 0.5);
    shirley->SetDiffuse(0.2, 0.2, 0.2);
    for (vtkBRDF* lobe : std::initializer_list<vtkBRDF*>{ phong.Get(), shirley.Get() })
    {
      auto table = Tabulate(lobe, true, 36, 45, 90);
      for (double kappa : { 1e4, 1e3, 100.0, 30.0 })
      {
        const double near = GetDistance(lobe, table, 1.0 / kappa, 10.0);
        const double far = GetDistance(lobe, table, 1.0 / kappa, 50.0);
        EXPECT_LT(near, 0.06);
        EXPECT_LT(far, 0.09);
      }
    }
  }
}

TEST(SoftTables, KeepTheAlbedo)
{
  // Widening moves some of a lobe below the horizon: of the closed form as of the table.
  for (double n : { 100.0, 1000.0 })
  {
    vtkNew<vtkBlinnPhongBRDF> phong;
    phong->SetExponent(n);
    for (bool reciprocal : { true, false })
    {
      auto table = Tabulate(phong, reciprocal, 36, 45, 90);
      for (double degrees : { 10.0, 50.0 })
      {
        for (double kappa : { 1e4, 1e3, 100.0, 30.0 })
        {
          const double change =
            GetAlbedo(table, 1.0 / kappa, degrees) / GetAlbedo(table, 0.0, degrees) - 1.0;
          EXPECT_LT(std::abs(change), kappa < 100.0 ? 0.05 : 0.02);
        }
      }
    }
  }
}

TEST(SoftTables, NeverNegativeOrNaN)
{
  std::mt19937 random(5);
  const auto draw = [&random]() { return random() * 0x1p-32; };
  for (int sizes : { 1, 2, 9, 50 })
  {
    for (bool full : { false, true })
    {
      const int dimensions[3] = { sizes, sizes, sizes };
      std::vector<float> rgb(3 * static_cast<std::size_t>(sizes * sizes * sizes));
      for (float& v : rgb)
      {
        v = draw() < 0.1 ? std::numeric_limits<float>::quiet_NaN()
                         : static_cast<float>(std::exp(20.0 * draw() - 10.0) - 0.1);
      }
      vtkNew<vtkTabulatedBRDF> table;
      table->SetCosineWeighted(full);
      ASSERT_TRUE(table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE,
        full ? vtkTabulatedBRDF::FULL_TURN : vtkTabulatedBRDF::HALF_TURN, dimensions, rgb));
      for (int k = 0; k < 2000; ++k)
      {
        const double i[3] = { 2.0 * draw() - 1.0, 2.0 * draw() - 1.0, 0.02 + draw() };
        const double o[3] = { 2.0 * draw() - 1.0, 2.0 * draw() - 1.0, 0.02 + draw() };
        double f[3];
        table->EvaluateSoft(i, o, std::exp(30.0 * draw() - 15.0), f);
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_TRUE(std::isfinite(f[c]) && f[c] >= 0.0);
        }
      }
    }
  }
}

TEST(SoftTables, HardFormsHoldNoLevels)
{
  // MERL's size.
  vtkNew<vtkBlinnPhongBRDF> phong;
  for (double n : { 10.0, 300.0, 1e5 })
  {
    phong->SetExponent(n);
    auto table = Tabulate(phong, true, 180, 90, 90);
    vtkBRDFShaderInputs hard, soft;
    table->GetShaderInputs(hard);
    soft.SoftLights = true;
    table->GetShaderInputs(soft);
    ASSERT_EQ(hard.Terms[0].Textures.size(), 1u);
    ASSERT_EQ(soft.Terms[0].Textures.size(), 2u);
    EXPECT_EQ(hard.Terms[0].Textures[0].Data, soft.Terms[0].Textures[0].Data);
    EXPECT_TRUE(hard.Terms[0].SoftSource.empty());
    EXPECT_NE(hard.GetShaderKey(), soft.GetShaderKey());
    const double more =
      static_cast<double>(soft.Terms[0].Textures[1].GetBytes()) / hard.GetTextureBytes();
    EXPECT_LT(more, 0.9);
  }
}
