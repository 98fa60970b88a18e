// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of several materials: each pixel shows the mixture of what the materials show alone.

#include "EventCounter.h"
#include "RenderFixture.h"

#include "vtkBlinnPhongBRDF.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkMaterialMap.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace
{
constexpr int Side = 8;       // squares along an edge; 8 x 8 pixels each
constexpr int Pixels = 64;    // of the window
constexpr double Same = 2e-5; // relative, in linear radiance

/// A square that fills the window, bulging so that normals differ, of squares in two triangles.
vtkSmartPointer<vtkPolyData> NewSheet()
{
  auto sheet = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkFloatArray> coordinates;
  normals->SetNumberOfComponents(3);
  coordinates->SetNumberOfComponents(2);
  for (int y = 0; y <= Side; ++y)
  {
    for (int x = 0; x <= Side; ++x)
    {
      const double u = static_cast<double>(x) / Side;
      const double v = static_cast<double>(y) / Side;
      points->InsertNextPoint(2.0 * u - 1.0, 2.0 * v - 1.0, 0.0);
      const double n[3] = { u - 0.4, v - 0.7, 1.0 };
      const double length = std::hypot(n[0], n[1], n[2]);
      normals->InsertNextTuple3(n[0] / length, n[1] / length, n[2] / length);
      coordinates->InsertNextTuple2(u, v);
    }
  }
  vtkNew<vtkCellArray> triangles;
  for (int y = 0; y < Side; ++y)
  {
    for (int x = 0; x < Side; ++x)
    {
      const vtkIdType p = y * (Side + 1) + x;
      const vtkIdType first[3] = { p, p + 1, p + Side + 2 };
      const vtkIdType second[3] = { p, p + Side + 2, p + Side + 1 };
      triangles->InsertNextCell(3, first);
      triangles->InsertNextCell(3, second);
    }
  }
  sheet->SetPoints(points);
  sheet->SetPolys(triangles);
  sheet->GetPointData()->SetNormals(normals);
  sheet->GetPointData()->SetTCoords(coordinates);
  return sheet;
}

/// Where a pixel's center is: the triangle and its corners' shares.
struct Place
{
  Place(int column, int row)
  {
    this->U = (column + 0.5) / Pixels;
    this->V = (row + 0.5) / Pixels;
    const int x = column / (Pixels / Side);
    const int y = row / (Pixels / Side);
    const double u = this->U * Side - x;
    const double v = this->V * Side - y;
    const bool lower = u > v;
    this->Cell = 2 * (y * Side + x) + (lower ? 0 : 1);
    const vtkIdType p = y * (Side + 1) + x;
    this->Corners[0] = p;
    this->Corners[1] = lower ? p + 1 : p + Side + 2;
    this->Corners[2] = lower ? p + Side + 2 : p + Side + 1;
    this->Shares[0] = 1.0 - std::max(u, v);
    this->Shares[1] = lower ? u - v : u;
    this->Shares[2] = lower ? v : v - u;
    this->OnDiagonal = std::abs(u - v) < 1e-6; // either triangle's
  }

  template <typename Function>
  double Interpolate(const Function& atPoint) const
  {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      sum += this->Shares[k] * atPoint(this->Corners[k]);
    }
    return sum;
  }

  double U;
  double V;
  vtkIdType Cell;
  vtkIdType Corners[3];
  double Shares[3];
  bool OnDiagonal;
};

class MaterialMapping : public RenderFixture
{
protected:
  void SetUp() override
  {
    RenderFixture::SetUp();
    if (IsSkipped())
    {
      return;
    }
    this->Sheet = NewSheet();
    this->Environment->SetToProceduralSky();
    this->Table->SetNumberOfRows(17);
    this->Mapper->SetInputData(this->Sheet);
    this->Mapper->SetEnvironment(this->Environment);
    this->Mapper->SetIntegrator(this->Table); // the same for a material alone and in a mixture
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Map->SetArrayName("data");
  }

