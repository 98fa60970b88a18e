// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of several materials: each pixel shows the mixture of what the materials show alone.
#include "GatedBRDF.h"
#include "MaterialMapFixture.h"
#include "RenderFixture.h"
#include "WeightImages.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkHardwareSelector.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkIdTypeArray.h"
#include "vtkMaterialLegendActor.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkRenderStepsPass.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkStripper.h"
#include "vtkToneMappingPass.h"

#include <glm/glm.hpp>

#include <chrono>
#include <set>
#include <thread>
#include <utility>

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

// The cells from the first one to before the last one.
vtkSmartPointer<vtkSelection> SelectCells(vtkIdType first, vtkIdType last)
{
  vtkNew<vtkIdTypeArray> cells;
  for (vtkIdType cell = first; cell < last; ++cell)
  {
    cells->InsertNextValue(cell);
  }
  vtkNew<vtkSelectionNode> node;
  node->SetFieldType(vtkSelectionNode::CELL);
  node->SetContentType(vtkSelectionNode::INDICES);
  node->SetSelectionList(cells);
  auto selection = vtkSmartPointer<vtkSelection>::New();
  selection->AddNode(node);
  return selection;
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

//------------------------------------------------------------------------------
// Material maps of composite data: blocks of one class, blocks' own colors, cells split into
// blocks.
namespace
{
class MaterialMapBlocks : public MaterialMapping
{
protected:
  void SetUp() override
  {
    MaterialMapping::SetUp();
    if (IsSkipped())
    {
      return;
    }
    this->Composite->SetEnvironment(this->Environment);
    this->Composite->SetIntegrator(this->Table);
    this->Composite->SetCompositeDataDisplayAttributes(this->Attributes);
    this->Composite->SetInputDataObject(this->Blocks);
  }

  /// Of cells in turns of the classes and of a channel, the radiance relative to the material
  /// alone.
  void ExpectScaled(const FloatImage& image, int classes, const std::function<double(int)>& scale)
  {
    for (int y = 0; y < Pixels; ++y)
    {
      for (int x = 0; x < Pixels; ++x)
      {
        const Place place(x, y);
        const auto k = static_cast<std::size_t>(place.Cell % classes);
        for (int c = 0; c < 3 && !place.OnDiagonal; ++c)
        {
          ASSERT_NEAR(image.At(x, y)[c], scale(c) * this->Alone[k].At(x, y)[c], 1e-4)
            << x << " " << y;
        }
      }
    }
  }

  vtkNew<vtkCompositeMeasuredBRDFMapper> Composite;
  vtkNew<vtkCompositeDataDisplayAttributes> Attributes;
  vtkNew<vtkMultiBlockDataSet> Blocks;
};

// The array of classes is the active scalars: it chooses, and colors neither a block of one class
// nor one of several.
TEST_F(MaterialMapBlocks, ScalarsThatChooseColorNoBlock)
{
  this->AddMaterials(2);
  this->RenderAlone();
  this->Blocks->SetBlock(0, this->Sheet);
  this->Composite->SetMaterialMap(this->Map);
  this->Actor->SetMapper(this->Composite);
  for (const int classes : { 1, 2 })
  {
    this->SetClassesOfCells(classes);
    this->Sheet->GetCellData()->SetActiveScalars("data");
    this->Blocks->Modified();
    this->ExpectScaled(this->RenderLinear(), classes, [](int) { return 1.0; });
  }
  // Other scalars color both.
  this->ColorCellsRed();
  for (const int classes : { 1, 2 })
  {
    this->SetClassesOfCells(classes);
    this->Blocks->Modified();
    const FloatImage red = this->RenderLinear(); // the lookup table's first color
    EXPECT_LT(red.At(20, 30)[1], 0.01 * this->Alone[0].At(20, 30)[1]) << classes;
  }
}

// Classes of cells against the same cells in a block for each class, in perspective: the same
// pixels, to the last one along borders and silhouette.
TEST_F(MaterialMapBlocks, BordersOfCellsAreThoseOfBlocks)
{
  this->AddMaterials(5);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.9);
  sphere->SetThetaResolution(23);
  sphere->SetPhiResolution(17);
  vtkNew<vtkPolyDataNormals> facets; // a point of its own for each corner
  facets->SetInputConnection(sphere->GetOutputPort());
  facets->SplittingOff();
  facets->Update();
  this->Sheet->ShallowCopy(facets->GetOutput());
  const vtkIdType cells = this->Sheet->GetNumberOfCells();
  const auto classOf = [](vtkIdType cell)
  { return static_cast<int>((7 * cell * cell + cell) % 5); };
  this->SetArray(this->Sheet->GetCellData(), cells, 1,
    [&](vtkIdType cell, int) { return static_cast<double>(classOf(cell)); });
  this->Actor->RotateX(40.0);
  this->Actor->RotateY(25.0);
  this->Renderer->GetActiveCamera()->ParallelProjectionOff();
  this->Renderer->GetActiveCamera()->SetViewAngle(24.0);
  this->Window->SetSize(150, 150);
  this->Mapper->SetMaterialMap(this->Map);
  const FloatImage mapped = this->RenderEncoded();
  for (int k = 0; k < 5; ++k)
  {
    vtkNew<vtkPolyData> block;
    block->ShallowCopy(this->Sheet);
    vtkNew<vtkCellArray> polygons;
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
      vtkNew<vtkIdList> corners;
      this->Sheet->GetCellPoints(cell, corners);
      if (classOf(cell) == k)
      {
        polygons->InsertNextCell(corners);
      }
    }
    block->SetPolys(polygons);
    block->GetCellData()->Initialize();
    const auto index = static_cast<unsigned int>(k);
    this->Blocks->SetBlock(index, block);
    this->Composite->SetBlockBRDF(index + 1, this->Materials[k]);
  }
  this->Actor->SetMapper(this->Composite);
  const FloatImage blocks = this->RenderEncoded();
  // 1.3e-4 on a graphics card; next to a step of a table's profile rounding chooses the texel.
  const double limit = 2.0 * this->GetLimit(0.5 * Same);
  std::size_t covered = 0;
  std::size_t apart = 0;
  for (std::size_t k = 0; k < mapped.RGBA.size(); ++k)
  {
    ASSERT_NEAR(mapped.RGBA[k], blocks.RGBA[k], std::max(limit, 2e-4));
    apart += std::abs(mapped.RGBA[k] - blocks.RGBA[k]) > limit ? 1 : 0;
    covered += k % 4 == 0 && mapped.RGBA[k] > 0.0f ? 1 : 0;
  }
  EXPECT_GT(covered, 10000u);
  EXPECT_LT(apart, covered / 500);
}

