// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Measured anisotropic materials: the table for graphics cards, and RGL's anisotropic files.

#include "AnisotropicWarp.h"
#include "ErrorCatcher.h"

#include "TestDirections.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"
#include "vtkTensorTreeBRDF.h"
#include "vtkWeakPointer.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace
{
glm::dvec3 DrawDirection(std::mt19937& random)
{
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double z = 0.05 + 0.95 * uniform(random);
  return FromAngles(std::acos(z), 6.283185307179586 * uniform(random));
}

vtkNew<vtkDistributionBRDF> NewBrushed() { return NewBrushedMetal(0.3, 0.6); }
}

TEST(AnisotropicTabulated, InterpolatesInFourQuantities)
{
  // Linear in theta_d, a cosine in both azimuths: half way between two samples, the mean of both.
  const int size[4] = { 8, 5, 6, 4 };
  std::vector<float> rgb;
  for (int k = 0; k < 8 * 5 * 6 * 4; ++k)
  {
    const int x = k % 8, y = k / 8 % 5, p = k / 40 % 6, t = k / 240;
    rgb.insert(rgb.end(), { 1.0f + 0.1f * t + 0.2f * y + 0.05f * x * (8 - x) + 0.07f * p * (6 - p),
                            1.0f * p, 1.0f * x });
  }
  vtkNew<vtkTabulatedBRDF> table;
  ASSERT_TRUE(table->SetVolume(vtkTabulatedBRDF::FULL_TURN, size, rgb));
  constexpr double pi = 3.14159265358979323846;
  const auto at = [&](double x, double y, double p, double t)
  {
    const double thetaH = 0.5 * pi * std::pow((t + 0.5) / 4.0, 2.0);
    const double thetaD = 0.5 * pi * (y + 0.5) / 5.0;
    const double phiD = 2.0 * pi * (x + 0.5) / 8.0, phiH = 2.0 * pi * (p + 0.5) / 6.0;
    // d about the normal, turned to h.
    const glm::dvec3 d = FromAngles(thetaD, phiD);
    const glm::dvec3 a(std::cos(thetaH) * d.x + std::sin(thetaH) * d.z, d.y,
      std::cos(thetaH) * d.z - std::sin(thetaH) * d.x);
    const glm::dvec3 i(std::cos(phiH) * a.x - std::sin(phiH) * a.y,
      std::sin(phiH) * a.x + std::cos(phiH) * a.y, a.z);
    const glm::dvec3 h = FromAngles(thetaH, phiH);
    const glm::dvec3 o = 2.0 * glm::dot(i, h) * h - i;
    return i.z > 0.0 && o.z > 0.0 ? Evaluate(table, i, o) : glm::dvec3(-1.0);
  };
  for (int p = 0; p < 6; ++p)
  {
    for (int x = 0; x < 8; ++x)
    {
      const auto value = [&](int cell) { return rgb[static_cast<std::size_t>(3 * cell)]; };
      const int cell = x + 8 * (1 + 5 * (p + 6));
      EXPECT_NEAR(at(x, 1, p, 1).x, value(cell), 1e-5);
      EXPECT_NEAR(at(x, 1.5, p, 1).x, 0.5 * (value(cell) + value(cell + 8)), 1e-5);
      EXPECT_NEAR(at(x, 1, p, 1.0).y, p, 1e-5);
      const int next = (p + 1) % 6;
      EXPECT_NEAR(at(x, 1, p + 0.5, 1).y, 0.5 * (p + next), 1e-5);
      EXPECT_NEAR(at(x + 0.5, 1, p, 1).z, 0.5 * (x + (x + 1) % 8), 1e-5);
    }
  }
}

TEST(AnisotropicTabulated, ErrorFallsWithTheSize)
{
  const auto brushed = NewBrushed();
  double last = 1.0;
  for (const int n : { 8, 16, 32 })
  {
    vtkNew<vtkTabulatedBRDF> table;
    const int size[4] = { n, n, n / 2, n };
    ASSERT_TRUE(table->Resample(brushed, vtkTabulatedBRDF::HALF_TURN, size));
    const double error = vtkBRDFResampler::GetRelativeL2Error(brushed, table, 1 << 13);
    EXPECT_LT(error, 0.5 * last);
    last = error;
  }
  EXPECT_LT(last, 0.02);
}