  void AddMaterials(int count)
  {
    for (int k = 0; k < count; ++k)
    {
      vtkNew<vtkLambertBRDF> diffuse;
      diffuse->SetAlbedo(0.1 + 0.8 * ((3 * k) % 7) / 7.0, 0.1 + 0.8 * ((2 * k) % 5) / 5.0, 0.1);
      vtkNew<vtkBlinnPhongBRDF> gloss;
      gloss->SetSpecular(0.05, 0.05, 0.02 * (k % 4));
      gloss->SetExponent(5.0 + 7.0 * (k % 3));
      auto brdf = vtkSmartPointer<vtkSumBRDF>::New();
      brdf->AddTerm(diffuse);
      brdf->AddTerm(gloss);
      this->Materials.push_back(brdf);
      this->Map->AddMaterial(brdf);
    }
  }

  void SetArray(vtkDataSetAttributes* data, vtkIdType tuples, int components,
    const std::function<double(vtkIdType, int)>& value)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName("data");
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(tuples);
    for (vtkIdType k = 0; k < tuples; ++k)
    {
      for (int c = 0; c < components; ++c)
      {
        array->SetComponent(k, c, value(k, c));
      }
    }
    data->AddArray(array);
    this->Sheet->Modified();
  }
  void SetCells(const std::function<double(vtkIdType, int)>& value)
  {
    this->SetArray(this->Sheet->GetCellData(), 2 * Side * Side, 1, value);
  }
  void SetPoints(const std::function<double(vtkIdType, int)>& value, int components = 1)
  {
    this->SetArray(this->Sheet->GetPointData(), (Side + 1) * (Side + 1), components, value);
  }

  /// What each material shows alone.
  void RenderAlone()
  {
    for (const auto& brdf : this->Materials)
    {
      this->Mapper->SetBRDF(brdf);
      this->Alone.push_back(this->RenderLinear());
    }
    this->Mapper->SetBRDF(nullptr);
    this->Mapper->SetMaterialMap(this->Map);
  }

  /// weight: of a material at a place; negative for all: the place is not looked at.
  void ExpectMixture(
    const std::function<double(const Place&, int)>& weight, double tolerance = Same)
  {
    const FloatImage mixed = this->RenderLinear();
    int compared = 0;
    for (int y = 0; y < Pixels; ++y)
    {
      for (int x = 0; x < Pixels; ++x)
      {
        const Place place(x, y);
        double expected[3] = { 0.0, 0.0, 0.0 };
        bool skipped = false;
        for (std::size_t k = 0; k < this->Materials.size(); ++k)
        {
          const double w = weight(place, static_cast<int>(k));
          skipped = skipped || w < 0.0;
          for (int c = 0; c < 3; ++c)
          {
            expected[c] += w * this->Alone[k].At(x, y)[c];
          }
        }
        compared += skipped ? 0 : 1;
        for (int c = 0; c < 3 && !skipped; ++c)
        {
          ASSERT_NEAR(mixed.At(x, y)[c], expected[c], tolerance * (1.0 + expected[c]))
            << x << " " << y;
        }
      }
    }
    EXPECT_GT(compared, Pixels * Pixels * 3 / 4);
  }

  vtkSmartPointer<vtkPolyData> Sheet;
  vtkNew<vtkEnvironment> Environment;
  vtkNew<vtkTableRadianceIntegrator> Table;
  vtkNew<vtkMaterialMap> Map;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
  std::vector<vtkSmartPointer<vtkSumBRDF>> Materials;
  std::vector<FloatImage> Alone;
};

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
  this->Map->SetModeToValues();
  const double knots[4] = { -2.0, 1.0, 1.5, 9.0 };
  for (std::size_t k = 0; k < 4; ++k)
  {
    this->Map->AddMaterial(this->Materials[k], knots[k]);
  }
  // Steep: several of them within one triangle.
  const auto valueOf = [](vtkIdType point)
  { return 4.0 * std::sin(0.7 * static_cast<double>(point)) + 2.0; };
  this->SetPoints([&](vtkIdType point, int) { return valueOf(point); });
  this->RenderAlone();
  this->ExpectMixture([&](const Place& place, int k)
    { return this->Map->GetWeight(k, place.Interpolate(valueOf)); },
    1e-4);
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

