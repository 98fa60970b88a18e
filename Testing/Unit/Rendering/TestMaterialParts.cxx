// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// How a material map divides a surface: which materials meet where, and how much of it is of each.

#include "MaterialParts.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialMap.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStripper.h"
#include "vtkTriangleFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace
{
using measuredbrdf::MaterialPart;
using measuredbrdf::MaterialParts;
using measuredbrdf::MixtureKind;

constexpr int Side = 10; // quads along an edge of the plane, whose area is 1

class Parts : public testing::Test
{
protected:
  void SetUp() override
  {
    this->SetResolution(Side);
    for (int k = 0; k < 40; ++k)
    {
      this->Materials.push_back(vtkSmartPointer<vtkLambertBRDF>::New());
    }
    this->Map->SetArrayName("data");
  }

  /// Of each cell or point.
  template <typename Function>
  void SetData(vtkDataSetAttributes* data, vtkIdType tuples, const Function& value)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName("data");
    for (vtkIdType k = 0; k < tuples; ++k)
    {
      array->InsertNextValue(value(k));
    }
    data->AddArray(array);
    this->Plane->Modified();
  }
  template <typename Function>
  void SetCells(const Function& value)
  {
    this->SetData(this->Plane->GetCellData(), this->Plane->GetNumberOfCells(), value);
  }
  template <typename Function>
  void SetPoints(const Function& value)
  {
    this->SetData(this->Plane->GetPointData(), this->Plane->GetNumberOfPoints(), value);
  }
  /// Of each point and component.
  template <typename Function>
  void SetWeights(int components, const Function& value)
  {
    vtkNew<vtkFloatArray> weights;
    weights->SetName("data");
    weights->SetNumberOfComponents(components);
    weights->SetNumberOfTuples(this->Plane->GetNumberOfPoints());
    for (vtkIdType k = 0; k < weights->GetNumberOfValues(); ++k)
    {
      weights->SetValue(k, static_cast<float>(value(k / components, k % components)));
    }
    this->Plane->GetPointData()->AddArray(weights);
    this->Map->SetModeToWeights();
    this->AddMaterials(components);
  }
  void SetResolution(int side)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetResolution(side, side);
    plane->Update();
    this->Plane->ShallowCopy(plane->GetOutput());
  }
  /// Nothing else.
  void SetPolygon(const std::vector<std::array<double, 2>>& corners)
  {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> polygon;
    polygon->InsertNextCell(static_cast<int>(corners.size()));
    for (const auto& [x, y] : corners)
    {
      polygon->InsertCellPoint(points->InsertNextPoint(x, y, 0.0));
    }
    this->Plane->Initialize();
    this->Plane->SetPoints(points);
    this->Plane->SetPolys(polygon);
  }
  /// On a scale of values.
  void AddMaterials(int count, double step)
  {
    this->Map->SetModeToValues();
    for (int k = 0; k < count; ++k)
    {
      this->Map->AddMaterial(this->Materials[k % 40], step * k);
    }
  }
  void AddMaterials(int count)
  {
    for (int k = 0; k < count; ++k)
    {
      this->Map->AddMaterial(this->Materials[k]);
    }
  }

  std::string Update(vtkBRDF* others = nullptr)
  {
    return this->Divided.Update(this->Plane, this->Map, others, this->Warning);
  }
  vtkIdType CountPolygons() const
  {
    vtkIdType count = 0;
    for (const MaterialPart& part : this->Divided.Get())
    {
      count += part.IsRest ? 0 : part.Surface->GetNumberOfPolys();
    }
    return count;
  }
  double GetShare(int material) const { return this->Divided.GetShare(this->Materials[material]); }

  vtkNew<vtkPolyData> Plane;
  vtkNew<vtkMaterialMap> Map;
  std::vector<vtkSmartPointer<vtkLambertBRDF>> Materials;
  MaterialParts Divided;
  std::string Warning;
};