// A block's own color takes the place of scalars, divided or not; in newer VTK scalars go first.
TEST_F(MaterialMapBlocks, ABlocksColorGoesBeforeScalars)
{
  this->AddMaterials(2);
  this->RenderAlone();
  this->ColorCellsRed();
  this->Blocks->SetBlock(0, this->Sheet);
  this->Actor->SetMapper(this->Composite);
  const double color[3] = { 0.9, 0.5, 0.7 };
  // What VTK does without a material.
  this->Composite->SetBlockColor(1, color);
  this->Actor->GetProperty()->LightingOff();
  const bool isFirst = this->RenderLinear().At(20, 30)[1] > 0.1;
  this->Actor->GetProperty()->LightingOn();
  this->Composite->RemoveBlockColor(1);
  this->Composite->SetMaterialMap(this->Map);
  for (const int classes : { 1, 2 })
  {
    this->SetClassesOfCells(classes);
    this->Blocks->Modified();
    this->RenderLinear(); // colored by scalars before
    this->Composite->SetBlockColor(1, color);
    this->ExpectScaled(this->RenderLinear(), classes,
      [&](int c) { return isFirst ? std::pow(color[c], 2.2) : (c == 0 ? 1.0 : 0.0); });
    this->Composite->RemoveBlockColor(1);
    EXPECT_LT(this->RenderLinear().At(20, 30)[1], 0.01 * this->Alone[0].At(20, 30)[1]) << classes;
  }
}
}

//------------------------------------------------------------------------------
// Polygons that a material map cuts show what they show whole: of several materials that are equal,
// no cut is seen, whatever drawing reads of the points.
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
  const auto selection = SelectCells(20, 60);
  this->Actor->GetProperty()->SetSelectionColor(1.0, 0.0, 1.0, 1.0);
  this->Mapper->SetSelection(selection);
  this->ExpectUnseen("selected cells");
}
}

//------------------------------------------------------------------------------
// Many classes of cells, which are drawn one after the other from common buffers: each shows what
// its material shows alone, whatever the last one has left behind.
namespace
{
class ManyClasses : public MaterialMapping
{
protected:
  static constexpr int Count = 12;

  void SetUp() override
  {
    MaterialMapping::SetUp();
    if (!IsSkipped())
    {
      this->SetCells([](vtkIdType cell, int) { return static_cast<double>((5 * cell) % Count); });
    }
  }