TEST_F(MaterialMapping, WeightsOfSingleArrays)
{
  this->AddMaterials(2);
  this->Map->SetModeToWeights();
  for (int k = 0; k < 2; ++k)
  {
    this->SetPoints(
      [k](vtkIdType point, int) { return k == 0 ? 1.0 : 0.1 * static_cast<double>(point % 7); });
    const std::string name = "weight " + std::to_string(k);
    this->Sheet->GetPointData()->GetArray("data")->SetName(name.c_str());
    this->Map->SetWeightArrayName(k, name);
  }
  this->RenderAlone();
  this->ExpectMixture(
    [&](const Place& place, int k)
    {
      return place.Interpolate(
        [k](vtkIdType point)
        {
          const double other = 0.1 * static_cast<double>(point % 7);
          return (k == 0 ? 1.0 : other) / (1.0 + other);
        });
    },
    1e-4);
}

// Images as large as the window: a texel each pixel, so nothing is interpolated.
TEST_F(MaterialMapping, WeightsOfImages)
{
  this->AddMaterials(5);
  this->Map->SetModeToTextures();
  const auto weightOf = [](int x, int y, int k)
  { return k == (x / 5 + y / 3) % 5 ? 200 : (k == x % 5 ? 55 : 0); };
  for (int first : { 0, 3 })
  {
    const int components = first == 0 ? 3 : 2;
    vtkNew<vtkImageData> image;
    image->SetDimensions(Pixels, Pixels, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
    for (int y = 0; y < Pixels; ++y)
    {
      for (int x = 0; x < Pixels; ++x)
      {
        for (int c = 0; c < components; ++c)
        {
          image->SetScalarComponentFromDouble(x, y, 0, c, weightOf(x, y, first + c));
        }
      }
    }
    this->Map->AddWeightImage(image);
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
  this->Map->SetModeToValues();
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(1.0, 2.0, 4.0);
  this->Renderer->AddLight(light);
  const auto valueOf = [](vtkIdType point) { return 0.1 * static_cast<double>(point % 11); };
  this->SetPoints([&](vtkIdType point, int) { return valueOf(point); });
  this->RenderAlone();
  this->ExpectMixture([&](const Place& place, int k)
    { return this->Map->GetWeight(k, place.Interpolate(valueOf)); },
    1e-4);
}

// A class without a material is drawn as VTK's mapper draws it, between points, too.
TEST_F(MaterialMapping, NoMaterialIsTheSuperclass)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToHeadlight();
  this->Renderer->AddLight(light);
  this->Actor->GetProperty()->SetColor(0.9, 0.3, 0.2);
  this->AddMaterials(1);
  this->Map->AddMaterial(nullptr, 1.0);
  this->Mapper->ScalarVisibilityOff();
  vtkNew<vtkPolyDataMapper> stock;
  stock->SetInputData(this->Sheet);
  stock->ScalarVisibilityOff();
  for (const bool cells : { true, false })
  {
    this->Sheet->GetPointData()->RemoveArray("data");
    this->Sheet->GetCellData()->RemoveArray("data");
    if (cells)
    {
      this->SetCells([](vtkIdType cell, int) { return static_cast<double>(cell % 2); });
    }
    else
    {
      this->SetPoints([](vtkIdType point, int) { return static_cast<double>(point % 2); });
    }
    for (const double opacity : { 1.0, 0.5 }) // what is drawn twice shows where it is translucent
    {
      this->Actor->GetProperty()->SetOpacity(opacity);
      this->Actor->SetMapper(stock);
      const FloatImage plain = this->RenderEncoded();
      this->Actor->SetMapper(this->Mapper);
      this->Mapper->SetMaterialMap(nullptr);
      this->Mapper->SetBRDF(this->Materials[0]);
      const FloatImage alone = this->RenderEncoded();
      this->Mapper->SetBRDF(nullptr);
      this->Mapper->SetMaterialMap(this->Map);
      const FloatImage mixed = this->RenderEncoded();
      for (int y = 0; y < Pixels; ++y)
      {
        for (int x = 0; x < Pixels; ++x)
        {
          const Place place(x, y);
          const double odd = cells
                               ? static_cast<double>(place.Cell % 2)
                               : place.Interpolate([](vtkIdType p) { return p % 2 ? 1.0 : 0.0; });
          if (place.OnDiagonal || std::abs(odd - 0.5) < 1e-4)
          {
            continue;
          }
          const FloatImage& wanted = odd > 0.5 ? plain : alone;
          for (int c = 0; c < 3; ++c)
          {
            ASSERT_NEAR(mixed.At(x, y)[c], wanted.At(x, y)[c], Same)
              << x << " " << y << " opacity " << opacity;
          }
        }
      }
    }
  }
}

// 24 materials of three textures each meet everywhere, and there are 32 units at most.
TEST_F(MaterialMapping, MoreThanTheTextureUnitsHoldIsSaidOnce)
{
  this->AddMaterials(24);
  this->Map->SetModeToWeights();
  this->SetPoints([](vtkIdType, int k) { return k == 3 ? 5.0 : 1.0; }, 24);
  this->Mapper->SetMaterialMap(this->Map);
  EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
  const FloatImage image = this->RenderLinear();
  this->RenderLinear();
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_NE(warnings.Text.find("texture units"), std::string::npos) << warnings.Text;
  for (int k = 0; k < Pixels * Pixels; ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      const float value = image.RGBA[static_cast<std::size_t>(4 * k + c)];
      ASSERT_TRUE(std::isfinite(value) && value > 0.0f);
    }
  }
}