TEST_F(Parts, ClassesOfCellsAreOnePartEach)
{
  this->SetCells([](vtkIdType cell) { return cell % 5; });
  this->AddMaterials(4); // 4 is of no material
  ASSERT_EQ(this->Update(), "");
  EXPECT_EQ(this->Divided.Get().size(), 5u);
  EXPECT_EQ(this->CountPolygons(), Side * Side);
  int without = 0;
  for (const MaterialPart& part : this->Divided.Get())
  {
    EXPECT_EQ(part.Kind, MixtureKind::Single);
    EXPECT_EQ(part.Surface->GetNumberOfPolys(), 20);
    EXPECT_EQ(part.Surface->GetPoints(), this->Plane->GetPoints()); // shared, not copied
    without += part.Members.empty() ? 1 : 0;
    vtkDataArray* data = part.Surface->GetCellData()->GetArray("data"); // the cells' own
    ASSERT_EQ(data->GetNumberOfTuples(), 20);
    EXPECT_EQ(data->GetRange()[0], data->GetRange()[1]);
  }
  EXPECT_EQ(without, 1);
  EXPECT_NEAR(this->GetShare(2), 0.25, 1e-6); // of what has a material
  EXPECT_EQ(this->Divided.GetBRDFs().size(), 4u);
}

TEST_F(Parts, UnknownClassesAreOfTheOtherMaterial)
{
  this->SetCells([](vtkIdType cell) { return cell % 2 ? std::nan("") : cell % 4; });
  this->AddMaterials(1);
  ASSERT_EQ(this->Update(this->Materials[7]), "");
  EXPECT_EQ(this->Divided.Get().size(), 2u);
  EXPECT_NEAR(this->GetShare(0), 0.25, 0.06);
  EXPECT_NEAR(this->GetShare(7), 0.75, 0.06);
}

TEST_F(Parts, ValuesMeetWhereTheirHatsOverlap)
{
  // From 0 to 10 across: materials at 0, 5 and 10.
  this->SetPoints([](vtkIdType point) { return static_cast<double>(point % (Side + 1)); });
  this->AddMaterials(3, 5.0);
  ASSERT_EQ(this->Update(), "");
  ASSERT_EQ(this->Divided.Get().size(), 2u);
  for (const MaterialPart& part : this->Divided.Get())
  {
    EXPECT_EQ(part.Members.size(), 2u);
    EXPECT_EQ(part.Surface->GetNumberOfPolys(), Side * Side / 2);
  }
  EXPECT_NEAR(this->GetShare(0), 0.25, 1e-6);
  EXPECT_NEAR(this->GetShare(1), 0.5, 1e-6);
}

// Each quad goes beyond both ends of the scale: it is cut where a material is alone.
TEST_F(Parts, ManyMaterialsOfAScaleInOnePolygonAreCut)
{
  this->SetPoints([](vtkIdType point) { return (point % (Side + 1)) % 2 ? 45.0 : -3.0; });
  this->AddMaterials(40, 1.0);
  ASSERT_EQ(this->Update(), "");
  EXPECT_EQ(this->Warning, "");
  EXPECT_LE(this->Divided.Get().size(),
    static_cast<std::size_t>(MaterialParts::WantedNumberOfParts) + 2u); // and both ends
  EXPECT_EQ(this->Divided.GetBRDFs().size(), 40u);
  EXPECT_EQ(this->CountPolygons(), 2 * 41 * Side * Side);
  for (const MaterialPart& part : this->Divided.Get())
  {
    EXPECT_LE(part.Members.size(), 5u);
  }
  EXPECT_NEAR(this->GetShare(0), 3.5 / 48.0, 1e-3);
  EXPECT_NEAR(this->GetShare(20), 1.0 / 48.0, 1e-3);
  EXPECT_NEAR(this->GetShare(39), 6.5 / 48.0, 1e-3);
}

