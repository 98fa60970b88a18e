// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The material room against closed forms, the papers' formulas and its own sampling contract.

#include "ErrorCatcher.h"
#include "HalfVector.h"
#include "TestDirections.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkAngularTableBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkBRDFResampler.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"
#include "vtkTensorTreeBRDF.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

namespace
{
using measuredbrdf::Pi;

/// An RGL-like material on small tables: a rough lobe, slightly asymmetric.
vtkSmartPointer<vtkAdaptiveWarpBRDF> MakeAdaptiveWarp()
{
  vtkAdaptiveWarpBRDF::Tables tables;
  const int thetas = 4, n = 9, r = 8;
  for (int t = 0; t < thetas; ++t)
  {
    tables.ThetaI.push_back(static_cast<float>(0.5 * Pi * t / (thetas - 1)));
  }
  tables.PhiI = { 0.0f };
  const auto fill = [](vtkAdaptiveWarpBRDF::Table& table, std::vector<int> shape,
                      const std::function<double(int, int, int)>& value)
  {
    const int height = shape[shape.size() - 2], width = shape.back();
    const int count = std::accumulate(shape.begin(), shape.end(), 1, std::multiplies<int>());
    for (int k = 0; k < count; ++k)
    {
      table.Values.push_back(
        static_cast<float>(value(k / width / height, k % width, k / width % height)));
    }
    table.Shape = std::move(shape);
  };
  // Axes of ndf, sigma, vndf: x = sqrt(theta 2/pi), y = phi.
  fill(tables.Ndf, { n, n }, [](int, int x, int) { return std::exp(-0.4 * x); });
  fill(tables.Sigma, { n, n }, [](int, int x, int) { return 1.0 - 0.07 * x; });
  fill(tables.Vndf, { 1, thetas, n, n },
    [](int s, int x, int y)
    { return std::pow(x / 8.0, 3.0) * std::exp(-0.3 * x) * (1.0 + 0.1 * s * (y % 3)); });
  fill(
    tables.Luminance, { 1, thetas, r, r }, [](int, int x, int y) { return 1.0 + 0.05 * (x + y); });
  fill(tables.Rgb, { 1, thetas, 3, r, r },
    [](int s, int x, int y) { return 0.2 + 0.1 * (s % 3) + 0.03 * x + 0.01 * y; });
  auto brdf = vtkSmartPointer<vtkAdaptiveWarpBRDF>::New();
  EXPECT_EQ(brdf->SetTables(tables), "");
  return brdf;
}

/// Uneven colors, some of them negative.
std::vector<float> MakeUnevenColors(int count)
{
  std::vector<float> rgb;
  for (int k = 0; k < count; ++k)
  {
    const float value = k % 19 == 0 ? -0.01f : 0.1f + 0.004f * static_cast<float>(k * 7 % 23);
    rgb.insert(rgb.end(), { value, 0.5f * value, 0.1f });
  }
  return rgb;
}

/// A constant and a term towards the tangent, or (isotropic) away from the viewer's azimuth, that
/// rings below 0; both cosines carried.
vtkSmartPointer<vtkBasisBRDF> MakeBasis(int basis, int nPhi)
{
  const double zone[2] = { 5.0, 80.0 };
  const int nTheta = 6, functions = 9;
  std::vector<float> rgb;
  for (int k = 0; k < functions; ++k)
  {
    for (int v = 0; v < nTheta * nPhi; ++v)
    {
      const float c = k == 0 ? 1.0f : (k == 3 ? -0.9f : (k == 6 ? 0.4f : 0.0f));
      rgb.insert(rgb.end(), { c, 0.5f * c, 0.1f * c });
    }
  }
  auto brdf = vtkSmartPointer<vtkBasisBRDF>::New();
  EXPECT_EQ(brdf->SetCoefficients(basis, 2, zone, zone, nTheta, nPhi, rgb), "");
  brdf->IncidentCosineOn();
  brdf->OutgoingCosineOn();
  return brdf;
}

/// One of each, with a name for messages.
std::vector<std::pair<std::string, vtkSmartPointer<vtkBRDF>>> MakeAll()
{
  std::vector<std::pair<std::string, vtkSmartPointer<vtkBRDF>>> all;
  auto lambert = vtkSmartPointer<vtkLambertBRDF>::New();
  lambert->SetAlbedo(0.7, 0.4, 0.1);
  all.emplace_back("Lambert", lambert);
  auto phong = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  phong->SetExponent(30.0);
  all.emplace_back("Blinn-Phong", phong);
  auto ashikhmin = vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
  ashikhmin->SetReflectance(0.3, 0.2, 0.1);
  ashikhmin->SetDiffuse(0.4, 0.3, 0.2);
  ashikhmin->SetExponents(10.0, 120.0);
  all.emplace_back("Ashikhmin-Shirley", ashikhmin);
  all.emplace_back("D-BRDF", vtkSmartPointer<vtkDistributionBRDF>::New());
  for (const bool reciprocal : { false, true })
  {
    vtkNew<vtkBRDFResampler> resampler;
    phong->SetExponent(30.0);
    resampler->SetInput(phong);
    resampler->SetReciprocal(reciprocal);
    resampler->ResampleTo(16, 24, 48);
    all.emplace_back(reciprocal ? "table, reciprocal" : "table", resampler->GetOutput());
  }
  auto anisotropic = vtkSmartPointer<vtkTabulatedBRDF>::New();
  const int size[4] = { 16, 16, 24, 32 };
  anisotropic->Resample(ashikhmin, vtkTabulatedBRDF::FULL_TURN, size);
  all.emplace_back("anisotropic table", anisotropic);
  all.emplace_back("adaptive warp", MakeAdaptiveWarp());
  auto nodes = vtkSmartPointer<vtkAngularTableBRDF>::New();
  EXPECT_EQ(nodes->SetValues({ { 0.0f, 30.0f, 70.0f }, { 0.0f, 90.0f, 180.0f, 270.0f } },
              { { 10.0f, 60.0f }, { 5.0f, 100.0f, 300.0f } }, MakeUnevenColors(12 * 6)),
    "");
  all.emplace_back("angular table", nodes);
  auto patches = vtkSmartPointer<vtkAngleBasisBRDF>::New();
  EXPECT_EQ(patches->SetMatrix({ { 25.0f, 60.0f, 90.0f }, { 1, 4, 8 } },
              { { 30.0f, 90.0f }, { 1, 6 } }, MakeUnevenColors(13 * 7)),
    "");
  all.emplace_back("angle basis", patches);
  auto tree = vtkSmartPointer<vtkTensorTreeBRDF>::New();
  EXPECT_EQ(tree->SetTree({ 3, { { 2, 0 }, { 1, 8 }, { 0, 0 } }, { 0, 1, 1, 0, 1, 0, 0, 1 },
              { 0.1f, 0.2f, 0.3f, 0.4f, 0.1f, -0.1f, 0.3f, 0.2f, 0.15f } }),
    "");
  all.emplace_back("tensor tree", tree);
  all.emplace_back("zonal basis", MakeBasis(vtkBasisBRDF::ZONAL, 1));
  all.emplace_back("Legendre x Fourier basis", MakeBasis(vtkBasisBRDF::LEGENDRE_FOURIER, 4));
  all.emplace_back("harmonics", MakeBasis(vtkBasisBRDF::SPHERICAL_HARMONICS, 3));
  auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(lambert);
  sum->AddTerm(ashikhmin);
  all.emplace_back("sum", sum);
  return all;
}
}