  void AddMaterialsOfSeveralShaders()
  {
    this->AddMaterials(Count);
    this->RemoveSomeTerms();
  }

  void ExpectEachAlone()
  {
    this->RenderAlone();
    this->ExpectMixture([](const Place& place, int k)
      { return place.OnDiagonal ? -1.0 : ((5 * place.Cell) % Count == k ? 1.0 : 0.0); });
  }

  /// The picture of another mapper that never drew anything else.
  FloatImage RenderAnew()
  {
    vtkNew<vtkMeasuredBRDFMapper> other;
    other->SetInputData(this->Sheet);
    other->SetEnvironment(this->Environment);
    other->SetMaterialMap(this->Map);
    other->SetIntegrator(this->Mapper->GetIntegrator());
    other->SetErrorTolerance(this->Mapper->GetErrorTolerance());
    this->Actor->SetMapper(other);
    const FloatImage picture = this->RenderLinear();
    this->Actor->SetMapper(this->Mapper);
    return picture;
  }
};

TEST_F(ManyClasses, OfSeveralShadersUnderALight)
{
  this->AddMaterialsOfSeveralShaders();
  this->AddLight();
  this->ExpectEachAlone();
  const FloatImage first = this->RenderLinear();
  this->Renderer->RemoveAllLights();
  this->ExpectSame(this->RenderLinear(), this->RenderAnew(), "without the light");
  this->AddLight();
  this->ExpectSame(this->RenderLinear(), first, "with it again");
}

// A cell's color is found by the number of its triangle in what is drawn at once.
TEST_F(ManyClasses, ColorsOfCellsStayTheirOwn)
{
  this->AddMaterialsOfSeveralShaders();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("colors");
  colors->SetNumberOfComponents(3);
  for (int cell = 0; cell < 2 * Side * Side; ++cell)
  {
    colors->InsertNextTuple3(40 + cell, 255 - cell, 50 + (37 * cell) % 200);
  }
  this->Sheet->GetCellData()->AddArray(colors);
  this->Mapper->SetScalarModeToUseCellFieldData();
  this->Mapper->SelectColorArray("colors");
  this->ExpectEachAlone();
}

// What is known of a frame's materials holds until something changes.
TEST_F(ManyClasses, FollowEveryChange)
{
  this->AddMaterials(Count);
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetErrorTolerance(0.3);
  this->Mapper->SetMaterialMap(this->Map);
  FloatImage last = this->RenderLinear();
  this->ExpectSame(this->RenderLinear(), last, "nothing changed");
  const auto expectChange = [this, &last](const char* what)
  {
    const FloatImage now = this->RenderLinear();
    this->ExpectSame(now, this->RenderAnew(), what);
    double largest = 0.0;
    for (int y = 0; y < Pixels; ++y)
    {
      for (int x = 0; x < Pixels; ++x)
      {
        largest = std::max(largest, std::abs(double(now.At(x, y)[1]) - last.At(x, y)[1]));
      }
    }
    EXPECT_GT(largest, 1e-3) << what;
    last = now;
  };
  vtkLambertBRDF::SafeDownCast(this->Materials[3]->GetTerm(0))->SetAlbedo(0.9, 0.9, 0.9);
  expectChange("a material");
  this->Environment->SetRotationY(90.0);
  expectChange("the environment's rotation");
  this->Map->SetBRDF(5, this->Materials[3]);
  expectChange("the map");
  this->SetCells([](vtkIdType cell, int) { return static_cast<double>((7 * cell) % Count); });
  expectChange("the data");
  this->Mapper->ReleaseGraphicsResources(this->Window);
  this->ExpectSame(this->RenderLinear(), last, "resources released");
  this->Actor->GetProperty()->EdgeVisibilityOn(); // each class has a mapper of its own now
  expectChange("edges");
  this->Actor->GetProperty()->EdgeVisibilityOff();
  expectChange("no edges");
}

// A window that the surface leaves loses none of its own buffers, although the mapper's are in
// another window by then; nor does it where the data change.
TEST_F(ManyClasses, LeaveOtherWindowsAlone)
{
  if (this->IsWithoutDisplay())
  {
    GTEST_SKIP() << "VTK's EGL windows cannot share a mapper";
  }
  this->AddMaterialsOfSeveralShaders();
  this->Mapper->SetMaterialMap(this->Map);
  vtkNew<vtkPolyDataMapper> plain;
  plain->SetInputData(this->Sheet);
  plain->ScalarVisibilityOff();
  vtkNew<vtkActor> stays;
  stays->SetMapper(plain);
  stays->SetScale(0.5);
  this->AddLight();
  this->Renderer->RemoveActor(this->Actor);
  this->Renderer->AddActor(stays);
  const FloatImage alone = this->RenderLinear();
  vtkNew<vtkRenderer> otherRenderer;
  vtkNew<vtkRenderWindow> other;
  other->SetOffScreenRendering(1);
  other->SetSize(32, 32);
  other->AddRenderer(otherRenderer);
  otherRenderer->AddActor(this->Actor);
  for (int turn = 1; turn <= 2; ++turn)
  {
    this->Renderer->AddActor(this->Actor);
    this->RenderLinear();
    other->Render();
    this->SetCells([turn](vtkIdType cell, int) { return (cell + turn) % Count; });
    if (turn == 2)
    {
      this->RenderLinear();
      other->Render();
    }
    this->Renderer->RemoveActor(this->Actor);
    this->ExpectSame(this->RenderLinear(), alone, "after the surface has left");
    other->Render();
  }
}
}

