// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Classes of points: polygons that are cut along the borders show what whole ones show, whose
// pixels choose among all materials of their corners; and whole ones are drawn where cut ones could
// not show the same.

#include "MaterialMapFixture.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCharArray.h"
#include "vtkCommand.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
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

#include <cmath>
#include <string>
#include <vector>

namespace
{
class ClassBorders : public MaterialMapping
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
        static_cast<ClassBorders*>(self)->Whole |= text.find("brdfNearest") != std::string::npos;
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

  /// wanted: whether shaders choose among several materials.
  FloatImage Render(bool wanted, const char* what)
  {
    this->Whole = false;
    const FloatImage picture = this->RenderEncoded();
    EXPECT_EQ(this->Whole, wanted) << what;
    return picture;
  }

  /// Whole polygons: vertices with attributes of a program's are not interpolated.
  FloatImage RenderWhole(const char* what)
  {
    this->Mapper->MapDataArrayToVertexAttribute(
      "unused", "data", vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
    const FloatImage picture = this->Render(true, what);
    this->Mapper->RemoveAllVertexAttributeMappings();
    return picture;
  }

  void ExpectSame(const FloatImage& a, const FloatImage& b, const char* what)
  {
    int seen = 0;
    for (std::size_t k = 0; k < a.RGBA.size(); ++k)
    {
      ASSERT_NEAR(a.RGBA[k], b.RGBA[k], 1.0 / 255.0)
        << what << ": " << k / 4 % Pixels << " " << k / 4 / Pixels;
      seen += k % 4 == 0 && a.RGBA[k] > 0.02f ? 1 : 0;
    }
    EXPECT_GT(seen, Pixels * Pixels / 3) << what;
  }

  /// Cut, then whole.
  void ExpectSameWhenCut(const char* what)
  {
    this->Sheet->Modified();
    const FloatImage cut = this->Render(false, what);
    this->ExpectSame(cut, this->RenderWhole(what), what);
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
  bool Whole = false;
};

TEST_F(ClassBorders, AreThoseOfWholePolygons)
{
  this->ExpectSameWhenCut("triangles");
  this->AddTexture();
  this->ExpectSameWhenCut("texture");
  this->Actor->GetProperty()->SetOpacity(0.5); // what is drawn twice or not at all shows
  this->ExpectSameWhenCut("translucent");
  this->Actor->GetProperty()->SetOpacity(1.0);
  this->Actor->GetProperty()->SetInterpolationToFlat();
  this->ExpectSameWhenCut("flat");
  this->Actor->GetProperty()->SetInterpolationToGouraud();
  this->Sheet->GetPointData()->SetNormals(nullptr);
  this->ExpectSameWhenCut("without normals");
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
  this->ExpectSameWhenCut("strips");
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
  this->ExpectSameWhenCut("polygons of six corners");
}

// A cell's color is that of its pieces.
TEST_F(ClassBorders, ColorsOfCellsStayTheirOwn)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("colors");
  colors->SetNumberOfComponents(3);
  for (int cell = 0; cell < 2 * Side * Side; ++cell)
  {
    colors->InsertNextTuple3(100 + cell, 255 - cell, 50 + (37 * cell) % 200);
  }
  this->Sheet->GetCellData()->AddArray(colors);
  this->Mapper->ScalarVisibilityOn();
  this->Mapper->SetScalarModeToUseCellFieldData();
  this->Mapper->SelectColorArray("colors");
  this->ExpectSameWhenCut("colors of cells");
}

// New points could not have them: a table of colors is not linear.
TEST_F(ClassBorders, ColorsOfPointsKeepPolygonsWhole)
{
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("heights");
  for (vtkIdType p = 0; p < this->Sheet->GetNumberOfPoints(); ++p)
  {
    heights->InsertNextValue(static_cast<double>((7 * p) % 11));
  }
  this->Sheet->GetPointData()->AddArray(heights);
  const FloatImage plain = this->Render(false, "no colors");
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(11);
  table->SetTableRange(0.0, 10.0);
  table->Build();
  this->Mapper->SetLookupTable(table);
  this->Mapper->UseLookupTableScalarRangeOn();
  this->Mapper->ScalarVisibilityOn();
  this->Mapper->SetScalarModeToUsePointFieldData();
  this->Mapper->SelectColorArray("heights");
  const FloatImage colored = this->Render(true, "colors");
  this->ExpectSame(colored, this->RenderWhole("colors"), "colors");
  EXPECT_NE(colored.RGBA, plain.RGBA);
  // Those that choose the materials color none; but a class without a material.
  this->Mapper->SelectColorArray("data");
  this->Mapper->SetBRDF(this->Materials[0]);
  this->SetClasses(1);
  this->Render(false, "colors of the map");
  this->Map->SetBRDF(3, nullptr);
  this->Render(true, "colors of the map and of a class without a material");
}

// The edges are the polygons', and what is selected covers them.
TEST_F(ClassBorders, EdgesAndSelectionsKeepPolygonsWhole)
{
  this->Render(false, "a surface");
  this->Actor->GetProperty()->EdgeVisibilityOn();
  const FloatImage edges = this->Render(true, "edges");
  this->ExpectSame(edges, this->RenderWhole("edges"), "edges");
  this->Actor->GetProperty()->EdgeVisibilityOff();
  this->Render(true, "no edges: whole until something changes");
  this->SetClasses(1);
  const FloatImage plain = this->Render(false, "other data");
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
  const FloatImage selected = this->Render(true, "selected cells");
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
  this->Render(false, "off");
  this->Mapper->SetOcclusionModeToOn();
  const FloatImage hidden = this->Render(true, "on");
  this->ExpectSame(hidden, this->RenderWhole("on"), "on");
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
  this->Render(true, "normals of integers");
}
}