// Sampling: the pdf's integral is the share of draws above the horizon, draws follow it
// (chi-square over 8 x 16 bins), and E[f cos / pdf] is the albedo.
TEST(Sampling, FollowsItsPdf)
{
  for (const auto& [name, brdf] : MakeAll())
  {
    brdf->Prepare();
    for (const double theta : { 0.2, 1.0 })
    {
      const glm::dvec3 o = FromAngles(theta, 0.7);
      const int count = 100000, rows = 8, columns = 16;
      std::mt19937 random(11);
      std::uniform_real_distribution<double> uniform(0.0, 1.0);
      std::vector<double> observed(rows * columns, 0.0), expected(rows * columns, 0.0);
      glm::dvec3 estimate(0.0);
      int above = 0;
      for (int k = 0; k < count; ++k)
      {
        glm::dvec3 i;
        if (!brdf->Sample(&o.x, uniform(random), uniform(random), &i.x))
        {
          EXPECT_EQ(i, glm::dvec3(0.0));
          continue;
        }
        ++above;
        ASSERT_NEAR(glm::length(i), 1.0, 1e-9) << name;
        const double pdf = brdf->Pdf(&i.x, &o.x);
        ASSERT_GT(pdf, 0.0) << name;
        estimate += Evaluate(brdf, i, o) * (i.z / pdf / count);
        const int row = std::min(static_cast<int>(i.z * rows), rows - 1);
        const double phi = std::atan2(i.y, i.x) / (2.0 * Pi) + 0.5;
        const int column = std::min(static_cast<int>(phi * columns), columns - 1);
        observed[row * columns + column] += 1.0;
      }
      const int fine = 24; // midpoint steps per bin side
      double mass = 0.0;
      for (int row = 0; row < rows * fine; ++row)
      {
        for (int column = 0; column < columns * fine; ++column)
        {
          const double z = (row + 0.5) / (rows * fine);
          const double s = std::sqrt(1.0 - z * z);
          const double phi = 2.0 * Pi * ((column + 0.5) / (columns * fine) - 0.5);
          const glm::dvec3 i(s * std::cos(phi), s * std::sin(phi), z);
          const double share = brdf->Pdf(&i.x, &o.x) * 2.0 * Pi / (rows * columns * fine * fine);
          expected[row / fine * columns + column / fine] += count * share;
          mass += share;
        }
      }
      EXPECT_NEAR(mass, static_cast<double>(above) / count, 5e-3) << name << " at " << theta;
      double chi2 = 0.0;
      int bins = 0;
      for (std::size_t k = 0; k < observed.size(); ++k)
      {
        if (expected[k] > 30.0)
        {
          // 1 % of slack for the midpoint rule where the density has kinks.
          const double d = std::max(std::abs(observed[k] - expected[k]) - 0.01 * expected[k], 0.0);
          chi2 += d * d / expected[k];
          ++bins;
        }
      }
      EXPECT_LT(chi2, bins + 5.0 * std::sqrt(2.0 * bins)) << name << " at " << theta;

      glm::dvec3 albedo;
      brdf->GetDirectionalAlbedo(&o.x, &albedo.x);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(estimate[c], albedo[c], 0.02 * albedo[c] + 1e-3) << name << " at " << theta;
      }
    }
  }
}