//------------------------------------------------------------------------------
// Material maps from frame to frame: plans in the making, uploads, times, highlights; and many
// materials in one polygon.
namespace
{
// More than texture units hold at once, within single triangles.
TEST_F(MaterialMapping, ManyMaterialsOfAScaleInOneTriangle)
{
  constexpr int count = 14;
  this->AddMaterials(count);
  this->SetPointValues(
    [](vtkIdType point)
    {
      const vtkIdType corner = (point + point / (Side + 1)) % 3;
      return corner == 0 ? -1.0 : (corner == 1 ? 0.5 * count : count + 1.0);
    });
  this->RenderAlone();
  this->ExpectValuesBlend(2e-4);
}

// An array for each material; whichever of them is the active scalars.
TEST_F(MaterialMapping, NoneOfSeveralWeightArraysColors)
{
  this->AddMaterials(3);
  const auto weightOf = [](vtkIdType point, int k)
  { return k == 0 ? 1.0 : 0.1 * k * static_cast<double>(point % 7); };
  this->AddWeightArrays(weightOf);
  this->RenderAlone();
  for (int scalars = 0; scalars < 3; ++scalars)
  {
    this->Sheet->GetPointData()->SetActiveScalars(("weight " + std::to_string(scalars)).c_str());
    this->Sheet->Modified();
    SCOPED_TRACE(scalars);
    this->ExpectMixture(
      [&](const Place& place, int k)
      {
        return place.Interpolate(
          [&](vtkIdType point)
          {
            const double sum = weightOf(point, 0) + weightOf(point, 1) + weightOf(point, 2);
            return weightOf(point, k) / sum;
          });
      },
      1e-4);
  }
}

// What is between the first image's texels is seen, too; so is where there is nothing.
TEST_F(MaterialMapping, WeightImagesOfDifferentSizes)
{
  this->AddMaterials(3);
  this->AddWeightImage(2, 1, VTK_FLOAT, [](int, int, int) { return 1.0; });
  this->AddWeightImage(Pixels, 1, VTK_FLOAT,
    [](int x, int, int) { return x % 2 == 1 ? 3.0 : 0.0; }); // no column of the first's
  this->AddWeightImage(2, 1, VTK_FLOAT, [](int, int, int) { return 0.0; });
  this->RenderAlone();
  this->ExpectMixture(
    [](const Place& place, int k)
    {
      const double second = static_cast<int>(place.U * Pixels) % 2 == 1 ? 3.0 : 0.0;
      return k == 0 ? 1.0 / (1.0 + second) : (k == 1 ? second / (1.0 + second) : 0.0);
    },
    2e-3);
}

TEST_F(MaterialMapping, OnlyChangedImagesAreUploaded)
{
  this->AddMaterials(2);
  const auto image = this->AddWeightImage(4, 2, VTK_FLOAT, [](int, int, int) { return 1.0; });
  this->Mapper->SetMaterialMap(this->Map);
  this->Window->Render();
  std::string problem;
  const auto textures = measuredbrdf::FindWeightTextures(
    this->Map, vtkOpenGLRenderWindow::SafeDownCast(this->Window), problem);
  std::set<const vtkTextureObject*> last;
  const auto areNew = [&]()
  {
    std::set<const vtkTextureObject*> now;
    textures->CountBytes(now);
    return std::exchange(last, now) != now;
  };
  EXPECT_TRUE(areNew());
  this->Materials[1]->RemoveAllTerms();
  this->Map->SetName(0, "renamed");
  this->Window->Render();
  EXPECT_FALSE(areNew());
  image->GetPointData()->GetScalars()->Fill(2.0);
  image->GetPointData()->GetScalars()->Modified();
  this->Window->Render();
  EXPECT_TRUE(areNew());
  this->Map->RepeatWeightImagesOff();
  this->Window->Render();
  EXPECT_TRUE(areNew());
  // They count among the bytes in use.
  const vtkIdType bytes = this->Mapper->GetTextureBytes();
  image->SetDimensions(64, 64, 1);
  image->AllocateScalars(VTK_FLOAT, 2);
  image->GetPointData()->GetScalars()->Fill(1.0);
  this->Window->Render();
  EXPECT_GT(this->Mapper->GetTextureBytes(), bytes + 4 * (64 * 64 - 4 * 4) * 2);
}

// A material that leaves the map, or the surface, while it is planned in the background is waited
// for no more.
TEST_F(MaterialMapping, PlansOfMaterialsThatLeaveAreGivenUp)
{
  this->AddMaterials(1);
  vtkNew<GatedBRDF> gated;
  this->Map->AddMaterial(gated);
  this->SetClassesOfCells(2);
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetErrorTolerance(0.1);
  this->Mapper->SetMaterialMap(this->Map);
  this->Mapper->SetPlanningModeToBackground();
  this->Window->Render();
  EXPECT_FALSE(this->Mapper->GetPlanPending());
  for (const bool ofMap : { true, false })
  {
    gated->Door->Close();
    gated->SetExponent(ofMap ? 7.0 : 9.0);
    this->Window->Render();
    EXPECT_TRUE(this->Mapper->GetPlanPending());
    if (ofMap)
    {
      this->Map->SetBRDF(1, this->Materials[0]);
    }
    else
    {
      this->SetCells([](vtkIdType, int) { return 0.0; });
    }
    this->Window->Render();
    EXPECT_FALSE(this->Mapper->GetPlanPending()) << ofMap;
    EXPECT_FALSE(this->Mapper->GetPlanReady()) << ofMap;
    gated->Door->OpenUp();
    this->Map->SetBRDF(1, gated); // back again
    this->Window->Render();
    for (int wait = 0; wait < 1000 && this->Mapper->GetPlanPending(); ++wait)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      this->Window->Render();
    }
    EXPECT_FALSE(this->Mapper->GetPlanPending()) << ofMap;
  }
}

