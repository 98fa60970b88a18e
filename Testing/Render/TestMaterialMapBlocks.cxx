// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Material maps of composite data: blocks of one class, blocks' own colors, cells split into
// blocks.

#include "MaterialMapFixture.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

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
}
