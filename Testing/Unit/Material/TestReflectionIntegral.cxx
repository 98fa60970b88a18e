// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Albedos, reflectances and transmittances against dense sums.

#include "SharedData.h"
#include "TestDirections.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDF.h"
#include "vtkBRDFAnalysis.h"
#include "vtkBRDFReader.h"
#include "vtkBTDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTensorTreeBRDF.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace
{
constexpr double HalfTurn = 3.14159265358979323846;

glm::dvec3 GetDirection(double degrees, double azimuth = 0.0)
{
  return FromAngles(degrees * HalfTurn / 180.0, azimuth);
}

// Over half vectors, by the midpoint rule: rows crowd towards the normal, where lobes are narrow. d
// = 2 (g.h) h - g with dd = 4 (g.h) dh. views: the direction d that is summed over is the view,
// else the light.
glm::dvec3 SumAll(vtkBRDF* brdf, const glm::dvec3& given, bool views, int rows)
{
  const bool half = brdf->IsIsotropic(); // and symmetric about the plane of azimuth 0
  const int columns = half ? rows : 2 * rows;
  glm::dvec3 sum(0.0);
  for (int y = 0; y < rows; ++y)
  {
    const double u = (y + 0.5) / rows;
    const double theta = 0.5 * HalfTurn * u * u;
    for (int x = 0; x < columns; ++x)
    {
      const double phi = (half ? 1.0 : 2.0) * HalfTurn * (x + 0.5) / columns;
      const glm::dvec3 h = FromAngles(theta, phi);
      const double cosine = glm::dot(given, h);
      const glm::dvec3 d = 2.0 * cosine * h - given;
      if (cosine > 0.0 && d.z > 0.0)
      {
        const glm::dvec3 f = views ? Evaluate(brdf, given, d) : Evaluate(brdf, d, given);
        sum += f * (d.z * 4.0 * cosine * std::sin(theta) * HalfTurn * u);
      }
    }
  }
  return sum * (2.0 * HalfTurn / rows / columns);
}

struct LargestError
{
  double Error = 0.0;
  std::string Where;

  void Add(const glm::dvec3& found, const glm::dvec3& expected, const std::string& where)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double error = std::abs(found[c] - expected[c]) / std::max(expected[c], 1e-9);
      if (error > this->Error)
      {
        this->Error = error;
        this->Where = where;
      }
    }
  }
};

LargestError CheckAlbedos(
  vtkBRDF* brdf, const std::string& name, const std::vector<double>& angles, int rows)
{
  LargestError largest;
  brdf->Prepare();
  for (const double degrees : angles)
  {
    const glm::dvec3 o = GetDirection(degrees);
    glm::dvec3 albedo;
    brdf->GetDirectionalAlbedo(&o.x, &albedo.x);
    largest.Add(
      albedo, SumAll(brdf, o, false, rows), name + " at " + std::to_string(degrees) + " degrees");
  }
  return largest;
}
}

//------------------------------------------------------------------------------
TEST(ReflectionIntegral, IsWithinItsToleranceForModels)
{
  std::vector<std::pair<std::string, vtkSmartPointer<vtkBRDF>>> materials;
  for (const char* name : { "pink-felt", "violet-rubber", "cherry-235", "nickel", "blue-rubber" })
  {
    materials.emplace_back(
      name, vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name)));
  }
  vtkNew<vtkBlinnPhongBRDF> blinn;
  blinn->SetExponent(3000.0);
  materials.emplace_back("Blinn-Phong", blinn);
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(100.0, 1000.0);
  materials.emplace_back("brushed", brushed);
  vtkNew<vtkDistributionBRDF> distribution;
  distribution->SetBlinnDistribution(500.0);
  materials.emplace_back("distribution", distribution);
  for (const auto& [name, brdf] : materials)
  {
    const LargestError largest = CheckAlbedos(brdf, name, { 0.0, 45.0, 80.0 }, 400);
    EXPECT_LT(largest.Error, 1e-3) << largest.Where;
  }
}

//------------------------------------------------------------------------------
TEST(ReflectionIntegral, IsWithinItsToleranceForMeasuredMaterials)
{
  const std::string folder = SharedData + "/materials/rgl";
  if (!std::filesystem::exists(folder))
  {
    GTEST_SKIP() << folder << " is not there";
  }
  for (const auto& file : std::filesystem::directory_iterator(folder))
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(file.path().string());
    ASSERT_TRUE(reader->Read());
    const LargestError largest =
      CheckAlbedos(reader->GetBRDF(), file.path().stem().string(), { 10.0, 60.0, 80.0 }, 400);
    EXPECT_LT(largest.Error, 1e-3) << largest.Where;
  }
}

//------------------------------------------------------------------------------
// A lobe and steep values, in a table that is not reciprocal: the reflectance is another integral.
TEST(ReflectionIntegral, AnalysisHasBothWithinTheTolerance)
{
  const auto paint =
    vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("blue-car-paint"));
  ASSERT_TRUE(paint);
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetBRDF(paint);
  const double angles[3] = { 20.0, 60.0, 80.0 };
  analysis->SetAngles(3, angles);
  analysis->SetNumberOfPairs(100);
  ASSERT_TRUE(analysis->Update());
  LargestError largest;
  for (int k = 0; k < 3; ++k)
  {
    glm::dvec3 albedo, reflectance;
    analysis->GetAlbedo(k, &albedo.x);
    analysis->GetReflectance(k, &reflectance.x);
    const glm::dvec3 d = GetDirection(angles[k]);
    largest.Add(albedo, SumAll(paint, d, false, 500), "albedo at " + std::to_string(angles[k]));
    largest.Add(
      reflectance, SumAll(paint, d, true, 500), "reflectance at " + std::to_string(angles[k]));
  }
  EXPECT_LT(largest.Error, 1e-3) << largest.Where;
}

//------------------------------------------------------------------------------
// One bright cell of 128 x 128, which no sampling knows of, beside the mirror direction; its
// transmittance, too, straight through.
TEST(ReflectionIntegral, FindsCellsOfTrees)
{
  constexpr int side = 128;
  vtkTensorTreeBRDF::Tree tree;
  tree.Dimensions = 3;
  tree.Nodes = { { side, 0 } };
  tree.Values.assign(std::size_t(side) * side * side, 0.05f);
  // The view at 45 degrees, continued: row (1/2 - sin / 2) side. Light from the mirror direction.
  const glm::dvec3 o = GetDirection(45.0, HalfTurn);
  const int row = static_cast<int>((0.5 - 0.5 * std::sin(HalfTurn / 4.0)) * side);
  const int a = static_cast<int>(0.5 * (std::sin(HalfTurn / 4.0) + 1.0) * side);
  const int b = side / 2;
  tree.Values[(std::size_t(row) * side + static_cast<std::size_t>(a)) * side +
              static_cast<std::size_t>(b)] = 4000.0f;
  vtkNew<vtkTensorTreeBRDF> brdf;
  ASSERT_EQ(brdf->SetTree(tree), "");
  const double expected = HalfTurn * (0.05 + 4000.0 / (1.0 * side * side));
  glm::dvec3 albedo;
  brdf->GetDirectionalAlbedo(&o.x, &albedo.x);
  EXPECT_NEAR(albedo.x, expected, 1e-4 * expected);
  vtkNew<vtkBTDF> btdf;
  btdf->SetFolded(vtkBTDF::FRONT, brdf);
  const glm::dvec3 below(o.x, o.y, -o.z);
  btdf->GetSkyTransmittance(&below.x, &albedo.x);
  EXPECT_NEAR(albedo.x, expected, 1e-4 * expected);
}
