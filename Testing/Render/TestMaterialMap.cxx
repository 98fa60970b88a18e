// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of several materials: each pixel shows the mixture of what the materials show alone.

#include "MaterialMapFixture.h"

#include "vtkHybridRadianceIntegrator.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
// Whose direction is next to this one.
int FindTexel(vtkEnvironment* environment, const glm::dvec3& direction)
{
  int next = 0;
  double best = -1.0;
  const int width = environment->GetWidth();
  for (int texel = 0; texel < width * environment->GetHeight(); ++texel)
  {
    glm::dvec3 at;
    environment->GetTexelDirection(texel % width, texel / width, &at.x);
    const double cosine = glm::dot(at, direction);
    next = cosine > best ? texel : next;
    best = std::max(best, cosine);
  }
  return next;
}

// More materials than texture units could hold at once; exact up to the cells' borders.
TEST_F(MaterialMapping, ClassesOfCells)
{
  this->AddMaterials(20);
  this->SetCells([](vtkIdType cell, int) { return static_cast<double>((7 * cell) % 20); });
  this->RenderAlone();
  this->ExpectMixture([](const Place& place, int k)
    { return place.OnDiagonal ? -1.0 : ((7 * place.Cell) % 20 == k ? 1.0 : 0.0); });
}

TEST_F(MaterialMapping, ClassesOfPointsAreThoseOfTheNearest)
{
  this->AddMaterials(6);
  const auto classOf = [](vtkIdType point) { return static_cast<double>((5 * point) % 6); };
  this->SetPoints([&](vtkIdType point, int) { return classOf(point); });
  this->RenderAlone();
  this->ExpectMixture(
    [&](const Place& place, int k)
    {
      double shares[6] = {};
      for (int corner = 0; corner < 3; ++corner)
      {
        shares[static_cast<int>(classOf(place.Corners[corner]))] += place.Shares[corner];
      }
      std::vector<double> sorted(shares, shares + 6);
      std::sort(sorted.begin(), sorted.end());
      const bool close = sorted[5] - sorted[4] < 1e-4;
      return close || place.OnDiagonal ? -1.0 : (shares[k] == sorted[5] ? 1.0 : 0.0);
    });
}

TEST_F(MaterialMapping, ValuesBlendInEachPixel)
{
  this->AddMaterials(4);
  this->Map->RemoveAllMaterials();
  const double knots[4] = { -2.0, 1.0, 1.5, 9.0 };
  for (std::size_t k = 0; k < 4; ++k)
  {
    this->Map->AddMaterial(this->Materials[k], knots[k]);
  }
  // Steep: several of them within one triangle.
  this->SetPointValues(
    [](vtkIdType point) { return 4.0 * std::sin(0.7 * static_cast<double>(point)) + 2.0; });
  this->RenderAlone();
  this->ExpectValuesBlend();
}

TEST_F(MaterialMapping, ValuesOfCells)
{
  this->AddMaterials(2);
  this->Map->SetModeToValues();
  this->SetCells([](vtkIdType cell, int) { return 0.013 * static_cast<double>(cell); });
  this->RenderAlone();
  this->ExpectMixture(
    [&](const Place& place, int k)
    {
      return place.OnDiagonal ? -1.0
                              : this->Map->GetWeight(k, 0.013 * static_cast<double>(place.Cell));
    });
}

TEST_F(MaterialMapping, WeightsOfPoints)
{
  this->AddMaterials(5);
  this->Map->SetModeToWeights();
  const auto weightOf = [](vtkIdType point, int k)
  { return std::max(std::sin(0.3 * static_cast<double>(point) + 1.3 * k), 0.0); };
  this->SetPoints(weightOf, 5);
  this->RenderAlone();
  this->ExpectMixture(
    [&](const Place& place, int k)
    {
      return place.Interpolate(
        [&](vtkIdType point)
        {
          double sum = 0.0;
          for (int other = 0; other < 5; ++other)
          {
            sum += weightOf(point, other);
          }
          return weightOf(point, k) / sum;
        });
    },
    1e-4);
}