// The second image's only texel with a weight lies between the first's; the third's shares.
TEST_F(Parts, ImagesMayDifferInSize)
{
  const auto addImage = [this](int side, int x, int y, double value)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(side, side, 1);
    image->AllocateScalars(VTK_FLOAT, 1);
    image->GetPointData()->GetScalars()->Fill(x < 0 ? value : 0.0);
    if (x >= 0)
    {
      image->SetScalarComponentFromDouble(x, y, 0, 0, value);
    }
    this->Map->AddWeightImage(image);
  };
  this->Map->SetModeToTextures();
  this->AddMaterials(2);
  addImage(2, -1, -1, 1.0);
  addImage(7, 5, 5, 1.0);
  ASSERT_EQ(this->Update(), "");
  ASSERT_EQ(this->Divided.Get().size(), 1u);
  EXPECT_EQ(this->Divided.Get()[0].Members.size(), 2u);
  // The integral of w / (1 + w) over a bilinear hat of 2 x 2 texels: by sampling it.
  double expected = 0.0;
  constexpr int steps = 400;
  for (int y = 0; y < steps; ++y)
  {
    for (int x = 0; x < steps; ++x)
    {
      const double w = (1.0 - std::abs(2.0 * (x + 0.5) / steps - 1.0)) *
                       (1.0 - std::abs(2.0 * (y + 0.5) / steps - 1.0));
      expected += w / (1.0 + w) / (steps * steps) * 4.0 / 49.0;
    }
  }
  EXPECT_NEAR(this->GetShare(1), expected, 0.3 * expected);
  // Nowhere but in one corner of the second image is a weight: the rest is of no material.
  this->Map->RemoveAllWeightImages();
  addImage(3, 0, 0, 0.0);
  addImage(8, 1, 1, 1.0);
  ASSERT_EQ(this->Update(this->Materials[9]), "");
  EXPECT_GT(this->GetShare(9), 0.9);
  EXPECT_GT(this->GetShare(1), 0.0);
  EXPECT_EQ(this->GetShare(0), 0.0);
}

TEST_F(Parts, AllOnOneKnotIsOneMaterial)
{
  this->SetPoints([](vtkIdType) { return 5.0; });
  this->AddMaterials(3, 5.0);
  ASSERT_EQ(this->Update(), "");
  ASSERT_EQ(this->Divided.Get().size(), 1u);
  EXPECT_EQ(this->Divided.Get()[0].Kind, MixtureKind::Single);
  EXPECT_EQ(this->Divided.Get()[0].Members[0], this->Materials[1]);
}

TEST_F(Parts, WeightsAreDividedByTheirSum)
{
  this->SetWeights(
    2, [](vtkIdType p, vtkIdType k) { return k == 0 ? 3.0 : (p == 0 ? -1.0 : 1.0); });
  ASSERT_EQ(this->Update(), "");
  EXPECT_NE(this->Warning.find("1 weights"), std::string::npos) << this->Warning;
  ASSERT_EQ(this->Divided.Get().size(), 1u);
  EXPECT_NEAR(this->GetShare(0), 0.75, 1e-3);
  vtkDataArray* stored = this->Divided.Get()[0].Surface->GetPointData()->GetArray(
    measuredbrdf::partarrays::GetWeights(0).c_str());
  EXPECT_NEAR(stored->GetComponent(0, 0), 1.0, 1e-6);
  EXPECT_NEAR(stored->GetComponent(5, 0), 0.75, 1e-6);
  EXPECT_NEAR(stored->GetComponent(5, 1), 0.25, 1e-6);
}

