// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Classes of points: polygons show the same whether they are cut along the borders or drawn once
// for each class; and they are not cut where that could not show the same.

#include "MaterialMapFixture.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCharArray.h"
#include "vtkCommand.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkStripper.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace
{
class ClassBorders : public MaterialMapping
{
protected:
  /// How polygons with corners of several classes are drawn.
  enum class Way
  {
    Cut,
    Each // whole, once for each class
  };

  static constexpr int Count = 8; // three bits

  void SetUp() override
  {
    MaterialMapping::SetUp();
    if (IsSkipped())
    {
      return;
    }
    this->AddMaterials(Count);
    this->SetClasses(0);
    this->Mapper->SetMaterialMap(this->Map);
    this->Mapper->ScalarVisibilityOff();
    // No pixel's center lies on a border.
    this->Actor->RotateWXYZ(33.0, 0.3, 0.5, 1.0);
    this->Renderer->GetActiveCamera()->ParallelProjectionOff();
    this->Renderer->GetActiveCamera()->SetViewAngle(21.0);
    this->Events->SetClientData(this);
    this->Events->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* program)
      {
        const std::string text =
          static_cast<vtkShaderProgram*>(program)->GetFragmentShader()->GetSource();
        if (text.find("brdfSlot") != std::string::npos)
        {
          static_cast<ClassBorders*>(self)->Seen = Way::Each;
        }
      });
    this->Mapper->AddObserver(vtkCommand::UpdateShaderEvent, this->Events);
  }

  /// Two meet in many polygons, and three in others.
  void SetClasses(unsigned int seed)
  {
    this->SetPoints(
      [seed](vtkIdType point, int)
      {
        const unsigned int number = static_cast<unsigned int>(point) / 2 + seed; // in pairs
        return static_cast<double>((2654435761u * number) >> 29);
      });
  }

  FloatImage Render(Way wanted, const std::string& what)
  {
    this->Seen = Way::Cut;
    const FloatImage picture = this->RenderEncoded();
    EXPECT_EQ(this->Seen, wanted) << what;
    return picture;
  }

  /// New points could not have an attribute of a program's.
  void ForbidCuts()
  {
    this->Mapper->MapDataArrayToVertexAttribute(
      "unused", "data", vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  }

  void ColorCells()
  {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("colors");
    colors->SetNumberOfComponents(3);
    for (vtkIdType cell = 0; cell < this->Sheet->GetNumberOfCells(); ++cell)
    {
      const double c = static_cast<double>(cell);
      colors->InsertNextTuple3(100 + c, 255 - c, 50 + (37 * cell) % 200);
    }
    this->Sheet->GetCellData()->AddArray(colors);
    this->Mapper->ScalarVisibilityOn();
    this->Mapper->SetScalarModeToUseCellFieldData();
    this->Mapper->SelectColorArray("colors");
  }

  /// And much of the picture shows something.
  void ExpectSame(const FloatImage& a, const FloatImage& b, const std::string& what,
    double tolerance = 1.0 / 255.0)
  {
    MaterialMapping::ExpectSame(a, b, what, tolerance);
    int seen = 0;
    for (std::size_t k = 0; k < a.RGBA.size(); k += 4)
    {
      seen += a.RGBA[k] > 0.02f ? 1 : 0;
    }
    EXPECT_GT(seen, Pixels * Pixels / 3) << what;
  }

  void ExpectSameInBothWays(const std::string& what)
  {
    this->Sheet->Modified();
    const FloatImage picture = this->Render(Way::Cut, what);
    this->ForbidCuts();
    this->ExpectSame(this->Render(Way::Each, what), picture, what);
    this->Mapper->RemoveAllVertexAttributeMappings();
    this->Sheet->Modified();
  }

  void AddTexture()
  {
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
  }

  vtkNew<vtkCallbackCommand> Events;
  Way Seen = Way::Cut;
};

TEST_F(ClassBorders, AreTheSameInBothWays)
{
  this->ExpectSameInBothWays("triangles");
  this->AddTexture();
  this->ExpectSameInBothWays("texture");
  this->Actor->GetProperty()->SetOpacity(0.5); // what is drawn twice or not at all shows
  this->ExpectSameInBothWays("translucent");
  this->Actor->GetProperty()->SetOpacity(1.0);
  this->Actor->GetProperty()->SetInterpolationToFlat();
  this->ExpectSameInBothWays("flat");
  this->Actor->GetProperty()->SetInterpolationToGouraud();
  this->Sheet->GetPointData()->SetNormals(nullptr);
  this->ExpectSameInBothWays("without normals");
}

// The first of the classes, one between others, and the last: their pixels are the superclass's.
TEST_F(ClassBorders, OfClassesWithoutAMaterialAreTheSame)
{
  this->AddHeadlight();
  this->Actor->GetProperty()->SetOpacity(0.5); // what is drawn twice or not at all shows
  for (const int without : { 0, 3, Count - 1 })
  {
    this->Map->SetBRDF(without, nullptr);
    this->ExpectSameInBothWays("without " + std::to_string(without));
    this->Map->SetBRDF(without, this->Materials[static_cast<std::size_t>(without)]);
  }
}