// Images as large as the window: a texel each pixel, so nothing is interpolated.
TEST_F(MaterialMapping, WeightsOfImages)
{
  this->AddMaterials(5);
  const auto weightOf = [](int x, int y, int k)
  { return k == (x / 5 + y / 3) % 5 ? 200 : (k == x % 5 ? 55 : 0); };
  for (int first : { 0, 3 })
  {
    this->AddWeightImage(Pixels, first == 0 ? 3 : 2, VTK_UNSIGNED_CHAR,
      [&](int x, int y, int c) { return weightOf(x, y, first + c); });
  }
  this->RenderAlone();
  this->ExpectMixture(
    [&](const Place& place, int k)
    {
      const int x = static_cast<int>(place.U * Pixels);
      const int y = static_cast<int>(place.V * Pixels);
      double sum = 0.0;
      for (int other = 0; other < 5; ++other)
      {
        sum += weightOf(x, y, other);
      }
      return weightOf(x, y, k) / sum;
    },
    2e-3); // texture coordinates are floats
}

// The mixture under a light of the scene, beside the sky.
TEST_F(MaterialMapping, SceneLights)
{
  this->AddMaterials(2);
  this->AddLight();
  this->SetPointValues([](vtkIdType point) { return 0.1 * static_cast<double>(point % 11); });
  this->RenderAlone();
  this->ExpectValuesBlend();
}

// Of lamps that lobes see as areas each material has a table of its own beside the hybrid's: where
// pixels look for lamps near the lobe's axis, and where they evaluate all of them.
TEST_F(MaterialMapping, LampsAsAreas)
{
  this->AddMaterials(3);
  for (int k = 0; k < 3; ++k)
  {
    auto* gloss = vtkBlinnPhongBRDF::SafeDownCast(this->Materials[k]->GetTerm(1));
    gloss->SetExponent(1500.0 * (k + 1));
    gloss->SetSpecular(0.02 * (k + 1), 0.02, 0.01);
  }
  this->SetPointValues([](vtkIdType point) { return 0.2 * static_cast<double>(point % 11); });
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  hybrid->SetSizes({ 17, 8, 8, 0, 16 });
  this->Mapper->SetIntegrator(hybrid);
  for (const int lamps : { 1, 5 })
  {
    constexpr int width = 128;
    std::vector<float> rgb(3 * width * width / 2, 0.05f);
    ASSERT_TRUE(this->Environment->SetPixels(width, width / 2, rgb));
    for (int k = 0; k < lamps; ++k) // where the sheet mirrors
    {
      const glm::dvec3 n = glm::normalize(glm::dvec3(0.14 * k - 0.2, 0.1 * k - 0.3, 1.0));
      const int texel = FindTexel(this->Environment, 2.0 * n.z * n - glm::dvec3(0.0, 0.0, 1.0));
      std::fill_n(&rgb[3 * texel], 3, 300.0f);
    }
    ASSERT_TRUE(this->Environment->SetPixels(width, width / 2, rgb));
    hybrid->SetBRDF(this->Materials[0]);
    hybrid->SetEnvironment(this->Environment);
    ASSERT_TRUE(hybrid->Prepare());
    ASSERT_EQ(hybrid->GetNumberOfLights(), lamps);
    ASSERT_FALSE(hybrid->UsesBRDFOnGPU()); // but the table of means
    this->Mapper->SetMaterialMap(nullptr);
    this->Alone.clear();
    this->RenderAlone();
    this->ExpectValuesBlend();
    float brightest = 0.0f;
    for (std::size_t p = 0; p < this->Alone[2].RGBA.size(); p += 4)
    {
      brightest = std::max(brightest, this->Alone[2].RGBA[p]);
    }
    EXPECT_GT(brightest, 1.0f); // a lamp is seen
  }
}
}
