// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Material maps beside what else mappers do: no material, limits, changes, selection, blocks.

#include "MaterialMapFixture.h"

#include "EventCounter.h"
#include "vtkCommand.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

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