TEST_F(ClassBorders, OfStripsAndOfPolygonsOfManyCorners)
{
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(this->Sheet);
  stripper->Update();
  const vtkSmartPointer<vtkCellArray> triangles = this->Sheet->GetPolys();
  this->Sheet->SetPolys(nullptr);
  this->Sheet->SetStrips(stripper->GetOutput()->GetStrips());
  ASSERT_GT(this->Sheet->GetNumberOfStrips(), 0);
  this->ExpectSameInBothWays("strips");
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
  this->ExpectSameInBothWays("polygons of six corners");
  this->ColorCells();
  this->ExpectSameInBothWays("polygons of six corners, colors of cells");
  this->Mapper->ScalarVisibilityOff();
  this->Actor->GetProperty()->EdgeVisibilityOn();
  this->Render(Way::Each, "edges of polygons of six corners");
}

// Lights evaluate the materials, each with its own terms.
TEST_F(ClassBorders, OfSeveralShadersUnderSunsAreTheSame)
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
  this->RemoveSomeTerms();
  this->ExpectSameInBothWays("suns");
  this->Renderer->RemoveAllLights();
  this->ExpectSameInBothWays("suns alone");
}

// They are found by the numbers of triangles.
TEST_F(ClassBorders, ColorsOfCellsStayTheirOwn)
{
  this->ColorCells();
  this->ExpectSameInBothWays("colors of cells");
  this->Map->SetBRDF(3, nullptr);
  this->AddHeadlight();
  this->ExpectSameInBothWays("colors of cells, a class without a material");
}

// Flat ones, which are not those of the points.
TEST_F(ClassBorders, NormalsOfCellsStayTheirOwn)
{
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (vtkIdType cell = 0; cell < this->Sheet->GetNumberOfCells(); ++cell)
  {
    const double turn = static_cast<double>(cell);
    normals->InsertNextTuple3(0.4 * std::sin(turn), 0.4 * std::cos(turn), 0.82);
  }
  this->Sheet->GetPointData()->SetNormals(nullptr);
  const FloatImage plain = this->Render(Way::Cut, "no normals");
  this->Sheet->GetCellData()->SetNormals(normals);
  this->ExpectSameInBothWays("normals of cells");
  EXPECT_NE(this->Render(Way::Cut, "normals of cells").RGBA, plain.RGBA);
}

// New points could not have them: a table of colors is not linear.
TEST_F(ClassBorders, ColorsOfPointsKeepPolygonsWhole)
{
  const FloatImage plain = this->Render(Way::Cut, "no colors");
  vtkNew<vtkUnsignedCharArray> gray;
  gray->SetName("gray");
  gray->SetNumberOfComponents(3);
  gray->SetNumberOfTuples(this->Sheet->GetNumberOfPoints());
  gray->Fill(102.0);
  this->Sheet->GetPointData()->AddArray(gray);
  this->Mapper->ScalarVisibilityOn();
  this->Mapper->SetScalarModeToUsePointFieldData();
  this->Mapper->SelectColorArray("gray");
  FloatImage bright = this->Render(Way::Each, "colors");
  for (std::size_t k = 0; k < bright.RGBA.size(); ++k)
  {
    bright.RGBA[k] /= k % 4 == 3 ? 1.0f : 0.4f;
  }
  this->ExpectSame(bright, plain, "colors");
  // Those that choose the materials color none; but a class without a material.
  this->Mapper->SelectColorArray("data");
  this->Mapper->SetBRDF(this->Materials[0]);
  this->SetClasses(1);
  this->Render(Way::Cut, "colors of the map");
  this->Map->SetBRDF(3, nullptr);
  this->Render(Way::Each, "colors of the map and of a class without a material");
}

// The edges are the polygons', and what is selected covers them.
TEST_F(ClassBorders, EdgesAndSelectionsKeepPolygonsWhole)
{
  const FloatImage surface = this->Render(Way::Cut, "a surface");
  this->Actor->GetProperty()->EdgeVisibilityOn();
  EXPECT_NE(this->Render(Way::Each, "edges").RGBA, surface.RGBA);
  this->Actor->GetProperty()->EdgeVisibilityOff();
  this->Render(Way::Each, "no edges: whole until something changes");
  this->SetClasses(1);
  const FloatImage plain = this->Render(Way::Cut, "other data");
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
  const FloatImage selected = this->Render(Way::Each, "selected cells");
  EXPECT_NE(selected.RGBA, plain.RGBA);
}

// Their codes are bytes, which do not interpolate.
TEST_F(ClassBorders, HiddenSkiesKeepPolygonsWhole)
{
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputData(this->Sheet);
  filter->Update();
  this->Sheet->ShallowCopy(filter->GetOutput());
  this->Mapper->SetOcclusionModeToOff();
  const FloatImage off = this->Render(Way::Cut, "off");
  this->Mapper->SetOcclusionModeToOn();
  // The sheet hides hardly anything.
  this->ExpectSame(this->Render(Way::Each, "on"), off, "on", 0.02);
  this->Mapper->SetOcclusionModeToOff();
  this->Sheet->Modified();
  this->ExpectSame(this->Render(Way::Cut, "off again"), off, "off again");
}

// Integers would be rounded.
TEST_F(ClassBorders, NormalsOfIntegersKeepPolygonsWhole)
{
  vtkNew<vtkCharArray> normals;
  normals->SetNumberOfComponents(3);
  for (vtkIdType p = 0; p < this->Sheet->GetNumberOfPoints(); ++p)
  {
    normals->InsertNextTuple3(20 * std::sin(p), 20 * std::cos(p), 100.0);
  }
  this->Sheet->GetPointData()->SetNormals(normals);
  this->Sheet->Modified();
  this->Render(Way::Each, "normals of integers");
}
}