TEST(Evaluate, KeepsItsPromises)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const auto& [name, brdf] : MakeAll())
  {
    for (int k = 0; k < 2000; ++k)
    {
      const glm::dvec3 i =
        glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
      const glm::dvec3 o =
        glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
      const glm::dvec3 f = Evaluate(brdf, i, o);
      const glm::dvec3 swapped = Evaluate(brdf, o, i);
      for (int c = 0; c < 3; ++c)
      {
        ASSERT_TRUE(std::isfinite(f[c]) && f[c] >= 0.0) << name;
        if (i.z <= 0.0 || o.z <= 0.0)
        {
          ASSERT_EQ(f[c], 0.0) << name;
        }
        if (brdf->IsReciprocal())
        {
          ASSERT_NEAR(f[c], swapped[c], 1e-9 * (f[c] + 1.0)) << name;
        }
      }
      if (brdf->IsIsotropic())
      {
        const double a = 1.234;
        const auto turn = [a](const glm::dvec3& d)
        {
          return glm::dvec3(
            std::cos(a) * d.x - std::sin(a) * d.y, std::sin(a) * d.x + std::cos(a) * d.y, d.z);
        };
        ASSERT_NEAR(Evaluate(brdf, turn(i), turn(o)).x, f.x, 1e-6 * (f.x + 1.0)) << name;
      }
      // Lengths other than 1 do no harm.
      ASSERT_NEAR(Evaluate(brdf, 3.0 * i, 0.5 * o).x, f.x, 1e-9 * (f.x + 1.0)) << name;
    }
    const glm::dvec3 bad(std::nan(""), 0.0, 1.0), zero(0.0), up(0.0, 0.0, 1.0);
    EXPECT_EQ(Evaluate(brdf, bad, up), zero) << name;
    EXPECT_EQ(Evaluate(brdf, zero, up), zero) << name;
    std::ostringstream text;
    brdf->Print(text);
    EXPECT_NE(text.str().find("ResamplingTolerance"), std::string::npos);
    EXPECT_TRUE(name != "Blinn-Phong" || text.str().find("Exponent: 30") != std::string::npos);
    EXPECT_TRUE(name != "sum" || text.str().find("Term: vtkLambertBRDF") != std::string::npos);
  }
}

TEST(Lambert, ClosedForm)
{
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(0.5, 0.25, -1.0);
  const glm::dvec3 f = Evaluate(brdf, FromAngles(0.3, 0.0), FromAngles(1.2, 2.0));
  EXPECT_NEAR(f.x, 0.5 / Pi, 1e-15);
  EXPECT_NEAR(f.y, 0.25 / Pi, 1e-15);
  EXPECT_EQ(f.z, 0.0);
  ErrorCatcher errors(brdf);
  brdf->SetAlbedo(std::nan(""), 0.75, 1e300); // refused
  EXPECT_EQ(errors.Take(), 1);
  glm::dvec3 albedo;
  const glm::dvec3 up(0.0, 0.0, 1.0);
  brdf->GetDirectionalAlbedo(&up.x, &albedo.x);
  EXPECT_NEAR(albedo.x, 0.5, 1e-15);
  EXPECT_NEAR(albedo.y, 0.25, 1e-15);
}

