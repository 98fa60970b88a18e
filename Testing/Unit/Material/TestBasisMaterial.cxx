// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The bases against closed forms and a quadrature of their own; vtkBasisBRDF against plain sums.
#include "BasisFunctions.h"
#include "TestBasisHelpers.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkNew.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

using namespace testbasis;

namespace
{
constexpr double Hemisphere[2] = { 0.0, 90.0 };

/// Largest entry of the Gram matrix minus the identity, over the basis's domain.
double GetOrthonormalityError(int basis, int order, const double zone[2])
{
  const double domain[2] = { basis >= vtkBasisBRDF::ZONAL ? zone[0] : 0.0,
    basis >= vtkBasisBRDF::ZONAL ? zone[1]
                                 : (basis == vtkBasisBRDF::SPHERICAL_HARMONICS ? 180.0 : 90.0) };
  const int count = (order + 1) * (order + 1);
  const int nodes = 2 * order + 1; // products have degree 2 order at most
  Eigen::MatrixXd rows(nodes * (nodes + 1), count);
  Eigen::Index row = 0;
  ForZone(domain, nodes, nodes + 1,
    [&](const glm::dvec3& d, double weight)
    {
      const std::vector<double> values = vtkBasisBRDF::EvaluateBasis(basis, order, zone, &d.x);
      for (int k = 0; k < count; ++k)
      {
        rows(row, k) = std::sqrt(weight) * values[static_cast<std::size_t>(k)];
      }
      ++row;
    });
  const Eigen::MatrixXd gram = rows.transpose() * rows;
  return (gram - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff();
}

/// A half float's neighbor of v.
float RoundToHalf(float v)
{
  int exponent = 0;
  std::frexp(v, &exponent);
  const float unit = std::ldexp(1.0f, std::max(exponent, -13) - 11);
  return std::nearbyint(v / unit) * unit;
}
}

//------------------------------------------------------------------------------
// Which makes it Gauss's rule: there is no other of so high a degree.
TEST(GaussLegendre, ExactToItsDegree)
{
  for (const int n : { 1, 2, 3, 7, 48, 96, 1024 })
  {
    const auto rule = measuredbrdf::GaussLegendre(n);
    const auto integrate = [&rule](int power)
    {
      double sum = 0.0;
      for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
      {
        sum += rule.Weights[k] * std::pow(rule.Nodes[k], power);
      }
      return sum;
    };
    for (int power = 0; power <= std::min(2 * n - 1, 60); ++power)
    {
      EXPECT_NEAR(integrate(power), power % 2 == 0 ? 2.0 / (power + 1.0) : 0.0, 1e-12)
        << n << " nodes, power " << power;
    }
    if (n < 5)
    {
      EXPECT_GT(std::abs(integrate(2 * n) - 2.0 / (2.0 * n + 1.0)), 1e-3) << n;
    }
  }
}

//------------------------------------------------------------------------------
TEST(BasisFunctions, Orthonormal)
{
  const double other[2] = { 30.0, 62.5 };
  for (const int order : { 1, 6, 12, 20 })
  {
    for (int basis = 0; basis < 4; ++basis)
    {
      for (const double* zone : { Zone, other })
      {
        if (basis < vtkBasisBRDF::ZONAL && zone == other)
        {
          continue; // these have no zone
        }
        const double error = GetOrthonormalityError(basis, order, zone);
        EXPECT_LT(error, 1e-10) << vtkBasisBRDF::GetBasisName(basis) << ", order " << order;
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(BasisFunctions, RealHarmonicsInClosedForm)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int sample = 0; sample < 100; ++sample)
  {
    const glm::dvec3 d =
      glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
    const std::vector<double> y = vtkBasisBRDF::EvaluateBasis(0, 3, Zone, &d.x);
    ASSERT_EQ(y.size(), 16u);
    const double expected[] = { 0.5 * std::sqrt(1.0 / Pi), //
      std::sqrt(0.75 / Pi) * d.y, std::sqrt(0.75 / Pi) * d.z, std::sqrt(0.75 / Pi) * d.x,
      0.5 * std::sqrt(15.0 / Pi) * d.x * d.y, 0.5 * std::sqrt(15.0 / Pi) * d.y * d.z,
      0.25 * std::sqrt(5.0 / Pi) * (3.0 * d.z * d.z - 1.0), 0.5 * std::sqrt(15.0 / Pi) * d.x * d.z,
      0.25 * std::sqrt(15.0 / Pi) * (d.x * d.x - d.y * d.y),
      0.25 * std::sqrt(35.0 / (2.0 * Pi)) * d.y * (3.0 * d.x * d.x - d.y * d.y) };
    for (std::size_t k = 0; k < std::size(expected); ++k)
    {
      ASSERT_NEAR(y[k], expected[k], 1e-14) << k;
    }
    ASSERT_NEAR(y[12], 0.25 * std::sqrt(7.0 / Pi) * (5.0 * d.z * d.z * d.z - 3.0 * d.z), 1e-14);
  }
}

//------------------------------------------------------------------------------
// Varying zonal functions vanish at the zone's edges, Legendre x Fourier's do not.
TEST(BasisFunctions, Edges)
{
  for (const double edge : Zone)
  {
    const glm::dvec3 d = FromAngles(ToRadians(edge), 0.3);
    const std::vector<double> zonal = vtkBasisBRDF::EvaluateBasis(2, 4, Zone, &d.x);
    const std::vector<double> fourier = vtkBasisBRDF::EvaluateBasis(3, 4, Zone, &d.x);
    const double height = std::cos(ToRadians(9.0)) - std::cos(ToRadians(57.0));
    for (int l = 0; l <= 4; ++l)
    {
      for (int m = 1; m <= l; ++m)
      {
        const std::size_t k = static_cast<std::size_t>(l * (l + 1) + m);
        EXPECT_NEAR(zonal[k], 0.0, 1e-6);
        const double degree = l - m;
        const double sign = edge == 9.0 || (l - m) % 2 == 0 ? 1.0 : -1.0;
        EXPECT_NEAR(fourier[k],
          sign * std::sqrt((2.0 * degree + 1.0) / (Pi * height)) * std::cos(0.3 * m), 1e-12);
      }
    }
  }
  EXPECT_EQ(vtkBasisBRDF::EvaluateBasis(4, 2, Zone, Zone).size(), 0u);
  const double up[3] = { 0.0, 0.0, 1.0 };
  const double reversed[2] = { 57.0, 9.0 };
  EXPECT_EQ(vtkBasisBRDF::EvaluateBasis(2, 21, Zone, up).size(), 0u);
  EXPECT_EQ(vtkBasisBRDF::EvaluateBasis(2, -1, Zone, up).size(), 0u);
  EXPECT_EQ(vtkBasisBRDF::EvaluateBasis(2, 2, reversed, up).size(), 0u);
  EXPECT_EQ(vtkBasisBRDF::EvaluateBasis(0, 2, reversed, up).size(), 9u); // has none
}

//------------------------------------------------------------------------------
// Against the plain sum at samples of o: the error of the basis table is what the shader inputs
// says, within the tolerance where the table may grow so far.
TEST(BasisBRDF, InterpolatesWithinItsTolerance)
{
  for (int basis = 0; basis < 4; ++basis)
  {
    for (const int order : { 1, 6, 20 })
    {
      if (order == 20 && basis != vtkBasisBRDF::ZONAL)
      {
        continue; // its tables are large
      }
      const auto brdf =
        MakeBasis(basis, order, Zone, Zone, 3, 4, MakeCoefficients(order, 3, 4, 5, 20.0));
      ASSERT_TRUE(brdf);
      double before = 1.0;
      for (const double tolerance : { 0.05, 0.01, 0.001 })
      {
        brdf->SetResamplingTolerance(tolerance);
        std::mt19937 random(4);
        const auto uniform = [&random]() { return static_cast<double>(random()) * 0x1p-32; };
        double difference = 0.0, total = 0.0;
        for (int sample = 0; sample < 400; ++sample)
        {
          const glm::dvec3 i = FromCosine(std::sqrt(uniform()), 2.0 * Pi * uniform());
          const int t = sample % 3, p = sample / 3 % 4;
          const glm::dvec3 o = FromAngles(ToRadians(9.0 + 24.0 * t), 0.5 * Pi * p);
          const glm::dvec3 exact = SumExactly(brdf, i, t, p);
          const glm::dvec3 d = EvaluateSigned(brdf, i, o) - exact;
          difference += glm::dot(d, d);
          total += glm::dot(exact, exact);
        }
        const double error = std::sqrt(difference / total);
        vtkBRDFShaderInputs inputs;
        brdf->GetShaderInputs(inputs);
        EXPECT_NEAR(inputs.ResamplingError, error, 0.25 * error) << basis << " " << order;
        const bool capped = inputs.Terms[0].Textures[1].Dimensions[0] == 256;
        EXPECT_TRUE(!capped || order == 20 || tolerance < 0.01);
        EXPECT_TRUE(error < tolerance || capped)
          << vtkBasisBRDF::GetBasisName(basis) << ", order " << order << ": " << error;
        EXPECT_TRUE(error < before || (order == 20 && error == before));
        before = error;
      }
    }
  }
}

//------------------------------------------------------------------------------
// The isotropic form is the anisotropic one with (c_m, c_-m) turned by m phi_o.
TEST(BasisBRDF, IsotropicFormIsTheTurnedOne)
{
  const int order = 5, nTheta = 4, nPhi = 16;
  for (int basis = 0; basis < 4; ++basis)
  {
    const std::vector<float> plain = MakeCoefficients(order, nTheta, 1, 8, 2.0);
    std::vector<float> turned(plain.size() * nPhi);
    for (int l = 0; l <= order; ++l)
    {
      for (int m = 0; m <= l; ++m)
      {
        const int k = l * (l + 1) + m, mirror = l * (l + 1) - m;
        for (int t = 0; t < nTheta; ++t)
        {
          for (int p = 0; p < nPhi; ++p)
          {
            const double angle = 2.0 * Pi * m * p / nPhi;
            for (int c = 0; c < 3; ++c)
            {
              const double a = plain[3 * (k * nTheta + t) + c];
              const double b = m > 0 ? plain[3 * (mirror * nTheta + t) + c] : 0.0;
              turned[3 * ((k * nTheta + t) * nPhi + p) + c] =
                static_cast<float>(std::cos(angle) * a - std::sin(angle) * b);
              if (m > 0)
              {
                turned[3 * ((mirror * nTheta + t) * nPhi + p) + c] =
                  static_cast<float>(std::sin(angle) * a + std::cos(angle) * b);
              }
            }
          }
        }
      }
    }
    const auto isotropic = MakeBasis(basis, order, Zone, Hemisphere, nTheta, 1, plain);
    const auto anisotropic = MakeBasis(basis, order, Zone, Hemisphere, nTheta, nPhi, turned);
    ASSERT_TRUE(isotropic && anisotropic);
    EXPECT_TRUE(isotropic->IsIsotropic());
    EXPECT_FALSE(anisotropic->IsIsotropic());
    // The largest basis table, whose columns the camera's azimuths meet: interpolation is the same.
    isotropic->SetResamplingTolerance(1e-5);
    anisotropic->SetResamplingTolerance(1e-5);
    std::mt19937 random(2);
    const auto uniform = [&random]() { return static_cast<double>(random()) * 0x1p-32; };
    for (int sample = 0; sample < 500; ++sample)
    {
      const glm::dvec3 i = FromAngles(1.5 * uniform(), 2.0 * Pi * uniform());
      const glm::dvec3 o = FromAngles(1.5 * uniform() + 0.01, 2.0 * Pi * (sample % nPhi) / nPhi);
      const glm::dvec3 a = EvaluateSigned(isotropic, i, o);
      const glm::dvec3 b = EvaluateSigned(anisotropic, i, o);
      ASSERT_LT(glm::length(a - b), 2e-6 * (1.0 + glm::length(a))) << basis;
    }
  }
}

//------------------------------------------------------------------------------
TEST(BasisBRDF, LinearAlongTheView)
{
  // Coefficient 2 at 20 degrees, 4 at 60, and the mean of azimuths 0 and 90.
  const double outgoing[2] = { 20.0, 60.0 };
  std::vector<float> rgb;
  for (const float v : { 2.0f, 6.0f, 4.0f, 0.0f, 4.0f, 6.0f, 8.0f, 6.0f })
  {
    rgb.insert(rgb.end(), { v, 0.5f * v, 0.0f });
  }
  const auto brdf = MakeBasis(vtkBasisBRDF::HEMISPHERICAL, 0, Zone, outgoing, 2, 4, rgb);
  ASSERT_TRUE(brdf);
  const double b = std::sqrt(0.5 / Pi);
  const glm::dvec3 i = FromAngles(0.7, 0.2);
  EXPECT_NEAR(Evaluate(brdf, i, FromAngles(ToRadians(40.0), 0.0)).x, 3.0 * b, 1e-7);
  EXPECT_NEAR(Evaluate(brdf, i, FromAngles(ToRadians(20.0), 0.25 * Pi)).x, 4.0 * b, 1e-7);
  EXPECT_NEAR(Evaluate(brdf, i, FromAngles(ToRadians(30.0), -0.25 * Pi)).y, 1.0 * b, 1e-7);
  // Held beyond the samples.
  EXPECT_NEAR(Evaluate(brdf, i, FromAngles(ToRadians(5.0), 0.0)).x, 2.0 * b, 1e-7);
  EXPECT_NEAR(Evaluate(brdf, i, FromAngles(ToRadians(85.0), 0.5 * Pi)).x, 6.0 * b, 1e-7);
}

//------------------------------------------------------------------------------
TEST(BasisBRDF, ConstantBeyondTheZones)
{
  const double outgoing[2] = { 20.0, 50.0 };
  for (const int nPhi : { 1, 8 })
  {
    for (const bool cosines : { false, true })
    {
      for (const int basis : { 2, 3 })
      {
        const auto brdf =
          MakeBasis(basis, 4, Zone, outgoing, 5, nPhi, MakeCoefficients(4, 5, nPhi));
        ASSERT_TRUE(brdf);
        brdf->SetIncidentCosine(cosines);
        brdf->SetOutgoingCosine(cosines);
        const auto at = [&brdf](double thetaI, double thetaO) {
          return Evaluate(
            brdf, FromAngles(ToRadians(thetaI), 1.0), FromAngles(ToRadians(thetaO), 2.0));
        };
        const glm::dvec3 far = at(57.0, 50.0), near = at(9.0, 20.0);
        for (const double beyond : { 60.0, 75.0, 89.0 })
        {
          EXPECT_LT(glm::length(at(beyond, 50.0) - far), 1e-6 * glm::length(far));
          EXPECT_LT(glm::length(at(57.0, beyond) - far), 1e-6 * glm::length(far));
        }
        EXPECT_LT(glm::length(at(2.0, 20.0) - near), 1e-6 * glm::length(near));
        EXPECT_LT(glm::length(at(9.0, 3.0) - near), 1e-6 * glm::length(near));
        EXPECT_GT(glm::length(at(40.0, 35.0) - far), 1e-3);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(BasisBRDF, DividesByTheCosinesItCarries)
{
  const auto brdf = MakeBasis(3, 3, Zone, Zone, 4, 1, MakeCoefficients(3, 4, 1));
  ASSERT_TRUE(brdf);
  const glm::dvec3 i = FromAngles(ToRadians(50.0), 1.0), o = FromAngles(ToRadians(20.0), 2.0);
  const glm::dvec3 plain = Evaluate(brdf, i, o);
  brdf->IncidentCosineOn();
  EXPECT_NEAR(Evaluate(brdf, i, o).y, plain.y / i.z, 1e-12);
  brdf->OutgoingCosineOn();
  EXPECT_NEAR(Evaluate(brdf, i, o).y, plain.y / (i.z * o.z), 1e-12);
  brdf->IncidentCosineOff();
  EXPECT_NEAR(Evaluate(brdf, i, o).y, plain.y / o.z, 1e-12);
  // Never by less than 0.01.
  const auto wide =
    MakeBasis(vtkBasisBRDF::HEMISPHERICAL, 0, Zone, Hemisphere, 2, 1, { 1, 1, 1, 1, 1, 1 });
  wide->IncidentCosineOn();
  const glm::dvec3 grazing = FromCosine(1e-4, 0.0);
  EXPECT_NEAR(Evaluate(wide, grazing, o).x, 100.0 * std::sqrt(0.5 / Pi), 1e-5);
}

//------------------------------------------------------------------------------
TEST(BasisBRDF, ClampsAfterTheSum)
{
  // 2 z - 1 over the hemisphere: negative below 60 degrees of elevation.
  std::vector<float> rgb(3 * 4 * 2, 0.0f);
  std::fill_n(&rgb[3 * 2 * 2], 6, 1.0f); // l = 1, m = 0
  const auto brdf = MakeBasis(vtkBasisBRDF::HEMISPHERICAL, 1, Zone, Hemisphere, 2, 1, rgb);
  ASSERT_TRUE(brdf);
  const double scale = std::sqrt(3.0 / (2.0 * Pi));
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const glm::dvec3 low = FromCosine(0.25, 0.4);
  EXPECT_NEAR(EvaluateSigned(brdf, low, up).x, -0.5 * scale, 2e-2);
  EXPECT_EQ(Evaluate(brdf, low, up).x, 0.0);
  EXPECT_NEAR(Evaluate(brdf, FromCosine(0.75, 0.4), up).x, 0.5 * scale, 2e-2);
  // Not unit, below the horizon, or no directions at all.
  EXPECT_EQ(EvaluateSigned(brdf, 3.0 * low, 0.1 * up), EvaluateSigned(brdf, low, up));
  EXPECT_EQ(EvaluateSigned(brdf, -low, up), glm::dvec3(0.0));
  const glm::dvec3 bad(std::nan(""), 0.0, 1.0);
  EXPECT_EQ(EvaluateSigned(brdf, bad, up), glm::dvec3(0.0));
  EXPECT_EQ(EvaluateSigned(brdf, up, bad), glm::dvec3(0.0));
}

//------------------------------------------------------------------------------
// c + cos(theta_i) b over the hemisphere of i, its share below 0 against a plain sum.
TEST(BasisBRDF, NegativeMass)
{
  const double hemisphere[2] = { 0.0, 90.0 };
  std::vector<float> rgb(3 * 4 * 2, 0.0f);
  std::fill_n(rgb.begin(), 6, 0.5f);       // Y00
  std::fill_n(rgb.begin() + 12, 6, -0.7f); // Y10 = sqrt(3) cos
  const auto brdf = MakeBasis(0, 1, hemisphere, hemisphere, 2, 1, rgb);
  ASSERT_TRUE(brdf);
  brdf->SetResamplingTolerance(1e-4);
  for (const double end : { 90.0, 57.0 })
  {
    const double zone[2] = { 9.0, end };
    double negative = 0.0, total = 0.0;
    ForZone(zone, 200, 1,
      [&](const glm::dvec3& i, double weight)
      {
        const double f = 0.5 - 0.7 * std::sqrt(3.0) * i.z;
        negative += weight * i.z * std::max(-f, 0.0);
        total += weight * i.z * std::abs(f);
      });
    EXPECT_NEAR(brdf->GetNegativeMass(zone, zone), negative / total, 2e-3);
  }
  brdf->SetCoefficients(
    0, 1, hemisphere, hemisphere, 2, 1, std::vector<float>(3 * 4 * 2, -1.0f / 64));
  EXPECT_GT(brdf->GetNegativeMass(Zone, Zone), 0.3);
  EXPECT_LE(brdf->GetNegativeMass(Zone, Zone), 1.0);
  const double none[2] = { 57.0, 9.0 };
  EXPECT_TRUE(std::isnan(brdf->GetNegativeMass(none, Zone)));
  EXPECT_TRUE(std::isnan(brdf->GetNegativeMass(Zone, none)));
}

//------------------------------------------------------------------------------
TEST(BasisBRDF, RefusesAndKeeps)
{
  const auto brdf = MakeBasis(2, 2, Zone, Zone, 3, 2, MakeCoefficients(2, 3, 2));
  ASSERT_TRUE(brdf);
  const std::vector<float> before = brdf->GetCoefficients();
  const vtkMTimeType time = brdf->GetMTime();
  const auto refuse = [&](const std::string& expected, int basis, int order, const double in[2],
                        const double out[2], int nTheta, int nPhi, std::vector<float> rgb)
  {
    EXPECT_EQ(brdf->SetCoefficients(basis, order, in, out, nTheta, nPhi, std::move(rgb)), expected);
    EXPECT_EQ(brdf->GetCoefficients(), before);
    EXPECT_EQ(brdf->GetMTime(), time);
    EXPECT_EQ(brdf->GetOrder(), 2);
    EXPECT_EQ(brdf->GetNumberOfTheta(), 3);
  };
  const std::vector<float> one(3 * 4 * 2, 1.0f);
  const double reversed[2] = { 57.0, 9.0 }, narrow[2] = { 10.0, 10.5 }, deep[2] = { 0.0, 91.0 },
               negative[2] = { -1.0, 50.0 }, nan[2] = { 0.0, std::nan("") };
  refuse("basis 4 is unknown", 4, 1, Zone, Zone, 2, 1, one);
  refuse("basis -1 is unknown", -1, 1, Zone, Zone, 2, 1, one);
  refuse("order -1, expected 0 to 20", 2, -1, Zone, Zone, 2, 1, one);
  refuse("order 21, expected 0 to 20", 2, 21, Zone, Zone, 2, 1, one);
  const std::string rule = " degrees, expected 0 <= begin <= 88, end <= 90 and at least 1 between";
  refuse("zone 57 to 9" + rule, 2, 1, reversed, Zone, 2, 1, one);
  refuse("zone 57 to 9" + rule, 0, 1, Zone, reversed, 2, 1, one);
  refuse("zone 10 to 10.5" + rule, 3, 1, narrow, Zone, 2, 1, one);
  refuse("zone 0 to 91" + rule, 3, 1, Zone, deep, 2, 1, one);
  refuse("zone -1 to 50" + rule, 3, 1, negative, Zone, 2, 1, one);
  refuse("zone 0 to nan" + rule, 3, 1, nan, Zone, 2, 1, one);
  const std::string sizes = " samples of o, expected 2 to 1024 x 1 to 1024";
  refuse("1 x 1" + sizes, 2, 1, Zone, Zone, 1, 1, one);
  refuse("2 x 0" + sizes, 2, 1, Zone, Zone, 2, 0, one);
  refuse("1025 x 1" + sizes, 2, 1, Zone, Zone, 1025, 1, one);
  refuse("2 x 2000000000" + sizes, 2, 1, Zone, Zone, 2, 2000000000, one);
  refuse("441 functions x 1024 x 1024 samples of o are 1387266048 coefficients, expected at most "
         "67108864",
    2, 20, Zone, Zone, 1024, 1024, one);
  const double low[2] = { 88.5, 90.0 };
  refuse("zone 88.5 to 90" + rule, 2, 1, low, Zone, 2, 1, one);
  refuse("24 coefficients, expected 48", 2, 1, Zone, Zone, 2, 2, one);
  std::vector<float> bad = one;
  bad[7] = std::numeric_limits<float>::quiet_NaN();
  refuse("a coefficient is NaN or infinite", 2, 1, Zone, Zone, 2, 1, bad);
  bad[7] = -std::numeric_limits<float>::infinity();
  refuse("a coefficient is NaN or infinite", 2, 1, Zone, Zone, 2, 1, bad);
  // The zone of i does not matter to the bases that have none.
  EXPECT_EQ(brdf->SetCoefficients(1, 1, reversed, Zone, 2, 1, one), "");
  EXPECT_EQ(brdf->GetIncidentZone()[1], 90.0);
  EXPECT_EQ(vtkBasisBRDF::GetBasisName(3), "Legendre x Fourier");
  EXPECT_EQ(vtkBasisBRDF::GetBasisName(9), "unknown");
}

//------------------------------------------------------------------------------
TEST(BasisBRDF, WithoutCoefficients)
{
  vtkNew<vtkBasisBRDF> brdf;
  const glm::dvec3 up(0.0, 0.0, 1.0);
  brdf->Prepare();
  EXPECT_EQ(Evaluate(brdf, up, up), glm::dvec3(0.0));
  vtkBRDFShaderInputs inputs;
  brdf->GetShaderInputs(inputs);
  EXPECT_TRUE(inputs.Terms.empty());
  glm::dvec3 i;
  EXPECT_TRUE(brdf->Sample(&up.x, 0.3, 0.3, &i.x));
  EXPECT_NEAR(brdf->Pdf(&i.x, &up.x), i.z / Pi, 1e-12);
  std::ostringstream text;
  brdf->Print(text);
  EXPECT_NE(text.str().find("Basis: zonal"), std::string::npos);
}

//------------------------------------------------------------------------------
TEST(BasisBRDF, ShaderInputs)
{
  const auto brdf = MakeBasis(2, 4, Zone, Zone, 8, 6, MakeCoefficients(4, 8, 6));
  ASSERT_TRUE(brdf);
  brdf->SetResamplingTolerance(0.02);
  vtkBRDFShaderInputs half;
  brdf->GetShaderInputs(half);
  ASSERT_EQ(half.Terms.size(), 1u);
  const auto& textures = half.Terms[0].Textures;
  ASSERT_EQ(textures.size(), 2u);
  EXPECT_TRUE(textures[0].HalfFloat && textures[1].HalfFloat);
  EXPECT_EQ(textures[0].Dimensions, (std::array<int, 3>{ 6, 8, 25 }));
  EXPECT_EQ(textures[1].Dimensions[2], 25);
  EXPECT_EQ(half.GetTextureBytes(),
    2u * 25 *
      (3 * 6 * 8 +
        static_cast<std::size_t>(textures[1].Dimensions[0] * textures[1].Dimensions[1])));
  EXPECT_NE(half.Description.find(
              "zonal basis of order 4 (25 functions), coefficients 6 x 8, basis values "),
    std::string::npos)
    << half.Description;
  EXPECT_NE(
    half.Description.find(std::to_string(half.GetTextureBytes()) + " bytes"), std::string::npos);
  // Twice the bytes where the tolerance wants 32 bits, or where large terms cancel.
  brdf->SetResamplingTolerance(1e-3);
  vtkBRDFShaderInputs fine;
  brdf->GetShaderInputs(fine);
  EXPECT_FALSE(fine.Terms[0].Textures[0].HalfFloat || fine.Terms[0].Textures[1].HalfFloat);
  EXPECT_LT(fine.QuantizationError, 1e-6);
  std::vector<float> cancelling = MakeCoefficients(4, 2, 1);
  for (std::size_t k = 0; k < 3 * 2; ++k)
  {
    cancelling[k] = 100.0f;               // B_0
    cancelling[3 * 2 * 2 + k] = -57.735f; // B_10 = sqrt 3 z B_0: 100 (1 - z) near the normal
  }
  const auto sharp = MakeBasis(0, 4, Zone, Zone, 2, 1, cancelling);
  sharp->SetResamplingTolerance(0.003);
  vtkBRDFShaderInputs wide;
  sharp->GetShaderInputs(wide);
  EXPECT_FALSE(wide.Terms[0].Textures[0].HalfFloat);
  // Enormous and tiny coefficients fit 16 bits by their scale.
  for (const float size : { 1e-38f, 1e-20f, 1e20f })
  {
    std::vector<float> rgb = MakeCoefficients(2, 2, 1);
    for (float& v : rgb)
    {
      v *= size;
    }
    const auto scaled = MakeBasis(3, 2, Zone, Zone, 2, 1, rgb);
    vtkBRDFShaderInputs inputs;
    scaled->GetShaderInputs(inputs);
    for (const float v : inputs.Terms[0].Textures[0].Data)
    {
      ASSERT_TRUE(
        std::isfinite(v) && (!inputs.Terms[0].Textures[0].HalfFloat || std::abs(v) < 65504));
    }
  }
}

//------------------------------------------------------------------------------
// The quantization figure is the RMS error of the sum where every stored value is off by the
// largest rounding error of its format.
TEST(BasisBRDF, QuantizationErrorOfHalfFloats)
{
  for (const int order : { 2, 6 })
  {
    for (const double ripple : { 0.3, 20.0 })
    {
      const auto brdf =
        MakeBasis(2, order, Zone, Zone, 8, 6, MakeCoefficients(order, 8, 6, 12, ripple));
      ASSERT_TRUE(brdf);
      brdf->SetResamplingTolerance(0.05);
      vtkBRDFShaderInputs inputs;
      brdf->GetShaderInputs(inputs);
      const auto& coefficients = inputs.Terms[0].Textures[0];
      const auto& basis = inputs.Terms[0].Textures[1];
      ASSERT_TRUE(coefficients.HalfFloat);
      const std::size_t functions = static_cast<std::size_t>((order + 1) * (order + 1));
      const std::size_t views = coefficients.Data.size() / (3 * functions);
      const std::size_t lights = basis.Data.size() / functions;
      double difference = 0.0, total = 0.0;
      for (std::size_t view = 0; view < views; ++view)
      {
        for (std::size_t light = 0; light < lights; light += 7)
        {
          double plain = 0.0, rounded = 0.0;
          for (std::size_t k = 0; k < functions; ++k)
          {
            const float c = coefficients.Data[3 * (k * views + view)];
            const float b = basis.Data[k * lights + light];
            plain += static_cast<double>(c) * b;
            rounded += static_cast<double>(RoundToHalf(c)) * RoundToHalf(b);
          }
          difference += (rounded - plain) * (rounded - plain);
          total += plain * plain;
        }
      }
      const double error = std::sqrt(difference / total);
      EXPECT_LT(error, inputs.QuantizationError);
      EXPECT_GT(error, 0.2 * inputs.QuantizationError);
    }
  }
}