// Actors with levels of detail ask for it. VTK takes the time of small surfaces now and then.
TEST_F(MaterialMapping, TimeOfAllPartsIsTaken)
{
  this->AddMaterials(2);
  this->SetClassesOfCells(2);
  this->Mapper->SetMaterialMap(this->Map);
  this->Window->Render();
  const double before = this->Mapper->GetTimeToDraw();
  for (int frame = 0; frame < 205; ++frame) // the second time, for it may come late
  {
    this->Window->Render();
  }
  EXPECT_GT(this->Mapper->GetTimeToDraw(), 0.0);
  EXPECT_NE(this->Mapper->GetTimeToDraw(), before);
}

// What VTK draws of a selection shows over the parts as it does over a whole.
TEST_F(MaterialMapping, SelectedCellsAreHighlighted)
{
  this->AddMaterials(2);
  this->RenderAlone();
  this->SetCells([](vtkIdType, int) { return 0.0; });
  this->Actor->GetProperty()->SetSelectionColor(1.0, 0.0, 1.0, 1.0);
  this->Actor->GetProperty()->SetSelectionLineWidth(3.0f);
  const auto selection = SelectCells(2 * (3 * Side + 4), 2 * (3 * Side + 4) + 1);
  const FloatImage plain = this->RenderEncoded();
  const auto render = [&](bool map)
  {
    this->Mapper->SetMaterialMap(map ? this->Map.Get() : nullptr);
    this->Mapper->SetBRDF(map ? nullptr : this->Materials[0].Get());
    this->Mapper->SetSelection(selection);
    return this->RenderEncoded();
  };
  const FloatImage whole = render(false);
  const FloatImage parts = render(true);
  int highlighted = 0;
  for (std::size_t k = 0; k < whole.RGBA.size(); ++k)
  {
    ASSERT_NEAR(parts.RGBA[k], whole.RGBA[k], Same) << k;
    highlighted += std::abs(parts.RGBA[k] - plain.RGBA[k]) > 0.1f ? 1 : 0;
  }
  EXPECT_GT(highlighted, 20);
  this->Mapper->SetSelection(nullptr);
  EXPECT_EQ(this->RenderEncoded().RGBA, plain.RGBA);
}