TEST(BlinnPhong, PaperFormula)
{
  vtkNew<vtkBlinnPhongBRDF> brdf;
  brdf->SetSpecular(0.2, 0.1, 0.05);
  for (const double n : { 0.0, 1.0, 43.6, 31600.0 })
  {
    brdf->SetExponent(n);
    const glm::dvec3 i = FromAngles(0.5, 0.0), o = FromAngles(0.49, Pi);
    const double cosine = glm::normalize(i + o).z;
    EXPECT_NEAR(
      Evaluate(brdf, i, o).x / (0.2 * (n + 2.0) / (2.0 * Pi) * std::pow(cosine, n)), 1.0, 1e-8)
      << n;
  }
}

TEST(AshikhminShirley, PaperFormula)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetSpecularScale(0.9, 0.8, 0.7);
  brdf->SetReflectance(0.05, 0.3, 0.9);
  brdf->SetDiffuse(0.5, 0.4, 0.3);
  brdf->SetExponents(10.0, 400.0);
  const glm::dvec3 i = FromAngles(0.8, 0.3), o = FromAngles(0.6, 3.0);
  const glm::dvec3 h = glm::normalize(i + o);
  const double hk = glm::dot(h, i);
  const double exponent = (10.0 * h.x * h.x + 400.0 * h.y * h.y) / (1.0 - h.z * h.z);
  const double rs[3] = { 0.05, 0.3, 0.9 }, rd[3] = { 0.5, 0.4, 0.3 }, scale[3] = { 0.9, 0.8, 0.7 };
  for (int c = 0; c < 3; ++c)
  {
    const double fresnel = rs[c] + (1.0 - rs[c]) * std::pow(1.0 - hk, 5.0);
    const double specular = std::sqrt(11.0 * 401.0) / (8.0 * Pi) * std::pow(h.z, exponent) /
                            (hk * std::max(i.z, o.z)) * fresnel;
    const double diffuse = 28.0 * rd[c] / (23.0 * Pi) * (1.0 - rs[c]) *
                           (1.0 - std::pow(1.0 - i.z / 2.0, 5.0)) *
                           (1.0 - std::pow(1.0 - o.z / 2.0, 5.0));
    EXPECT_NEAR(Evaluate(brdf, i, o)[c], scale[c] * specular + diffuse, 1e-10);
  }
  // Dielectric at normal incidence: ((n-1)/(n+1))^2.
  brdf->SetFresnelModelToDielectric();
  brdf->SetIndexOfRefraction(1.5);
  brdf->SetDiffuse(0.0, 0.0, 0.0);
  brdf->SetExponents(7.0, 7.0);
  const glm::dvec3 up(0.0, 0.0, 1.0);
  EXPECT_NEAR(Evaluate(brdf, up, up).x, 0.9 * 8.0 / (8.0 * Pi) * 0.04, 1e-12);
  // Brewster's angle: half the s-polarized reflectance, ((n^2-1)/(n^2+1))^2 / 2.
  const double brewster = std::atan(1.5);
  const glm::dvec3 a = FromAngles(brewster, 0.0), b = FromAngles(brewster, Pi);
  const double r = (1.5 * 1.5 - 1.0) / (1.5 * 1.5 + 1.0);
  EXPECT_NEAR(Evaluate(brdf, a, b).x, 0.9 * 8.0 / (8.0 * Pi) / (a.z * a.z) * 0.5 * r * r, 1e-12);
}

// p from retro-reflection: f(theta) (2 cos - cos^2) = p(theta) F(1) / 4 (theory of the D-BRDF).
TEST(Distribution, RetroReflectionInvertsToP)
{
  vtkNew<vtkDistributionBRDF> brdf;
  brdf->SetBlinnDistribution(20.0);
  const double f0[3] = { 0.2, 0.5, 1.0 };
  brdf->SetSchlickFresnel(f0);
  for (const double theta : { 0.1, 0.4, 0.9 })
  {
    const glm::dvec3 d = FromAngles(theta, 1.0);
    const double p = 22.0 / (2.0 * Pi) * std::pow(d.z, 20.0);
    const glm::dvec3 f = Evaluate(brdf, d, d);
    EXPECT_NEAR(f.y * 4.0 * (2.0 * d.z - d.z * d.z) / 0.5, p, 2e-3 * p + 1e-6) << theta;
  }
  // Sharp-lobe albedo with F = 1: cos/(2 - cos).
  brdf->SetBlinnDistribution(2000.0);
  const double one[3] = { 1.0, 1.0, 1.0 };
  brdf->SetSchlickFresnel(one);
  for (const double theta : { 0.0, Pi / 6.0, Pi / 3.0 })
  {
    const glm::dvec3 o = FromAngles(theta, 0.0);
    glm::dvec3 albedo;
    brdf->GetDirectionalAlbedo(&o.x, &albedo.x);
    EXPECT_NEAR(albedo.x, o.z / (2.0 - o.z), 0.02) << theta;
  }
  EXPECT_FALSE(brdf->SetDistribution(4, 1, std::vector<float>(11, 1.0f)));
  EXPECT_FALSE(brdf->SetDistribution(1, 1, { 1.0f, -1.0f, 1.0f }));
  EXPECT_FALSE(brdf->SetFresnel(1, { 1.0f, std::numeric_limits<float>::quiet_NaN(), 1.0f }));
  EXPECT_EQ(brdf->GetNumberOfThetaSamples(), 256);
}