TEST_F(MaterialMapping, AMapThatDoesNotFitIsSaidOnceAndTheMaterialDrawn)
{
  this->AddMaterials(2);
  this->RenderAlone();
  this->Mapper->SetBRDF(this->Materials[1]);
  EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
  for (int frame = 0; frame < 2; ++frame)
  {
    const FloatImage image = this->RenderLinear();
    EXPECT_NEAR(image.At(20, 30)[0], this->Alone[1].At(20, 30)[0], Same);
  }
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_NE(warnings.Text.find("\"data\""), std::string::npos) << warnings.Text;
  // It fits from here on.
  this->SetCells([](vtkIdType, int) { return 0.0; });
  EXPECT_NEAR(this->RenderLinear().At(20, 30)[0], this->Alone[0].At(20, 30)[0], Same);
}

TEST_F(MaterialMapping, ScalarsThatChooseDoNotColor)
{
  this->AddMaterials(2);
  this->RenderAlone();
  this->SetCells([](vtkIdType cell, int) { return static_cast<double>(cell % 2); });
  this->Sheet->GetCellData()->SetActiveScalars("data");
  this->ExpectMixture([](const Place& place, int k)
    { return place.OnDiagonal ? -1.0 : (place.Cell % 2 == k ? 1.0 : 0.0); });
  // Other scalars do.
  vtkNew<vtkFloatArray> other;
  other->SetName("other");
  other->SetNumberOfTuples(2 * Side * Side);
  other->FillValue(0.0f);
  this->Sheet->GetCellData()->SetScalars(other);
  this->Sheet->Modified();
  const FloatImage colored = this->RenderLinear(); // the lookup table's first color is red
  EXPECT_LT(colored.At(20, 30)[1], 0.01 * this->Alone[0].At(20, 30)[1]);
}

TEST_F(MaterialMapping, DataAndMaterialsMayChange)
{
  this->AddMaterials(3);
  this->RenderAlone();
  this->SetCells([](vtkIdType, int) { return 0.0; });
  EXPECT_NEAR(this->RenderLinear().At(9, 9)[0], this->Alone[0].At(9, 9)[0], Same);
  this->SetCells([](vtkIdType, int) { return 2.0; });
  EXPECT_NEAR(this->RenderLinear().At(9, 9)[0], this->Alone[2].At(9, 9)[0], Same);
  this->Map->SetBRDF(2, this->Materials[1]);
  EXPECT_NEAR(this->RenderLinear().At(9, 9)[0], this->Alone[1].At(9, 9)[0], Same);
  this->Materials[1]->RemoveAllTerms();
  EXPECT_NEAR(this->RenderLinear().At(9, 9)[0], 0.0, Same);
  this->Mapper->SetMaterialMap(nullptr);
  this->Mapper->SetBRDF(this->Materials[0]);
  EXPECT_NEAR(this->RenderLinear().At(9, 9)[0], this->Alone[0].At(9, 9)[0], Same);
}

