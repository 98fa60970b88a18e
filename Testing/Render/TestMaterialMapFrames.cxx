// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Material maps from frame to frame: plans in the making, uploads, times, highlights; and many
// materials in one polygon.

#include "MaterialMapFixture.h"

#include "EventCounter.h"
#include "GatedBRDF.h"
#include "WeightImages.h"
#include "vtkCommand.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProperty.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <thread>

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
  const auto textures = measuredbrdf::WeightTextures::Find(
    this->Map, vtkOpenGLRenderWindow::SafeDownCast(this->Window));
  ASSERT_EQ(textures->GetNumberOfUploads(), 1);
  this->Materials[1]->RemoveAllTerms();
  this->Map->SetName(0, "renamed");
  this->Window->Render();
  EXPECT_EQ(textures->GetNumberOfUploads(), 1);
  image->GetPointData()->GetScalars()->Fill(2.0);
  image->GetPointData()->GetScalars()->Modified();
  this->Window->Render();
  EXPECT_EQ(textures->GetNumberOfUploads(), 2);
  this->Map->RepeatWeightImagesOff();
  this->Window->Render();
  EXPECT_EQ(textures->GetNumberOfUploads(), 3);
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
  vtkNew<vtkIdTypeArray> cells;
  cells->InsertNextValue(2 * (3 * Side + 4));
  vtkNew<vtkSelectionNode> node;
  node->SetFieldType(vtkSelectionNode::CELL);
  node->SetContentType(vtkSelectionNode::INDICES);
  node->SetSelectionList(cells);
  vtkNew<vtkSelection> selection;
  selection->AddNode(node);
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
  std::weak_ptr<measuredbrdf::WeightTextures> first = measuredbrdf::WeightTextures::Find(
    this->Map, vtkOpenGLRenderWindow::SafeDownCast(this->Window));
  ASSERT_FALSE(first.expired());
  this->Window->Render();
  other->Render();
  ASSERT_FALSE(first.expired());
  EXPECT_EQ(first.lock()->GetNumberOfUploads(), 1);
}
}