// 30 materials in random threes: 4,060 sets.
TEST_F(Parts, ManySetsAreMerged)
{
  this->SetResolution(40);
  this->SetWeights(30,
    [](vtkIdType p, vtkIdType material)
    {
      double weight = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        weight = (7 * p * p + 11 * k * p + 3 * k) % 30 == material ? 1.0 : weight;
      }
      return weight;
    });
  ASSERT_EQ(this->Update(), "");
  EXPECT_LE(
    this->Divided.Get().size(), static_cast<std::size_t>(MaterialParts::WantedNumberOfParts));
  EXPECT_EQ(this->CountPolygons(), 1600);
  double sum = 0.0;
  for (int k = 0; k < 30; ++k)
  {
    sum += this->GetShare(k);
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
  // Each polygon's weights are all there.
  for (const MaterialPart& part : this->Divided.Get())
  {
    for (vtkIdType p = 0; p < part.Surface->GetNumberOfPolys(); ++p)
    {
      vtkNew<vtkIdList> corners;
      part.Surface->GetCellPoints(p, corners);
      double total = 0.0;
      for (int slot = 0; slot < part.NumberOfWeights; ++slot)
      {
        total += part.Surface->GetPointData()
                   ->GetArray(measuredbrdf::partarrays::GetWeights(slot / 4).c_str())
                   ->GetComponent(corners->GetId(0), slot % 4);
      }
      ASSERT_NEAR(total, 1.0, 1e-6);
    }
  }
}

TEST_F(Parts, TooManyWeightsInOnePlaceAreCutAndSaid)
{
  this->SetWeights(40, [](vtkIdType, vtkIdType k) { return k == 39 ? 5.0 : 1.0; });
  ASSERT_EQ(this->Update(), "");
  EXPECT_NE(this->Warning.find("more than 32"), std::string::npos) << this->Warning;
  ASSERT_EQ(this->Divided.Get().size(), 1u);
  EXPECT_EQ(this->Divided.Get()[0].Members.size(), 32u);
  EXPECT_EQ(this->Divided.Get()[0].Members.back(), this->Materials[39]);
}

// Triangles of the plane's squares: a place is of the class of the largest sum of its corners'
// shares. Where two meet, the lone corner has a quarter; where three meet, each has a third.
TEST_F(Parts, BordersBetweenClassesOfPointsAreCut)
{
  this->AddMaterials(3);
  this->SetPolygon({ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } });
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (int k = 0; k < 4; ++k)
  {
    normals->InsertNextTuple3(k, 1.0, 2.0);
  }
  this->Plane->GetPointData()->SetNormals(normals);
  vtkNew<vtkFloatArray> tooShort; // which VTK's mapper does not read
  tooShort->SetName("too short");
  tooShort->InsertNextValue(1.0f);
  this->Plane->GetPointData()->AddArray(tooShort);
  this->SetPoints([](vtkIdType point) { return std::max(static_cast<double>(point) - 1.0, 0.0); });
  // Triangles 0 1 2 of classes 0 0 1, and 0 2 3 of classes 0 1 2.
  ASSERT_EQ(this->Update(), "");
  ASSERT_EQ(this->Divided.Get().size(), 3u);
  EXPECT_EQ(this->CountPolygons(), 5);
  EXPECT_NEAR(this->GetShare(0), 0.75 / 2 + 1.0 / 6, 1e-6);
  EXPECT_NEAR(this->GetShare(1), 0.25 / 2 + 1.0 / 6, 1e-6);
  EXPECT_NEAR(this->GetShare(2), 1.0 / 6, 1e-6);
  for (const MaterialPart& part : this->Divided.Get())
  {
    EXPECT_EQ(part.Kind, MixtureKind::Single);
    // Four points, four middles of edges (the diagonal's is one) and a center.
    ASSERT_EQ(part.Surface->GetNumberOfPoints(), 9);
    EXPECT_FALSE(part.Surface->GetPointData()->HasArray("too short"));
    for (vtkIdType p = 4; p < 9; ++p)
    {
      // The normals are linear: x is 0, 1, 2, 3 at the corners.
      const double* at = part.Surface->GetPoint(p);
      const double expected = at[0] > at[1] ? 0.5 * (at[0] + at[1]) : 1.5 * at[1] - 0.5 * at[0];
      double normal[3];
      part.Surface->GetPointData()->GetNormals()->GetTuple(p, normal);
      EXPECT_NEAR(normal[0], expected, 1e-6) << at[0] << " " << at[1];
      EXPECT_EQ(normal[2], 2.0);
    }
  }
}