// A table of a function that is linear in the axes is interpolated exactly; cells are hit at their
// centers; invalid cells are skipped with the other corners' weights renormalized.
TEST(Tabulated, InterpolatesTrilinearly)
{
  const int dimensions[3] = { 12, 10, 8 };
  constexpr int count = 12 * 10 * 8;
  for (const int parameterization : { 0, 1 })
  {
    vtkNew<vtkTabulatedBRDF> table;
    const auto isAbove = [&](int range, int cell, glm::dvec3& i, glm::dvec3& o)
    {
      return vtkTabulatedBRDF::GetCellDirections(
        parameterization, range, dimensions, cell % 12, cell / 12 % 10, cell / 120, &i.x, &o.x);
    };
    std::vector<float> rgb, valid;
    for (int cell = 0; cell < count; ++cell)
    {
      rgb.insert(rgb.end(), { 1.0f + 0.25f * static_cast<float>(cell / 120),
                              1.0f + 0.5f * static_cast<float>(cell / 12 % 10),
                              1.0f + 0.125f * static_cast<float>(cell % 12) });
      // Every other cell along z is invalid: what remains is exact where corners exist.
      const bool isValid = cell / 120 % 2 != 0;
      valid.insert(
        valid.end(), { 1.0f, isValid ? 2.0f : std::numeric_limits<float>::quiet_NaN(), 7.0f });
    }
    for (const int range : { vtkTabulatedBRDF::HALF_TURN, vtkTabulatedBRDF::FULL_TURN })
    {
      ASSERT_TRUE(table->SetVolume(parameterization, range, dimensions, rgb));
      int above = 0;
      for (int cell = 0; cell < count; ++cell)
      {
        glm::dvec3 i, o;
        if (isAbove(range, cell, i, o))
        {
          ++above;
          const glm::dvec3 f = Evaluate(table, i, o);
          EXPECT_NEAR(f.x, rgb[3 * static_cast<std::size_t>(cell)], 1e-6);
          EXPECT_NEAR(f.y, rgb[3 * static_cast<std::size_t>(cell) + 1], 1e-6);
          EXPECT_NEAR(f.z, rgb[3 * static_cast<std::size_t>(cell) + 2], 1e-5);
          table->CosineWeightedOn();
          EXPECT_NEAR(Evaluate(table, i, o).x * o.z, f.x, 1e-6);
          table->CosineWeightedOff();
        }
      }
      EXPECT_GT(above, count / 3);
    }
    ASSERT_TRUE(table->SetVolume(parameterization, vtkTabulatedBRDF::HALF_TURN, dimensions, valid));
    EXPECT_EQ(table->GetNumberOfInvalidCells(), 480);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int k = 0; k < 200; ++k)
    {
      const glm::dvec3 f = Evaluate(table, FromAngles(1.2 * uniform(random), 6.0 * uniform(random)),
        FromAngles(1.2 * uniform(random), 6.0 * uniform(random)));
      EXPECT_TRUE(f.z == 0.0 || std::abs(f.z - 7.0) < 1e-5) << f.z; // a constant stays one
    }
  }
}