// A file of the whole turn, of half of it and of a quarter is the same material where that has the
// symmetry; and close to what it was made of.
TEST(AnisotropicWarp, ReadsReducedFiles)
{
  const auto brushed = NewBrushed();
  vtkSmartPointer<vtkAdaptiveWarpBRDF> files[3];
  for (int k = 0; k < 3; ++k)
  {
    AnisotropicWarpSizes sizes;
    sizes.Parts = 1 << k;
    sizes.Phis = 32 / sizes.Parts + 1;
    files[k] = vtkSmartPointer<vtkAdaptiveWarpBRDF>::New();
    ASSERT_EQ(files[k]->SetTables(MakeAnisotropicTables(brushed, sizes)), "");
    EXPECT_FALSE(files[k]->IsIsotropic());
  }
  std::mt19937 random(3);
  double difference = 0.0, sum = 0.0, worst = 0.0;
  for (int k = 0; k < 4000; ++k)
  {
    const glm::dvec3 i = DrawDirection(random), o = DrawDirection(random);
    const glm::dvec3 whole = Evaluate(files[0], i, o);
    const glm::dvec3 truth = Evaluate(brushed, i, o);
    difference += std::abs(whole.x - truth.x) * i.z * o.z;
    sum += truth.x * i.z * o.z;
    for (int part = 1; part < 3; ++part)
    {
      const glm::dvec3 reduced = Evaluate(files[part], i, o);
      worst = std::max(worst, std::abs(reduced.x - whole.x) / (whole.x + 0.01));
    }
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(difference, 0.03 * sum);

  // In the planes of the symmetry, where the azimuth may be that of either end of the span.
  for (const double x : { -0.6, 0.6 })
  {
    for (const double y : { 0.0, -0.0 })
    {
      const glm::dvec3 i(x, y, 0.8), o(0.1, 0.2, std::sqrt(0.95));
      const double whole = Evaluate(files[0], i, o).x;
      EXPECT_NEAR(Evaluate(files[1], i, o).x, whole, 1e-5 * whole);
      EXPECT_NEAR(Evaluate(files[2], i, o).x, whole, 1e-5 * whole);
      const glm::dvec3 across(y, x, 0.8);
      const double other = Evaluate(files[0], across, o).x;
      EXPECT_NEAR(Evaluate(files[2], across, o).x, other, 1e-5 * other);
    }
  }

  // Draws and densities of all three agree, too.
  for (int k = 0; k < 200; ++k)
  {
    const glm::dvec3 o = DrawDirection(random), i = DrawDirection(random);
    const double pdf = files[0]->Pdf(&i.x, &o.x);
    EXPECT_NEAR(files[1]->Pdf(&i.x, &o.x), pdf, 1e-3 * pdf);
    EXPECT_NEAR(files[2]->Pdf(&i.x, &o.x), pdf, 1e-3 * pdf);
  }
}

TEST(AnisotropicWarp, RefusesOtherSpans)
{
  AnisotropicWarpSizes sizes;
  sizes.Thetas = 2;
  sizes.Phis = 5;
  sizes.Side = 4;
  vtkAdaptiveWarpBRDF::Tables tables = MakeAnisotropicTables(NewBrushed(), sizes);
  vtkNew<vtkAdaptiveWarpBRDF> brdf;
  vtkAdaptiveWarpBRDF::Tables quarter = tables;
  for (float& phi : quarter.PhiI)
  {
    phi = 0.25f * phi; // -45 to 45 degrees
  }
  EXPECT_NE(brdf->SetTables(quarter).find("quarter turn from -45"), std::string::npos)
    << brdf->SetTables(quarter);
  for (float& phi : tables.PhiI)
  {
    phi *= 0.7f;
  }
  EXPECT_NE(brdf->SetTables(tables).find("degrees, expected 360, 180 or 90"), std::string::npos)
    << brdf->SetTables(tables);
}

// What graphics cards get of such a file.
TEST(AnisotropicWarp, IsResampledForGraphicsCards)
{
  AnisotropicWarpSizes sizes;
  sizes.Parts = 2;
  vtkNew<vtkAdaptiveWarpBRDF> file;
  ASSERT_EQ(file->SetTables(MakeAnisotropicTables(NewBrushed(), sizes)), "");
  ErrorCatcher errors(file);
  file->SetResamplingTolerance(0.03);
  auto* table = vtkTabulatedBRDF::SafeDownCast(file->GetRenderable());
  ASSERT_TRUE(table);
  EXPECT_EQ(errors.Take(), 0);
  EXPECT_EQ(table->GetAzimuthRange(), vtkTabulatedBRDF::HALF_TURN);
  EXPECT_GT(table->GetResamplingError(), 0.0);
  EXPECT_LE(table->GetResamplingError(), 0.03);
  vtkBRDFShaderInputs inputs;
  file->GetShaderInputs(inputs);
  EXPECT_LT(inputs.GetTextureBytes(), 10u << 20);
}

// Copies, as planners make them, do not resample again. One of another tolerance, in another thread
// say, does not take away what the material has handed out.
TEST(AnisotropicWarp, CopiesShareTheTable)
{
  AnisotropicWarpSizes sizes;
  sizes.Parts = 2;
  sizes.Thetas = 8;
  sizes.Side = 17;
  vtkNew<vtkAdaptiveWarpBRDF> file;
  ASSERT_EQ(file->SetTables(MakeAnisotropicTables(NewBrushed(), sizes)), "");
  file->SetResamplingTolerance(0.3);
  const auto copy = vtkSmartPointer<vtkBRDF>::Take(file->NewSnapshot());
  const auto other = vtkSmartPointer<vtkBRDF>::Take(file->NewSnapshot());
  ASSERT_TRUE(copy && other);
  const vtkWeakPointer<vtkBRDF> table = file->GetRenderable();
  EXPECT_EQ(copy->GetRenderable(), table);
  other->SetResamplingTolerance(0.5);
  const vtkWeakPointer<vtkBRDF> coarse = other->GetRenderable();
  EXPECT_NE(coarse, table);
  ASSERT_TRUE(table);
  EXPECT_EQ(file->GetRenderable(), table);
  EXPECT_EQ(table->GetResamplingTolerance(), 0.3);
  // Who changes to a tolerance that a copy has takes that one's.
  file->SetResamplingTolerance(0.5);
  EXPECT_EQ(file->GetRenderable(), coarse);
  EXPECT_EQ(copy->GetRenderable(), table);
  copy->SetResamplingTolerance(0.5);
  EXPECT_EQ(copy->GetRenderable(), coarse);
  EXPECT_FALSE(table);
  ASSERT_EQ(file->SetTables(MakeAnisotropicTables(NewBrushedMetal(0.5, 0.6), sizes)), "");
  EXPECT_NE(file->GetRenderable(), coarse);
}

TEST(TensorTree, RefusesTowers)
{
  vtkTensorTreeBRDF::Tree tree;
  tree.Nodes = { { 1, 0 } };
  tree.Values = { 0.5f };
  vtkNew<vtkTensorTreeBRDF> brdf;
  for (int k = 0; k < 63; ++k)
  {
    tree.Nodes.push_back({ 0, 8 * k });
    tree.Children.insert(tree.Children.end(), 8, k);
  }
  EXPECT_EQ(brdf->SetTree(tree), "");
  tree.Nodes.push_back({ 0, 8 * 63 });
  tree.Children.insert(tree.Children.end(), 8, 63);
  EXPECT_NE(brdf->SetTree(tree).find("above each other"), std::string::npos);
  tree = brdf->GetTree();
  tree.Children[0] = 1; // its own parent
  EXPECT_NE(brdf->SetTree(tree).find("children before their parents"), std::string::npos);
}

TEST(AngleBasis, RefusesRingsThatPassTheHorizon)
{
  vtkNew<vtkAngleBasisBRDF> brdf;
  const std::vector<float> rgb(3 * 2, 0.5f);
  EXPECT_EQ(brdf->SetMatrix({ { 30.0f, 90.0005f }, { 1, 1 } }, { { 90.0f }, { 1 } }, rgb), "");
  EXPECT_EQ(brdf->GetLightBasis().UpperTheta.back(), 90.0f);
  EXPECT_NE(brdf->SetMatrix({ { 89.9999f, 90.0005f }, { 1, 1 } }, { { 90.0f }, { 1 } }, rgb), "");
  EXPECT_NE(brdf->SetMatrix({ { 90.0f }, { 5000 } }, { { 90.0f }, { 1 } }, rgb), "");
}
