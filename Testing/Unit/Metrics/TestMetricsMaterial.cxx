// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "TestBasisHelpers.h"
#include "vtkBRDFAnalysis.h"
#include "vtkBasisBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using measuredbrdf::Pi;

//------------------------------------------------------------------------------
TEST(BRDFAnalysis, Lambert)
{
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(0.2, 0.4, 1.2);
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetBRDF(brdf);
  ASSERT_TRUE(analysis->Update());
  ASSERT_EQ(analysis->GetNumberOfAngles(), 10);
  EXPECT_EQ(analysis->GetAngle(9), 85.0);
  for (int k = 0; k < 10; ++k)
  {
    double rgb[3];
    analysis->GetAlbedo(k, rgb);
    EXPECT_NEAR(rgb[0], 0.2, 1e-3);
    EXPECT_NEAR(rgb[1], 0.4, 1e-3);
    analysis->GetReflectance(k, rgb);
    EXPECT_NEAR(rgb[1], 0.4, 1e-3);
  }
  EXPECT_NEAR(analysis->GetLargestAlbedo(), 1.2, 2e-3);
  EXPECT_TRUE(analysis->GetGainsEnergy());
  EXPECT_EQ(analysis->GetReciprocityError(), 0.0);
  EXPECT_EQ(analysis->GetReciprocityRMSError(), 0.0);
  EXPECT_EQ(analysis->GetNegativeMass(), 0.0);
  EXPECT_NEAR(analysis->GetMinimum()[1], 0.4 / Pi, 1e-12);
  EXPECT_NEAR(analysis->GetMaximum()[1], 0.4 / Pi, 1e-12);

  brdf->SetAlbedo(1.0, 1.0, 1.0);
  ASSERT_TRUE(analysis->Update());
  EXPECT_FALSE(analysis->GetGainsEnergy());
}

//------------------------------------------------------------------------------
TEST(BRDFAnalysis, ReciprocityErrorOfAKnownOne)
{
  // With s = cos_i^2, t = cos_o^2 (uniform in [0,1] under the weights): E|f - f'| = 2k E|s - t| =
  // 2k/3; E f = 1; E (f - f')^2 = 4k^2/6; E f^2 = 1 + k^2/6.
  // f = 1 + k (s - t) is not reciprocal by a known amount.
  constexpr double k = 0.5;
  vtkNew<testbasis::FunctionBRDF> brdf;
  brdf->Function = [](const glm::dvec3& i, const glm::dvec3& o)
  { return glm::dvec3(1.0 + k * (i.z * i.z - o.z * o.z)); };
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetBRDF(brdf);
  ASSERT_TRUE(analysis->Update());
  EXPECT_NEAR(analysis->GetReciprocityError(), 2.0 * k / 3.0, 0.01);
  EXPECT_NEAR(
    analysis->GetReciprocityRMSError(), std::sqrt(4.0 * k * k / 6.0 / (1.0 + k * k / 6.0)), 0.01);
  EXPECT_NEAR(analysis->GetMinimum()[0], 1.0 - k, 0.03);
  EXPECT_NEAR(analysis->GetMaximum()[0], 1.0 + k, 0.03);
  // a(o) = pi (1 + k (1/2 - cos_o^2)).
  double rgb[3];
  analysis->GetAlbedo(0, rgb);
  EXPECT_NEAR(rgb[0], Pi * (1.0 - 0.5 * k), 5e-3);
  // r(i) = pi (1 + k (cos_i^2 - 1/2)).
  analysis->GetReflectance(0, rgb);
  EXPECT_NEAR(rgb[0], Pi * (1.0 + 0.5 * k), 5e-3);
  for (int n = 1; n < analysis->GetNumberOfAngles(); ++n)
  {
    const double z = std::cos(analysis->GetAngle(n) * Pi / 180.0);
    analysis->GetAlbedo(n, rgb);
    EXPECT_NEAR(rgb[0], Pi * (1.0 + k * (0.5 - z * z)), 5e-3);
    analysis->GetReflectance(n, rgb);
    EXPECT_NEAR(rgb[0], Pi * (1.0 + k * (z * z - 0.5)), 5e-3);
  }
  EXPECT_NEAR(analysis->GetLargestAlbedo(), Pi * (1.0 + 0.5 * k), 5e-3);
}