// Programs set uniforms of their own in the event of the mapper that they know.
TEST_F(MaterialMapping, ShaderEventsAreTheMappers)
{
  this->AddMaterials(2);
  this->SetClassesOfCells(2);
  this->Mapper->SetMaterialMap(this->Map);
  EventCounter events(this->Mapper, vtkCommand::UpdateShaderEvent);
  this->Window->Render();
  EXPECT_EQ(events.Count, 2); // one for each
}

// A map that fits no more leaves no plans and textures behind.
TEST_F(MaterialMapping, NothingStaysOfAMapThatFitsNoMore)
{
  this->AddMaterials(3);
  this->SetClassesOfCells(3);
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetErrorTolerance(0.1);
  this->Mapper->SetMaterialMap(this->Map);
  this->Mapper->SetBRDF(this->Materials[0]);
  this->Window->Render();
  const vtkIdType bytes = this->Mapper->GetTextureBytes();
  this->Map->SetArrayName("no such array");
  this->Window->Render();
  const std::string plan = this->Mapper->GetPlan();
  EXPECT_EQ(std::count(plan.begin(), plan.end(), '\n'), 0) << plan;
  EXPECT_LT(this->Mapper->GetTextureBytes(), bytes);
}

// Weights that are negative in another number of places each time step are one cause.
TEST_F(MaterialMapping, OddDataAreSaidOnce)
{
  this->AddMaterials(2);
  this->Map->SetModeToWeights();
  this->Mapper->SetMaterialMap(this->Map);
  EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
  for (int step = 1; step < 4; ++step)
  {
    this->SetPoints([step](vtkIdType point, int) { return point < step ? -1.0 : 1.0; }, 2);
    this->Window->Render();
  }
  EXPECT_EQ(warnings.Count, 1);
}

// Image files have three components for two materials, too.
TEST_F(MaterialMapping, WeightsOfNoMaterialAreSaidUnlessTheyAreZero)
{
  this->AddMaterials(2);
  const auto image =
    this->AddWeightImage(4, 3, VTK_FLOAT, [](int, int, int c) { return c < 2 ? 1.0 : 0.0; });
  vtkDataArray* weights = image->GetPointData()->GetScalars();
  this->Mapper->SetMaterialMap(this->Map);
  EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
  this->Window->Render();
  EXPECT_EQ(warnings.Count, 0);
  weights->FillComponent(2, 0.5);
  weights->Modified();
  image->Modified();
  this->Window->Render();
  this->Window->Render();
  EXPECT_EQ(warnings.Count, 1);
}

// Two windows that are drawn in turns keep their images of weights.
TEST_F(MaterialMapping, TwoWindowsKeepTheirImages)
{
  this->AddMaterials(2);
  this->AddWeightImage(4, 2, VTK_FLOAT, [](int, int, int) { return 1.0; });
  this->Mapper->SetMaterialMap(this->Map);
  vtkNew<vtkRenderer> otherRenderer;
  vtkNew<vtkRenderWindow> other;
  other->SetOffScreenRendering(1);
  other->SetSize(32, 32);
  other->AddRenderer(otherRenderer);
  otherRenderer->AddActor(this->Actor);
  this->Window->Render();
  other->Render();
  std::string problem;
  std::set<const vtkTextureObject*> uploaded;
  std::weak_ptr<measuredbrdf::ShaderTextures> first = measuredbrdf::FindWeightTextures(
    this->Map, vtkOpenGLRenderWindow::SafeDownCast(this->Window), problem);
  ASSERT_FALSE(first.expired());
  first.lock()->CountBytes(uploaded);
  this->Window->Render();
  other->Render();
  ASSERT_FALSE(first.expired());
  EXPECT_EQ(first.lock()->CountBytes(uploaded), 0u);
}
}