TEST(Tabulated, RefusesAndKeeps)
{
  vtkNew<vtkTabulatedBRDF> table;
  const int good[3] = { 2, 2, 2 }, negative[3] = { 2, -2, 2 }, huge[3] = { 2048, 2048, 2048 };
  ASSERT_TRUE(table->SetVolume(0, 0, good, std::vector<float>(24, 1.0f)));
  EXPECT_FALSE(table->SetVolume(0, 0, good, std::vector<float>(23, 1.0f)));
  EXPECT_FALSE(table->SetVolume(0, 0, negative, std::vector<float>(24, 1.0f)));
  EXPECT_FALSE(table->SetVolume(0, 0, huge, std::vector<float>(24, 1.0f)));
  EXPECT_FALSE(table->SetVolume(2, 0, good, std::vector<float>(24, 1.0f)));
  EXPECT_EQ(table->GetVolume().size(), 24u);
  const int four[4] = { 2, 1, 2, 1 }, empty[4] = { 2, 0, 2, 1 }, wide[4] = { 2, 64, 64, 1 };
  ASSERT_TRUE(table->SetVolume(0, four, std::vector<float>(12, 0.25f)));
  ErrorCatcher errors(table);
  std::vector<float> bad(12, 0.25f);
  EXPECT_FALSE(table->SetVolume(0, empty, {}));
  EXPECT_FALSE(table->SetVolume(0, wide, std::vector<float>(3 * 2 * 64 * 64, 1.0f)));
  EXPECT_FALSE(table->SetVolume(2, four, bad));
  bad.back() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(table->SetVolume(0, four, bad));
  bad.pop_back();
  EXPECT_FALSE(table->SetVolume(0, four, bad));
  EXPECT_FALSE(table->Resample(nullptr, 0, four));
  EXPECT_FALSE(table->Resample(table, 0, empty));
  EXPECT_EQ(errors.Take(), 7);
  EXPECT_EQ(Evaluate(table, { 0.0, 0.0, 1.0 }, { 0.0, 0.0, 1.0 }), glm::dvec3(0.25));
}

TEST(Tabulated, PrecisionFollowsTheTolerance)
{
  vtkNew<vtkTabulatedBRDF> table;
  const int dimensions[3] = { 2, 2, 2 };
  std::vector<float> rgb;
  for (int k = 0; k < 8; ++k)
  {
    const float value = std::ldexp(1.37f, -k);
    rgb.insert(rgb.end(), { value, 0.3f * value, 0.0f });
  }
  rgb[0] = 3e5f; // above what the format holds: scaled, not clamped
  ASSERT_TRUE(table->SetVolume(0, 0, dimensions, rgb));
  const auto get = [&](double tolerance)
  {
    table->SetResamplingTolerance(tolerance);
    vtkBRDFShaderInputs inputs;
    table->GetShaderInputs(inputs);
    return inputs;
  };
  EXPECT_FALSE(get(1e-4).Terms[0].Textures[0].HalfFloat);
  const vtkBRDFShaderInputs half = get(0.01);
  EXPECT_TRUE(half.Terms[0].Textures[0].HalfFloat);
  for (const float value : half.Terms[0].Textures[0].Data)
  {
    EXPECT_LE(std::abs(value), 65504.0f); // scaled, not clamped
  }
  table->SetPrecision(vtkTabulatedBRDF::SHARED_EXPONENT);
  const vtkBRDFShaderInputs shared = get(0.01);
  const vtkBRDFShaderInputs::Texture& texture = shared.Terms[0].Textures[0];
  ASSERT_EQ(texture.SharedExponents.size(), 8u);
  EXPECT_TRUE(texture.Data.empty());
  EXPECT_FALSE(texture.HalfFloat);
  EXPECT_EQ(shared.QuantizationError, 1.0 / 512.0);
  EXPECT_EQ(3 * shared.GetTextureBytes(), 2 * half.GetTextureBytes());
  const float scale = shared.Terms[0].Uniforms[0].Values[0];
  for (std::size_t k = 0; k < 8; ++k)
  {
    const float largest = std::max(rgb[3 * k], rgb[3 * k + 1]);
    const std::uint32_t texel = texture.SharedExponents[k];
    for (std::size_t c = 0; c < 3; ++c)
    {
      const float value = scale * std::ldexp(static_cast<float>(texel >> (9 * c) & 511u),
                                    static_cast<int>(texel >> 27) - 24);
      EXPECT_NEAR(value, rgb[3 * k + c], largest / 512.0f) << k << " " << c;
    }
  }

  // 16 or 32 bits where it is too coarse, or cannot hold the values.
  EXPECT_TRUE(get(0.007).Terms[0].Textures[0].HalfFloat);
  EXPECT_EQ(get(1e-4).GetTextureBytes(), 2 * half.GetTextureBytes());
  for (const float odd : { -0.1f, std::numeric_limits<float>::quiet_NaN() })
  {
    rgb[5] = odd;
    ASSERT_TRUE(table->SetVolume(0, 0, dimensions, rgb));
    const vtkBRDFShaderInputs other = get(0.01);
    EXPECT_TRUE(other.Terms[0].Textures[0].SharedExponents.empty()) << odd;
    EXPECT_TRUE(other.Terms[0].Textures[0].HalfFloat) << odd;
  }
}

