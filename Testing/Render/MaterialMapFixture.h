// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A sheet that fills the window, and what each of several materials shows on it alone.
 */

#ifndef MaterialMapFixture_h
#define MaterialMapFixture_h

#include "RenderFixture.h"
#include "vtkSumBRDF.h"

constexpr int Side = 8;       // squares along an edge; 8 x 8 pixels each
constexpr int Pixels = 64;    // of the window
constexpr double Same = 2e-5; // relative, in linear radiance

/// A square that fills the window, bulging so that normals differ, of squares in two triangles.
inline vtkSmartPointer<vtkPolyData> NewSheet()
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
    this->Table->SetSizes({ 9, 4, 4 }); // no picture here is compared with a finer one
    this->Table->SetNumberOfNodes(16);
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

  /// Cells in turns of each of the classes.
  void SetClassesOfCells(int count)
  {
    this->SetCells([count](vtkIdType cell, int) { return static_cast<double>(cell % count); });
  }

  /// Cells in turns of materials: the weights of a place that ExpectMixture wants.
  static double GetWeightInTurns(const Place& place, int material, int count)
  {
    return place.OnDiagonal ? -1.0 : (place.Cell % count == material ? 1.0 : 0.0);
  }

  /// An array of points for each material.
  void AddWeightArrays(const std::function<double(vtkIdType, int)>& weight)
  {
    this->Map->SetModeToWeights();
    for (int k = 0; k < this->Map->GetNumberOfMaterials(); ++k)
    {
      this->SetPoints([&](vtkIdType point, int) { return weight(point, k); });
      const std::string name = "weight " + std::to_string(k);
      this->Sheet->GetPointData()->GetArray("data")->SetName(name.c_str());
      this->Map->SetWeightArrayName(k, name);
    }
  }

  /// weight: of a texel's column and row and a component.
  vtkSmartPointer<vtkImageData> AddWeightImage(
    int side, int components, int type, const std::function<double(int, int, int)>& weight)
  {
    this->Map->SetModeToTextures();
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(side, side, 1);
    image->AllocateScalars(type, components);
    for (int k = 0; k < side * side * components; ++k)
    {
      const int texel = k / components;
      image->SetScalarComponentFromDouble(texel % side, texel / side, 0, k % components,
        weight(texel % side, texel / side, k % components));
    }
    this->Map->AddWeightImage(image);
    return image;
  }

  /// Values of points on the map's scale, and the mixture that they make.
  void SetPointValues(const std::function<double(vtkIdType)>& value)
  {
    this->Map->SetModeToValues();
    this->SetPoints([value](vtkIdType point, int) { return value(point); });
    this->ValueOf = value;
  }
  void ExpectValuesBlend(double tolerance = 1e-4)
  {
    this->ExpectMixture([this](const Place& place, int k)
      { return this->Map->GetWeight(k, place.Interpolate(this->ValueOf)); },
      tolerance);
  }

  /// Active scalars of cells that the map does not read: all of the lookup table's first color,
  /// red.
  void ColorCellsRed()
  {
    vtkNew<vtkFloatArray> other;
    other->SetName("other");
    other->SetNumberOfTuples(2 * Side * Side);
    other->FillValue(0.0f);
    this->Sheet->GetCellData()->SetScalars(other);
    this->Sheet->Modified();
  }

  void AddLight()
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(1.0, 2.0, 4.0);
    this->Renderer->AddLight(light);
  }
  void AddHeadlight()
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    this->Renderer->AddLight(light);
  }

  /// Of a diffuse part, of gloss, of both: three shaders.
  void RemoveSomeTerms()
  {
    for (std::size_t k = 0; k < this->Materials.size(); ++k)
    {
      if (k % 3 != 0)
      {
        const vtkSmartPointer<vtkBRDF> term =
          this->Materials[k]->GetTerm(static_cast<int>(k % 3) - 1);
        this->Materials[k]->RemoveAllTerms();
        this->Materials[k]->AddTerm(term);
      }
    }
  }

  static void ExpectSame(
    const FloatImage& a, const FloatImage& b, const std::string& what, double tolerance = Same)
  {
    for (std::size_t k = 0; k < a.RGBA.size(); ++k)
    {
      ASSERT_NEAR(a.RGBA[k], b.RGBA[k], tolerance)
        << what << ": " << k / 4 % Pixels << " " << k / 4 / Pixels;
    }
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

  /// Graphics cards, whose filter weights have steps, differ by up to 1.1e-4.
  double GetLimit(double tolerance)
  {
    return std::max(tolerance, this->GetWeightStep() > 0.0 ? 1.5e-4 : 0.0);
  }

  /// weight: of a material at a place; negative for all: the place is not looked at.
  void ExpectMixture(
    const std::function<double(const Place&, int)>& weight, double tolerance = Same)
  {
    const FloatImage mixed = this->RenderLinear();
    const double limit = this->GetLimit(tolerance);
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
          ASSERT_NEAR(mixed.At(x, y)[c], expected[c], limit * (1.0 + expected[c])) << x << " " << y;
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
  std::function<double(vtkIdType)> ValueOf;
};

#endif