//------------------------------------------------------------------------------
// Material maps beside what else mappers do: no material, limits, changes, selection, blocks.
namespace
{
// A class without a material is drawn as VTK's mapper draws it, between points, too.
TEST_F(MaterialMapping, NoMaterialIsTheSuperclass)
{
  this->AddHeadlight();
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
      this->SetClassesOfCells(2);
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
      const float value = image.RGBA[4 * k + c];
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
  this->SetClassesOfCells(2);
  this->Sheet->GetCellData()->SetActiveScalars("data");
  this->ExpectMixture([](const Place& place, int k) { return GetWeightInTurns(place, k, 2); });
  this->Map->AddMaterial(nullptr, 7.0); // beside a class without a material, too
  this->SetCells(
    [](vtkIdType cell, int) { return cell == 0 ? 7.0 : static_cast<double>(cell % 2); });
  this->Sheet->GetCellData()->SetActiveScalars("data");
  this->ExpectMixture([](const Place& place, int k)
    { return place.Cell == 0 ? -1.0 : GetWeightInTurns(place, k, 2); });
  this->ColorCellsRed(); // other scalars do
  const FloatImage colored = this->RenderLinear();
  EXPECT_LT(colored.At(20, 30)[1], 0.01 * this->Alone[0].At(20, 30)[1]);
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
  this->SetPointValues([](vtkIdType point) { return 0.2 * static_cast<double>(point % 11); });
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetMaterialMap(this->Map);
  this->Window->Render();
  const std::string plan = this->Mapper->GetPlan();
  EXPECT_EQ(std::count(plan.begin(), plan.end(), '\n'), 3) << plan;
  // Of all materials together: between those of each.
  const std::string before = "together: predicted error ";
  ASSERT_NE(plan.find(before), std::string::npos) << plan;
  std::istringstream number(plan.substr(plan.find(before) + before.size()));
  double together = 0.0;
  number >> together;
  double least = 100.0;
  double largest = 0.0;
  const vtkIdType bytes = this->Mapper->GetTextureBytes();
  this->Mapper->SetMaterialMap(nullptr);
  vtkIdType single = 0;
  for (const auto& brdf : this->Materials)
  {
    this->Mapper->SetBRDF(brdf);
    this->Window->Render();
    single += this->Mapper->GetTextureBytes();
    vtkRadiancePlanner* planner = this->Mapper->GetCurrentPlanner();
    const double percent = 100.0 * planner->GetPredictedError(planner->GetChoice());
    least = std::min(least, percent);
    largest = std::max(largest, percent);
  }
  EXPECT_GE(together, 0.99 * least) << plan;
  EXPECT_LE(together, 1.01 * largest) << plan;
  EXPECT_LE(bytes, single);
}

// Blocks are divided as single surfaces are; a block's own material comes first.
TEST_F(MaterialMapping, CompositeDataShowTheSame)
{
  this->AddMaterials(3);
  this->SetPointValues([](vtkIdType point) { return 0.2 * static_cast<double>(point % 11); });
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
  this->ExpectSame(this->RenderLinear(), plain, "opaque");
  this->Actor->SetMapper(this->Mapper);
  this->Actor->GetProperty()->SetOpacity(0.5);
  const FloatImage thin = this->RenderEncoded();
  this->Actor->GetProperty()->SetOpacity(1.0);
  this->Actor->SetMapper(composite);
  composite->SetBlockOpacity(1, 0.5);
  this->ExpectSame(this->RenderEncoded(), thin, "translucent");
  composite->RemoveBlockOpacity(1);
  composite->SetBlockBRDF(1, this->Materials[0]);
  EXPECT_NEAR(this->RenderLinear().At(30, 30)[0], this->Alone[0].At(30, 30)[0], Same);
  composite->RemoveBlockBRDFs();
  composite->SetBlockVisibility(1, false);
  EXPECT_EQ(this->RenderLinear().At(30, 30)[0], 0.0f);
}
}

//------------------------------------------------------------------------------
// The legend of a material map: its entries, its pictures, where they are drawn.
namespace
{
/// The picture of the window, without the passes of this fixture, which leave out 2D actors.
class MaterialLegend : public RenderFixture
{
protected:
  void SetUp() override
  {
    RenderFixture::SetUp();
    if (IsSkipped())
    {
      return;
    }
    this->White->SetPixels(8, 4, std::vector<float>(96, 1.0f));
    this->Red->SetAlbedo(0.5, 0.1, 0.1);
    this->Blue->SetAlbedo(0.1, 0.1, 0.5);
    this->Map->AddMaterial(this->Red, 4.0);
    this->Map->AddMaterial(nullptr, 5.0, "nothing");
    this->Map->AddMaterial(this->Blue, 6.0, "sky");
    this->Legend->SetMaterialMap(this->Map);
    this->Legend->SetEnvironment(this->White);
    this->Legend->SetPosition(0.0, 0.0);
    this->Legend->SetPosition2(1.0, 1.0);
    this->Renderer->AddViewProp(this->Legend);
    this->Window->SetSize(200, 200);
  }

