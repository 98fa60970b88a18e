// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Classes of points: polygons show the same whether their pixels choose from a stack of materials,
// whether they are drawn for each class, or whether they are cut along the borders; and they are
// not stacked or cut where that could not show the same.

#include "MaterialMapFixture.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCharArray.h"
#include "vtkCommand.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
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
#include <set>
#include <sstream>
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
    Each, // most or all of them once for each class
    Stacked
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
        Way& way = static_cast<ClassBorders*>(self)->Seen;
        const bool stacked = text.find("brdfClassHere") != std::string::npos;
        const bool each = text.find("brdfSlot") != std::string::npos;
        static_cast<ClassBorders*>(self)->AnyStacked |= stacked;
        way = each ? Way::Each : stacked && way == Way::Cut ? Way::Stacked : way;
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

  /// In the second frame: the first one shows that it is better to cut.
  FloatImage Render(Way wanted, const char* what)
  {
    this->RenderEncoded();
    this->Seen = Way::Cut;
    this->AnyStacked = false;
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

  void ExpectSame(
    const FloatImage& a, const FloatImage& b, const char* what, double tolerance = 1.0 / 255.0)
  {
    int seen = 0;
    for (std::size_t k = 0; k < a.RGBA.size(); ++k)
    {
      ASSERT_NEAR(a.RGBA[k], b.RGBA[k], tolerance)
        << what << ": " << k / 4 % Pixels << " " << k / 4 / Pixels;
      seen += k % 4 == 0 && a.RGBA[k] > 0.02f ? 1 : 0;
    }
    EXPECT_GT(seen, Pixels * Pixels / 3) << what;
  }

  void ExpectSameWhenCut(const FloatImage& picture, const char* what)
  {
    this->Sheet->Modified();
    this->ExpectSame(this->Render(Way::Cut, what), picture, what);
    this->ForbidCuts();
    this->ExpectSame(this->Render(Way::Each, what), picture, what);
    this->Mapper->RemoveAllVertexAttributeMappings();
  }

  /// first: what is seen where all that can be stacked is.
  void ExpectSameInAllWays(const char* what, Way first = Way::Stacked)
  {
    const FloatImage picture = this->Render(first, what);
    EXPECT_TRUE(this->AnyStacked) << what;
    this->Map->StackClassesOff();
    this->ExpectSameWhenCut(picture, what);
    this->Map->StackClassesOn();
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

  /// Of three shaders, under a light: with a diffuse part, with gloss, with both.
  void AddOtherShaders()
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(1.0, 2.0, 4.0);
    this->Renderer->AddLight(light);
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

  vtkNew<vtkCallbackCommand> Events;
  Way Seen = Way::Cut;
  bool AnyStacked = false;
};

TEST_F(ClassBorders, AreTheSameInAllWays)
{
  this->ExpectSameInAllWays("triangles");
  this->AddTexture();
  this->ExpectSameInAllWays("texture");
  this->Actor->GetProperty()->SetOpacity(0.5); // what is drawn twice or not at all shows
  this->ExpectSameInAllWays("translucent");
  this->Actor->GetProperty()->SetOpacity(1.0);
  this->Actor->GetProperty()->SetInterpolationToFlat();
  this->ExpectSameInAllWays("flat");
  this->Actor->GetProperty()->SetInterpolationToGouraud();
  this->Sheet->GetPointData()->SetNormals(nullptr);
  this->ExpectSameInAllWays("without normals");
}

// The first of the classes, one between others, and the last: their pixels are the superclass's.
TEST_F(ClassBorders, OfClassesWithoutAMaterialAreTheSame)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToHeadlight();
  this->Renderer->AddLight(light);
  this->Actor->GetProperty()->SetOpacity(0.5); // what is drawn twice or not at all shows
  for (const int without : { 0, 3, Count - 1 })
  {
    this->Map->SetBRDF(without, nullptr);
    this->ExpectSameInAllWays(("without " + std::to_string(without)).c_str(), Way::Each);
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
  this->ExpectSameInAllWays("strips");
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
  this->ExpectSameInAllWays("polygons of six corners");
  this->ColorCells();
  this->ExpectSameInAllWays("polygons of six corners, colors of cells");
  this->Mapper->ScalarVisibilityOff();
  this->Actor->GetProperty()->EdgeVisibilityOn();
  const FloatImage edges = this->Render(Way::Stacked, "edges of polygons of six corners");
  this->Map->StackClassesOff();
  this->ExpectSame(this->Render(Way::Each, "their edges, not stacked"), edges, "their edges");
}

// Pixels skip the terms of other shaders.
TEST_F(ClassBorders, OfSeveralShadersAreTheSame)
{
  this->AddOtherShaders();
  this->ExpectSameInAllWays("several shaders");
}

// Tables of several sizes, which lie beside each other in stacks. The sheet faces the map's seam.
TEST_F(ClassBorders, OfTablesOfSeveralSizesAreTheSame)
{
  this->Mapper->SetIntegrator(nullptr);
  for (std::size_t k = 0; k < this->Materials.size(); ++k)
  {
    vtkBlinnPhongBRDF::SafeDownCast(this->Materials[k]->GetTerm(1))
      ->SetExponent(std::pow(8.0, 1.0 + static_cast<double>(k % 3)));
  }
  this->Render(Way::Stacked, "plan");
  std::set<std::string> sizes; // of tables, a line each
  std::istringstream lines(this->Mapper->GetPlan());
  for (std::string line; std::getline(lines, line);)
  {
    if (line.compare(0, 7, "table, ") == 0)
    {
      sizes.insert(line.substr(0, line.find(", error")));
    }
  }
  EXPECT_GE(sizes.size(), 2u) << this->Mapper->GetPlan();
  this->ExpectSameInAllWays("tables of several sizes");
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
  this->AddOtherShaders();
  this->ExpectSameInAllWays("suns");
  this->Renderer->RemoveAllLights();
  this->ExpectSameInAllWays("suns alone");
}

// They are found by the numbers of triangles, of those that are stacked, too.
TEST_F(ClassBorders, ColorsOfCellsStayTheirOwn)
{
  this->Render(Way::Stacked, "no colors");
  this->ColorCells();
  this->ExpectSameInAllWays("colors of cells");
  this->Map->SetBRDF(3, nullptr); // so that some polygons are not stacked
  vtkNew<vtkLight> light;
  light->SetLightTypeToHeadlight();
  this->Renderer->AddLight(light);
  this->ExpectSameInAllWays("colors of cells, a class without a material", Way::Each);
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
  const FloatImage plain = this->Render(Way::Stacked, "no normals");
  this->Sheet->GetCellData()->SetNormals(normals);
  this->ExpectSameInAllWays("normals of cells");
  EXPECT_NE(this->Render(Way::Stacked, "normals of cells").RGBA, plain.RGBA);
}

// VTK leaves out triangles of which two corners are in one place, so that numbers are not known.
TEST_F(ClassBorders, ColoredCellsWithoutAnAreaAreNotStacked)
{
  double at[3];
  this->Sheet->GetPoint(3, at);
  this->Sheet->GetPoints()->SetPoint(2, at);
  this->Sheet->GetPoints()->Modified();
  this->Render(Way::Stacked, "no colors");
  this->ColorCells();
  this->ForbidCuts();
  this->Render(Way::Each, "colors of cells");
}

// New points could not have them: a table of colors is not linear.
TEST_F(ClassBorders, ColorsOfPointsKeepPolygonsWhole)
{
  const FloatImage plain = this->Render(Way::Stacked, "no colors");
  vtkNew<vtkUnsignedCharArray> gray;
  gray->SetName("gray");
  gray->SetNumberOfComponents(3);
  gray->SetNumberOfTuples(this->Sheet->GetNumberOfPoints());
  gray->Fill(102.0);
  this->Sheet->GetPointData()->AddArray(gray);
  this->Mapper->ScalarVisibilityOn();
  this->Mapper->SetScalarModeToUsePointFieldData();
  this->Mapper->SelectColorArray("gray");
  FloatImage bright = this->Render(Way::Stacked, "colors");
  for (std::size_t k = 0; k < bright.RGBA.size(); ++k)
  {
    bright.RGBA[k] /= k % 4 == 3 ? 1.0f : 0.4f;
  }
  this->ExpectSame(bright, plain, "colors");
  this->Map->StackClassesOff();
  this->Render(Way::Each, "colors, not stacked");
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
  const FloatImage surface = this->Render(Way::Stacked, "a surface");
  this->Actor->GetProperty()->EdgeVisibilityOn();
  const FloatImage edges = this->Render(Way::Stacked, "edges");
  EXPECT_NE(edges.RGBA, surface.RGBA);
  this->Map->StackClassesOff();
  this->ExpectSame(this->Render(Way::Each, "edges, not stacked"), edges, "edges");
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
  const FloatImage off = this->Render(Way::Stacked, "off");
  this->Mapper->SetOcclusionModeToOn();
  // The sheet hides hardly anything.
  this->ExpectSame(this->Render(Way::Each, "on"), off, "on", 0.02);
  this->Mapper->SetOcclusionModeToOff();
  this->ExpectSame(this->Render(Way::Stacked, "off again"), off, "off again");
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
  this->Render(Way::Stacked, "normals of integers");
  this->Map->StackClassesOff();
  this->Render(Way::Each, "normals of integers, not stacked");
}
}