// The parts are drawn, the whole is picked.
TEST_F(MaterialMapping, SelectionFindsTheInputsCells)
{
  this->AddMaterials(5);
  this->SetCells([](vtkIdType cell, int) { return static_cast<double>((3 * cell) % 5); });
  this->Mapper->SetMaterialMap(this->Map);
  this->Window->Render();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->Renderer);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  for (const auto& [column, row] : { std::pair<int, int>(12, 9), std::pair<int, int>(41, 60) })
  {
    const auto x = static_cast<unsigned int>(column);
    const auto y = static_cast<unsigned int>(row);
    selector->SetArea(x, y, x, y);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
    auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
    ASSERT_EQ(ids->GetNumberOfTuples(), 1);
    EXPECT_EQ(ids->GetValue(0), Place(column, row).Cell);
  }
}

// A plan for each material, with what they make together; textures once for all parts.
TEST_F(MaterialMapping, Plans)
{
  this->AddMaterials(3);
  this->Map->SetModeToValues();
  this->SetPoints([](vtkIdType point, int) { return 0.2 * static_cast<double>(point % 11); });
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetMaterialMap(this->Map);
  this->Window->Render();
  const std::string plan = this->Mapper->GetPlan();
  EXPECT_EQ(std::count(plan.begin(), plan.end(), '\n'), 3) << plan;
  EXPECT_NE(plan.find("together: predicted error"), std::string::npos) << plan;
  const vtkIdType bytes = this->Mapper->GetTextureBytes();
  this->Mapper->SetMaterialMap(nullptr);
  vtkIdType single = 0;
  for (const auto& brdf : this->Materials)
  {
    this->Mapper->SetBRDF(brdf);
    this->Window->Render();
    single += this->Mapper->GetTextureBytes();
  }
  EXPECT_LE(bytes, single);
}

// Blocks are divided as single surfaces are; a block's own material comes first.
TEST_F(MaterialMapping, CompositeDataShowTheSame)
{
  this->AddMaterials(3);
  this->Map->SetModeToValues();
  this->SetPoints([](vtkIdType point, int) { return 0.2 * static_cast<double>(point % 11); });
  this->RenderAlone();
  const FloatImage plain = this->RenderLinear();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, this->Sheet);
  vtkNew<vtkCompositeMeasuredBRDFMapper> composite;
  composite->SetInputDataObject(blocks);
  composite->SetEnvironment(this->Environment);
  composite->SetIntegrator(this->Table);
  composite->SetMaterialMap(this->Map);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  composite->SetCompositeDataDisplayAttributes(attributes);
  this->Actor->SetMapper(composite);
  const FloatImage image = this->RenderLinear();
  for (std::size_t k = 0; k < image.RGBA.size(); ++k)
  {
    ASSERT_NEAR(image.RGBA[k], plain.RGBA[k], Same);
  }
  this->Actor->SetMapper(this->Mapper);
  this->Actor->GetProperty()->SetOpacity(0.5);
  const FloatImage thin = this->RenderEncoded();
  this->Actor->GetProperty()->SetOpacity(1.0);
  this->Actor->SetMapper(composite);
  composite->SetBlockOpacity(1, 0.5);
  const FloatImage thinBlock = this->RenderEncoded();
  for (std::size_t k = 0; k < thin.RGBA.size(); ++k)
  {
    ASSERT_NEAR(thinBlock.RGBA[k], thin.RGBA[k], Same);
  }
  composite->RemoveBlockOpacity(1);
  composite->SetBlockBRDF(1, this->Materials[0]);
  EXPECT_NEAR(this->RenderLinear().At(30, 30)[0], this->Alone[0].At(30, 30)[0], Same);
  composite->RemoveBlockBRDFs();
  composite->SetBlockVisibility(1, false);
  EXPECT_EQ(this->RenderLinear().At(30, 30)[0], 0.0f);
}

TEST_F(MaterialMapping, WindowsComeAndGo)
{
  this->AddMaterials(2);
  this->RenderAlone();
  this->SetCells([](vtkIdType cell, int) { return static_cast<double>(cell % 2); });
  const FloatImage first = this->RenderLinear();
  this->Mapper->ReleaseGraphicsResources(this->Window);
  const FloatImage second = this->RenderLinear();
  for (std::size_t k = 0; k < first.RGBA.size(); ++k)
  {
    ASSERT_EQ(first.RGBA[k], second.RGBA[k]);
  }
}
}