  /// RGB of a pixel, from 0 to 1.
  std::array<double, 3> GetPixel(int x, int y)
  {
    this->Window->Render();
    vtkNew<vtkUnsignedCharArray> pixel;
    this->Window->GetRGBACharPixelData(x, y, x, y, 0, pixel);
    return { pixel->GetValue(0) / 255.0, pixel->GetValue(1) / 255.0, pixel->GetValue(2) / 255.0 };
  }
  static void ExpectAlbedo(const std::array<double, 3>& pixel, double r, double g, double b)
  {
    const double expected[3] = { r, g, b };
    for (std::size_t c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(pixel[c], std::pow(expected[c], 1.0 / 2.2), 0.02);
    }
  }

  vtkNew<vtkEnvironment> White;
  vtkNew<vtkLambertBRDF> Red;
  vtkNew<vtkLambertBRDF> Blue;
  vtkNew<vtkMaterialMap> Map;
  vtkNew<vtkMaterialLegendActor> Legend;
};

TEST_F(MaterialLegend, DrawsSpheresBelowEachOther)
{
  ExpectAlbedo(this->GetPixel(50, 150), 0.5, 0.1, 0.1); // the first one on top
  ExpectAlbedo(this->GetPixel(50, 50), 0.1, 0.1, 0.5);
  EXPECT_EQ(this->GetPixel(2, 100)[0], 0.0);
  this->Blue->SetAlbedo(0.3, 0.3, 0.3);
  ExpectAlbedo(this->GetPixel(50, 50), 0.3, 0.3, 0.3);
  this->Legend->SetTitle("materials");
  ExpectAlbedo(this->GetPixel(40, 130), 0.5, 0.1, 0.1);
  ExpectAlbedo(this->GetPixel(40, 40), 0.3, 0.3, 0.3);
}

// As the scene is, whose light is in cd/m2, say.
TEST_F(MaterialLegend, IsExposedByAToneMappingPass)
{
  this->White->SetPixels(8, 4, std::vector<float>(96, 1000.0f));
  vtkNew<vtkToneMappingPass> exposure;
  vtkNew<vtkRenderStepsPass> steps;
  exposure->SetToneMappingType(vtkToneMappingPass::Exponential);
  exposure->SetExposure(1e-3f);
  exposure->SetDelegatePass(steps);
  this->Renderer->SetPass(exposure);
  ExpectAlbedo(
    this->GetPixel(50, 150), 1.0 - std::exp(-0.5), 1.0 - std::exp(-0.1), 1.0 - std::exp(-0.1));
}

// 60 materials in four columns; in a window of another size, too; the map's changes show.
TEST_F(MaterialLegend, ManyMaterialsInColumns)
{
  this->Map->RemoveAllMaterials();
  for (int k = 0; k < 60; ++k)
  {
    this->Map->AddMaterial(k == 15 ? this->Blue : this->Red, k);
  }
  ExpectAlbedo(this->GetPixel(6, 193), 0.5, 0.1, 0.1);
  ExpectAlbedo(this->GetPixel(56, 193), 0.1, 0.1, 0.5);
  ExpectAlbedo(this->GetPixel(56, 180), 0.5, 0.1, 0.1);
  this->Map->SetBRDF(15, this->Red);
  this->Map->SetBRDF(16, this->Blue);
  ExpectAlbedo(this->GetPixel(56, 193), 0.5, 0.1, 0.1);
  ExpectAlbedo(this->GetPixel(56, 180), 0.1, 0.1, 0.5);
  this->Window->SetSize(400, 400);
  ExpectAlbedo(this->GetPixel(112, 360), 0.1, 0.1, 0.5);
  this->Map->RemoveAllMaterials();
  EXPECT_EQ(this->GetPixel(112, 360)[2], 0.0);
}

// Names that are too long are small, and end where the legend does.
TEST_F(MaterialLegend, LongNamesEndWithTheLegend)
{
  this->Map->SetName(0, "a name too long for 100 pixels");
  this->Map->SetName(2, "\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4\xC3\xB6\xC3\xBC");
  this->Legend->SetPosition2(0.5, 1.0);
  this->Window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  this->Window->GetRGBACharPixelData(0, 0, 199, 199, 0, pixels);
  int lit = 0;
  for (vtkIdType p = 0; p < 200 * 200; ++p)
  {
    const bool isText = pixels->GetTypedComponent(p, 0) > 60 &&
                        pixels->GetTypedComponent(p, 0) == pixels->GetTypedComponent(p, 2);
    lit += isText ? 1 : 0;
    ASSERT_TRUE(p % 200 < 102 || pixels->GetTypedComponent(p, 0) == 0) << p % 200 << " " << p / 200;
  }
  EXPECT_GT(lit, 10);
}
}