TEST(AdaptiveWarp, RefusesBadTables)
{
  auto brdf = MakeAdaptiveWarp();
  const vtkAdaptiveWarpBRDF::Tables good = brdf->GetTables();
  const auto expectRefusal =
    [&](const char* word, const std::function<void(vtkAdaptiveWarpBRDF::Tables&)>& spoil)
  {
    vtkAdaptiveWarpBRDF::Tables tables = good;
    spoil(tables);
    const std::string problem = brdf->SetTables(tables);
    EXPECT_NE(problem.find(word), std::string::npos) << problem;
    EXPECT_EQ(brdf->GetTables().Rgb.Values, good.Rgb.Values);
  };
  expectRefusal("theta_i", [](auto& t) { t.ThetaI[1] = t.ThetaI[0] - 0.1f; });
  expectRefusal("ndf", [](auto& t) { t.Ndf.Values.pop_back(); });
  expectRefusal("ndf", [](auto& t) { t.Ndf.Shape = { 81, 1 }; });
  expectRefusal("rgb", [](auto& t) { t.Rgb.Shape[2] = 4; });
  expectRefusal("phi_i", [](auto& t) { t.PhiI.clear(); });
}

// Where no view is shaded nothing can be compared: not a number, never "no error".
TEST(Resampler, ZonesNextToTheHorizon)
{
  vtkNew<vtkLambertBRDF> gray, white;
  gray->SetAlbedo(0.5, 0.5, 0.5);
  white->SetAlbedo(1.0, 1.0, 1.0);
  const double low[2] = { 88.0, 90.0 }, lower[2] = { 88.5, 90.0 }, high[2] = { 0.0, 57.0 };
  EXPECT_NEAR(vtkBRDFResampler::GetZoneRelativeL2Error(white, gray, low, low, 1 << 10), 0.5, 1e-9);
  vtkObject::GlobalWarningDisplayOff();
  EXPECT_TRUE(
    std::isnan(vtkBRDFResampler::GetZoneRelativeL2Error(white, gray, lower, high, 1 << 10)));
  EXPECT_TRUE(
    std::isnan(vtkBRDFResampler::GetZoneRelativeL2Error(white, gray, high, lower, 1 << 10)));
  vtkObject::GlobalWarningDisplayOn();
}

TEST(Sum, HoldsSoManyTermsOnly)
{
  vtkNew<vtkSumBRDF> sum;
  vtkNew<vtkLambertBRDF> lambert;
  ErrorCatcher errors(sum);
  for (int k = 0; k < vtkSumBRDF::MaximumNumberOfTerms; ++k)
  {
    sum->AddTerm(lambert);
  }
  EXPECT_EQ(errors.Take(), 0);
  sum->AddTerm(lambert);
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_NE(errors.GetText().find("64 terms"), std::string::npos) << errors.GetText();
  EXPECT_EQ(sum->GetNumberOfTerms(), 64);
}

TEST(Sum, GuardsItsTerms)
{
  vtkNew<vtkSumBRDF> a, b;
  vtkNew<vtkLambertBRDF> lambert;
  a->AddTerm(lambert);
  b->AddTerm(a);
  vtkObject::GlobalWarningDisplayOff();
  a->AddTerm(b);
  a->AddTerm(a);
  a->AddTerm(nullptr);
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(a->GetNumberOfTerms(), 1);
  const vtkMTimeType before = b->GetMTime();
  lambert->SetAlbedo(0.1, 0.1, 0.1);
  EXPECT_GT(b->GetMTime(), before); // a change deep inside is seen
}

// Finer tables come closer; what Resample reports is what an independent comparison measures; a
// reciprocal table loses the asymmetry and says so.
TEST(Resampler, ErrorFallsAndIsReported)
{
  vtkNew<vtkBlinnPhongBRDF> brdf;
  brdf->SetExponent(60.0);
  vtkNew<vtkBRDFResampler> resampler;
  resampler->SetInput(brdf);
  double last = 1.0;
  for (const int n : { 8, 16, 32, 64 })
  {
    resampler->ResampleTo(n, n, 2 * n);
    const double error = resampler->GetOutput()->GetResamplingError();
    EXPECT_LT(error, 0.6 * last);
    last = error;
  }
  resampler->SetTolerance(0.02);
  EXPECT_TRUE(resampler->Resample());
  const double reported = resampler->GetOutput()->GetResamplingError();
  EXPECT_LE(reported, 0.02);
  EXPECT_NEAR(
    vtkBRDFResampler::GetRelativeL2Error(brdf, resampler->GetOutput()), reported, 0.5 * reported);
  EXPECT_EQ(vtkBRDFResampler::GetRelativeL2Error(brdf, brdf), 0.0);

  // Arguments out of range: an error, nothing lost.
  vtkObject::GlobalWarningDisplayOff();
  const double before = resampler->GetOutput()->GetResamplingError();
  EXPECT_FALSE(resampler->ResampleTo(-1, 4, 4));
  EXPECT_FALSE(resampler->ResampleTo(1, 1, 4000));
  EXPECT_EQ(resampler->GetOutput()->GetResamplingError(), before);
  EXPECT_TRUE(std::isnan(vtkBRDFResampler::GetRelativeL2Error(nullptr, nullptr)));
  EXPECT_TRUE(std::isnan(vtkBRDFResampler::GetRelativeL2Error(brdf, brdf, -1)));
  vtkObject::GlobalWarningDisplayOn();

  auto warp = MakeAdaptiveWarp();
  resampler->SetInput(warp);
  resampler->ResampleTo(32, 32, 32);
  const double full = resampler->GetOutput()->GetResamplingError();
  resampler->ReciprocalOn();
  resampler->ResampleTo(16, 32, 32);
  EXPECT_GT(resampler->GetOutput()->GetResamplingError(), full);
  EXPECT_TRUE(resampler->GetOutput()->IsReciprocal());
}

