// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Polygons that a material map cuts show what they show whole: of several materials that are equal,
// no cut is seen, whatever drawing reads of the points.

#include "MaterialMapFixture.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkStripper.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace
{
class Cuts : public MaterialMapping
{
protected:
  static constexpr int Count = 8; // three bits

  void SetUp() override
  {
    MaterialMapping::SetUp();
    if (IsSkipped())
    {
      return;
    }
    for (int k = 0; k < Count; ++k)
    {
      this->AddMaterials(1); // as many equal ones
    }
    // Two classes meet in many polygons, and three in others.
    this->SetPoints(
      [](vtkIdType point, int)
      {
        const unsigned int number = static_cast<unsigned int>(point) / 2; // in pairs
        return static_cast<double>((2654435761u * number) >> 29);
      });
    this->Mapper->ScalarVisibilityOff();
    this->Actor->RotateWXYZ(33.0, 0.3, 0.5, 1.0);
    this->Renderer->GetActiveCamera()->ParallelProjectionOff();
    this->Renderer->GetActiveCamera()->SetViewAngle(21.0);
  }

  /// Neither borders between classes nor knots on a scale. Edges move by rounding: a pixel's center
  /// may be on the other side.
  void ExpectUnseen(const std::string& what, double tolerance = 1.0 / 255.0, int others = 4)
  {
    this->Sheet->Modified();
    this->Mapper->SetBRDF(this->Materials[0]);
    this->Mapper->SetMaterialMap(nullptr);
    const FloatImage whole = this->RenderEncoded();
    this->Mapper->SetMaterialMap(this->Map);
    for (const int mode : { vtkMaterialMap::CLASSES, vtkMaterialMap::VALUES })
    {
      this->Map->SetMode(mode);
      const FloatImage cut = this->RenderEncoded();
      int apart = 0;
      for (std::size_t k = 0; k < whole.RGBA.size(); k += 4)
      {
        apart += std::abs(cut.RGBA[k] - whole.RGBA[k]) > tolerance ? 1 : 0;
      }
      EXPECT_LE(apart, others) << what << ", mode " << mode;
    }
    int seen = 0;
    for (std::size_t k = 0; k < whole.RGBA.size(); k += 4)
    {
      seen += whole.RGBA[k] > 0.02f ? 1 : 0;
    }
    EXPECT_GT(seen, Pixels * Pixels / 3) << what;
  }

  void AddColors(vtkDataSetAttributes* data, vtkIdType tuples)
  {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("colors");
    colors->SetNumberOfComponents(3);
    for (vtkIdType k = 0; k < tuples; ++k)
    {
      const double c = static_cast<double>(k);
      colors->InsertNextTuple3(100 + c, 255 - c, 50 + (37 * k) % 200);
    }
    data->AddArray(colors);
    this->Mapper->ScalarVisibilityOn();
    this->Mapper->SelectColorArray("colors");
  }
};

TEST_F(Cuts, OfTrianglesAreUnseen)
{
  this->ExpectUnseen("triangles");
  vtkNew<vtkImageData> image;
  image->SetDimensions(16, 16, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* texels = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int k = 0; k < 3 * 16 * 16; ++k)
  {
    texels[k] = static_cast<unsigned char>(100 + (53 * k) % 150);
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOn();
  this->Actor->SetTexture(texture);
  this->ExpectUnseen("texture", 2.0 / 255.0);
  this->Actor->GetProperty()->SetOpacity(0.5); // what is drawn twice or not at all shows
  this->ExpectUnseen("translucent", 2.0 / 255.0);
  this->Actor->GetProperty()->SetOpacity(1.0);
  this->Actor->GetProperty()->SetInterpolationToFlat();
  this->ExpectUnseen("flat", 2.0 / 255.0);
  this->Actor->GetProperty()->SetInterpolationToGouraud();
  this->Sheet->GetPointData()->SetNormals(nullptr);
  this->ExpectUnseen("without normals", 2.0 / 255.0);
}

// Colors of cells are found by the numbers of triangles.
TEST_F(Cuts, OfColoredSurfacesAreUnseen)
{
  this->Mapper->SetScalarModeToUseCellFieldData();
  this->AddColors(this->Sheet->GetCellData(), this->Sheet->GetNumberOfCells());
  this->ExpectUnseen("colors of cells");
  this->Mapper->SetScalarModeToUsePointFieldData();
  this->AddColors(this->Sheet->GetPointData(), this->Sheet->GetNumberOfPoints());
  this->ExpectUnseen("colors of points", 2.0 / 255.0); // new points' are rounded
}

// Those of the cells are not those of the points.
TEST_F(Cuts, OfCellsWithNormalsAreUnseen)
{
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (vtkIdType cell = 0; cell < this->Sheet->GetNumberOfCells(); ++cell)
  {
    const double turn = static_cast<double>(cell);
    normals->InsertNextTuple3(0.4 * std::sin(turn), 0.4 * std::cos(turn), 0.82);
  }
  this->Sheet->GetPointData()->SetNormals(nullptr);
  this->Sheet->GetCellData()->SetNormals(normals);
  this->ExpectUnseen("normals of cells");
}

TEST_F(Cuts, OfStripsAndOfPolygonsOfManyCornersAreUnseen)
{
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(this->Sheet);
  stripper->Update();
  this->Sheet->SetPolys(nullptr);
  this->Sheet->SetStrips(stripper->GetOutput()->GetStrips());
  ASSERT_GT(this->Sheet->GetNumberOfStrips(), 0);
  this->ExpectUnseen("strips");
  // The rims of two squares beside each other, bent.
  vtkNew<vtkCellArray> polygons;
  for (vtkIdType y = 0; y < Side; ++y)
  {
    for (vtkIdType x = 0; x < Side; x += 2)
    {
      const vtkIdType p = y * (Side + 1) + x;
      const vtkIdType rim[6] = { p, p + 1, p + 2, p + Side + 3, p + Side + 2, p + Side + 1 };
      polygons->InsertNextCell(6, rim);
    }
  }
  this->Sheet->SetStrips(nullptr);
  this->Sheet->SetPolys(polygons);
  for (vtkIdType p = 0; p < this->Sheet->GetNumberOfPoints(); ++p)
  {
    double at[3];
    this->Sheet->GetPoint(p, at);
    at[2] = 0.1 * std::sin(3.0 * static_cast<double>(p));
    this->Sheet->GetPoints()->SetPoint(p, at);
  }
  this->Sheet->GetPoints()->Modified();
  this->ExpectUnseen("polygons of six corners");
}

// Lights evaluate the materials, each with its own terms.
TEST_F(Cuts, UnderSunsAreUnseen)
{
  std::vector<float> pixels(3 * 256 * 128, 0.3f); // with two small suns
  for (const std::size_t sun : { 100 * 256 + 40, 85 * 256 + 150 })
  {
    std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(3 * sun), 3, 4000.0f);
  }
  this->Environment->SetPixels(256, 128, pixels);
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  hybrid->SetNumberOfRows(17);
  this->Mapper->SetIntegrator(hybrid);
  this->AddLight();
  this->ExpectUnseen("suns");
}

// Codes of new points lie between those of the polygon's corners.
TEST_F(Cuts, WithHiddenSkiesAreUnseen)
{
  for (vtkIdType p = 0; p < this->Sheet->GetNumberOfPoints(); ++p)
  {
    double at[3];
    this->Sheet->GetPoint(p, at);
    at[2] = 0.5 * (at[0] * at[0] + at[1] * at[1]); // a bowl
    this->Sheet->GetPoints()->SetPoint(p, at);
  }
  this->Mapper->SetOcclusionModeToOff();
  const FloatImage open = this->RenderEncoded();
  this->Mapper->SetOcclusionModeToOn();
  this->ExpectUnseen("a bowl", 0.05);
  EXPECT_NE(this->RenderEncoded().RGBA, open.RGBA);
}

// Selected cells cover the pieces that they were cut into.
TEST_F(Cuts, AreCoveredBySelections)
{
  vtkNew<vtkIdTypeArray> cells;
  for (vtkIdType cell = 20; cell < 60; ++cell)
  {
    cells->InsertNextValue(cell);
  }
  vtkNew<vtkSelectionNode> node;
  node->SetFieldType(vtkSelectionNode::CELL);
  node->SetContentType(vtkSelectionNode::INDICES);
  node->SetSelectionList(cells);
  vtkNew<vtkSelection> selection;
  selection->AddNode(node);
  this->Actor->GetProperty()->SetSelectionColor(1.0, 0.0, 1.0, 1.0);
  this->Mapper->SetSelection(selection);
  this->ExpectUnseen("selected cells");
}
}