TEST_F(Parts, StripsAreTrianglesOfTheSameClass)
{
  this->SetCells([](vtkIdType cell) { return cell < Side * Side / 2 ? 0.0 : 1.0; });
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(this->Plane);
  triangles->PassVertsOff();
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(triangles->GetOutputPort());
  stripper->PassCellDataAsFieldDataOff();
  stripper->Update();
  this->Plane->ShallowCopy(stripper->GetOutput());
  ASSERT_GT(this->Plane->GetNumberOfStrips(), 0);
  vtkCellArray* strips = this->Plane->GetStrips(); // two more that show nothing
  strips->InsertNextCell(0);
  strips->InsertNextCell({ 0 });
  this->SetCells([](vtkIdType cell) { return cell % 2; });
  this->AddMaterials(2);
  ASSERT_EQ(this->Update(), "");
  EXPECT_EQ(this->CountPolygons(), 2 * Side * Side);
  EXPECT_NEAR(this->GetShare(0) + this->GetShare(1), 1.0, 1e-6);
  // All wind as the plane does: z of each normal is positive.
  for (const MaterialPart& part : this->Divided.Get())
  {
    for (vtkIdType k = 0; k < part.Surface->GetNumberOfPolys(); ++k)
    {
      vtkNew<vtkIdList> corners;
      part.Surface->GetCellPoints(k, corners);
      double a[3];
      double b[3];
      double c[3];
      part.Surface->GetPoint(corners->GetId(0), a);
      part.Surface->GetPoint(corners->GetId(1), b);
      part.Surface->GetPoint(corners->GetId(2), c);
      EXPECT_GT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0.0);
    }
  }
}

TEST_F(Parts, DividesAnewOnlyWhereItHasTo)
{
  this->SetCells([](vtkIdType cell) { return cell % 2; });
  this->AddMaterials(2);
  ASSERT_EQ(this->Update(), "");
  const unsigned long revision = this->Divided.GetRevision();
  this->Materials[0]->SetAlbedo(0.1, 0.1, 0.1);
  this->Update();
  EXPECT_EQ(this->Divided.GetRevision(), revision);
  this->Plane->Modified();
  this->Update();
  EXPECT_GT(this->Divided.GetRevision(), revision);
}

TEST_F(Parts, WhatDoesNotFitIsSaid)
{
  const auto expect = [this](const std::string& part)
  {
    this->Map->Modified();
    const std::string problem = this->Update();
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
    EXPECT_TRUE(this->Divided.Get().empty());
  };
  expect("no materials");
  this->AddMaterials(2);
  expect("no point or cell array \"data\"");
  this->Map->SetArrayName("");
  this->Plane->GetPointData()->SetActiveScalars(nullptr);
  expect("active scalars");
  this->Map->SetArrayName("data");
  this->SetData(this->Plane->GetPointData(), 7, [](vtkIdType) { return 0.0; });
  expect("has 7 tuples for 121 points");
  this->SetPoints([](vtkIdType) { return 0.0; });
  this->Map->SetArrayComponent(3);
  expect("component 3");
  this->Map->SetArrayComponent(0);
  this->Map->SetModeToWeights();
  expect("component 1");
  this->Map->SetModeToTextures();
  expect("0 components for 2 materials");
  vtkNew<vtkImageData> image;
  this->Map->AddWeightImage(image);
  expect("weight image 0 is not an image");
  this->Plane->GetPointData()->SetTCoords(nullptr);
  expect("texture coordinates");
  this->Map->AddMaterial(nullptr);
  expect("has no BRDF");
}

TEST_F(Parts, EmptySurfaces)
{
  this->Plane->Initialize();
  vtkNew<vtkPoints> points;
  this->Plane->SetPoints(points);
  this->SetPoints([](vtkIdType) { return 0.0; });
  this->AddMaterials(1);
  EXPECT_EQ(this->Update(), "");
  EXPECT_EQ(this->CountPolygons(), 0);
  EXPECT_EQ(this->GetShare(0), 0.0);
}
}