// Soft light is known to the table that the graphics card evaluates: both draw the same.
TEST(AdaptiveWarp, IsShadedWithItsRenderableUnderSoftLight)
{
  auto warp = MakeAdaptiveWarp();
  vtkNew<vtkLightSet> lights;
  const double direction[3] = { 0.3, 0.2, 0.9 }, irradiance[3] = { 1.0, 2.0, 3.0 };
  lights->AddLight(direction, irradiance, 0.0, 10.0);
  vtkNew<vtkDoubleArray> normal;
  normal->SetNumberOfComponents(3);
  normal->InsertNextTuple3(0.0, 0.0, 1.0);
  vtkNew<vtkLightSetRadianceIntegrator> integrator;
  integrator->SetLightSet(lights);
  const auto integrate = [&](vtkBRDF* brdf, bool soft)
  {
    vtkNew<vtkDoubleArray> radiance;
    integrator->SetBRDF(brdf);
    integrator->SetSoftLights(soft);
    EXPECT_TRUE(integrator->Integrate(normal, normal, radiance));
    return radiance->GetComponent(0, 1);
  };
  EXPECT_GT(integrate(warp, true), 0.0);
  EXPECT_EQ(integrate(warp, true), integrate(warp->GetRenderable(), true));
  EXPECT_NE(integrate(warp, true), integrate(warp->GetRenderable(), false));
  EXPECT_NE(integrate(warp, false), integrate(warp->GetRenderable(), false));
}

// The error that a resampled real material states, against plain Monte Carlo with other numbers.
TEST(Resampler, StatesTheTruthOnRealFiles)
{
  const std::string folder = std::string(MEASUREDBRDF_SHARED_DATA) + "/materials/rgl/";
  for (const char* name : { "acrylic_felt_pink", "satin_purple", "vch_ultra_pink" })
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(folder + name + "_rgb.bsdf");
    if (!std::ifstream(reader->GetFileName()))
    {
      GTEST_SKIP() << "no measured files beside the checkout";
    }
    ASSERT_TRUE(reader->Read());
    vtkBRDF* brdf = reader->GetBRDF();
    vtkObject::GlobalWarningDisplayOff(); // satin_purple stays above the tolerance, and says so
    auto* table = vtkTabulatedBRDF::SafeDownCast(brdf->GetRenderable());
    vtkObject::GlobalWarningDisplayOn();
    ASSERT_TRUE(table);
    std::mt19937 random(17);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    double difference = 0.0, total = 0.0;
    for (int k = 0; k < 50000; ++k)
    {
      const double z = 0.02 + 0.98 * uniform(random);
      const glm::dvec3 o = FromAngles(std::acos(z), 2.0 * Pi * uniform(random));
      glm::dvec3 i = FromAngles(std::acos(std::sqrt(uniform(random))), 2.0 * Pi * uniform(random));
      if (uniform(random) < 0.5 && !brdf->Sample(&o.x, uniform(random), uniform(random), &i.x))
      {
        continue;
      }
      const double weight = i.z * o.z / (0.5 * (brdf->Pdf(&i.x, &o.x) + i.z / Pi));
      const glm::dvec3 f = Evaluate(brdf, i, o);
      const glm::dvec3 d = Evaluate(table, i, o) - f;
      difference += weight * glm::dot(d, d);
      total += weight * glm::dot(f, f);
    }
    const double error = std::sqrt(difference / total);
    EXPECT_NEAR(table->GetResamplingError(), error, 0.3 * error) << name;
  }
}