//------------------------------------------------------------------------------
TEST(BRDFAnalysis, NegativeMassOfATable)
{
  // Cells: value -1 where theta_i < 45 degrees (half of the projected solid angle), +3 elsewhere,
  // over all theta_o: the negative share is 1/(1 + 3).
  const int size[3] = { 4, 40, 40 };
  std::vector<float> rgb;
  for (int z = 0; z < size[2]; ++z)
  {
    rgb.insert(rgb.end(), 3 * std::size_t(size[0]) * size[1], z < 20 ? -1.0f : 3.0f);
  }
  vtkNew<vtkTabulatedBRDF> brdf;
  ASSERT_TRUE(
    brdf->SetVolume(vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::HALF_TURN, size, rgb));
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetBRDF(brdf);
  ASSERT_TRUE(analysis->Update());
  EXPECT_NEAR(analysis->GetNegativeMass(), 0.25, 1e-6);
  EXPECT_EQ(analysis->GetMinimum()[0], 0.0); // Evaluate clamps

  // Half/difference: negative where theta_h < 22.5 degrees (its axis is (pi/2) t^2, t < 1/2). The
  // share is that of pairs drawn by their cosines, which the cells' weights must reproduce.
  const int half[3] = { 60, 30, 30 };
  rgb.clear();
  for (int z = 0; z < half[2]; ++z)
  {
    rgb.insert(rgb.end(), 3 * std::size_t(half[0]) * half[1], z < 15 ? -1.0f : 1.0f);
  }
  ASSERT_TRUE(
    brdf->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, half, rgb));
  ASSERT_TRUE(analysis->Update());
  double below = 0.0;
  double all = 0.0;
  const int n = 60;
  for (int a = 0; a < n; ++a)
  {
    for (int b = 0; b < n; ++b)
    {
      for (int c = 0; c < n; ++c)
      {
        const double zi = std::sqrt((a + 0.5) / n); // uniform in cos^2: the cosine-weighted measure
        const double zo = std::sqrt((b + 0.5) / n);
        const double phi = 2.0 * Pi * (c + 0.5) / n;
        const double si = std::sqrt(1.0 - zi * zi);
        const double so = std::sqrt(1.0 - zo * zo);
        const double x = si + so * std::cos(phi);
        const double y = so * std::sin(phi);
        all += 1.0;
        below += std::atan2(std::hypot(x, y), zi + zo) < Pi / 8.0 ? 1.0 : 0.0;
      }
    }
  }
  EXPECT_NEAR(analysis->GetNegativeMass(), below / all, 0.01);
}

//------------------------------------------------------------------------------
TEST(BRDFAnalysis, NegativeMassOfABasis)
{
  // f = 2 z - 1 for z = cos(theta_i). Weighted by z: the negative part has 1/24, the positive 5/24.
  const double hemisphere[2] = { 0.0, 90.0 };
  std::vector<float> rgb(3 * 4 * 2, 0.0f);
  std::fill_n(&rgb[3 * 2 * 2], 6, 1.0f); // l = 1, m = 0
  vtkNew<vtkBasisBRDF> brdf;
  ASSERT_EQ(
    brdf->SetCoefficients(vtkBasisBRDF::HEMISPHERICAL, 1, hemisphere, hemisphere, 2, 1, rgb), "");
  brdf->SetResamplingTolerance(1e-4);
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetBRDF(brdf);
  ASSERT_TRUE(analysis->Update());
  EXPECT_NEAR(analysis->GetNegativeMass(), 1.0 / 6.0, 1e-3);
  EXPECT_EQ(analysis->GetMinimum()[0], 0.0); // Evaluate clamps

  // With a constant of the same size nothing is negative.
  std::fill_n(rgb.begin(), 6, 2.0f);
  ASSERT_EQ(
    brdf->SetCoefficients(vtkBasisBRDF::HEMISPHERICAL, 1, hemisphere, hemisphere, 2, 1, rgb), "");
  ASSERT_TRUE(analysis->Update());
  EXPECT_EQ(analysis->GetNegativeMass(), 0.0);
}

//------------------------------------------------------------------------------
TEST(BRDFAnalysis, Arguments)
{
  vtkNew<vtkBRDFAnalysis> analysis;
  ErrorCatcher errors(analysis);
  EXPECT_FALSE(analysis->Update());
  const double bad[2] = { 10.0, 90.0 };
  analysis->SetAngles(2, bad);
  EXPECT_EQ(errors.Take(), 2);
  EXPECT_EQ(analysis->GetNumberOfAngles(), 10);
  const double good[2] = { 10.0, 30.0 };
  analysis->SetAngles(2, good);
  EXPECT_EQ(analysis->GetNumberOfAngles(), 2);
  vtkNew<vtkLambertBRDF> brdf;
  analysis->SetBRDF(brdf);
  ASSERT_TRUE(analysis->Update());
  double rgb[3];
  analysis->GetAlbedo(7, rgb); // outside: zeros
  EXPECT_EQ(rgb[0], 0.0);
  std::ostringstream text;
  analysis->Print(text);
  EXPECT_NE(text.str().find("Albedo at 30 degrees"), std::string::npos);
}
