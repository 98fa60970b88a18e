// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Composite data: the same pixels as with a plain mapper for each block, whatever the tree.
#include "EventCounter.h"
#include "RenderFixture.h"

#include "vtkBlinnPhongBRDF.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"

#include <set>
#include <sstream>

namespace
{
/// Four spheres in a row of two, as blocks in a tree.
class Composite : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    for (int k = 0; k < 4; ++k)
    {
      vtkNew<vtkSphereSource> sphere;
      sphere->SetCenter(k % 2 - 0.5, k / 2 - 0.5, 0.0);
      sphere->SetRadius(0.45);
      sphere->SetThetaResolution(20);
      sphere->SetPhiResolution(20);
      sphere->Update();
      this->Blocks[k] = sphere->GetOutput();
    }
    this->Sky->SetToProceduralSky();
    this->Lambert->SetAlbedo(0.7, 0.2, 0.1);
    this->Gloss->SetSpecular(0.3, 0.3, 0.3);
    this->Gloss->SetExponent(30.0);
    for (vtkCompositeMeasuredBRDFMapper* mapper : { this->Mapper.Get() })
    {
      mapper->SetEnvironment(this->Sky);
      mapper->SetIntegrator(this->Lights);
    }
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
  }

  /// 0: root, 1: a block, 2: missing, 3: a group of 4: an empty block, 5, 6 and 7: blocks.
  vtkSmartPointer<vtkMultiBlockDataSet> MakeTree()
  {
    vtkNew<vtkMultiBlockDataSet> group;
    vtkNew<vtkPolyData> empty;
    group->SetBlock(0, empty);
    for (unsigned int k = 1; k < 4; ++k)
    {
      group->SetBlock(k, this->Blocks[k]);
    }
    group->GetMetaData(3u)->Set(vtkCompositeDataSet::NAME(), "last");
    auto root = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    root->SetNumberOfBlocks(3);
    root->SetBlock(0, this->Blocks[0]);
    root->SetBlock(2, group);
    root->GetMetaData(2u)->Set(vtkCompositeDataSet::NAME(), "group");
    return root;
  }

  /// Each block by a plain mapper, null: not at all.
  FloatImage RenderApart(const std::vector<vtkBRDF*>& materials, double opacity = 1.0)
  {
    std::vector<vtkSmartPointer<vtkActor>> actors;
    for (std::size_t k = 0; k < 4; ++k)
    {
      if (!materials[k])
      {
        continue;
      }
      vtkNew<vtkMeasuredBRDFMapper> mapper;
      mapper->SetInputData(this->Blocks[k]);
      mapper->SetEnvironment(this->Sky);
      mapper->SetIntegrator(this->Lights);
      mapper->SetBRDF(materials[k]);
      auto actor = vtkSmartPointer<vtkActor>::New();
      actor->SetMapper(mapper);
      actor->GetProperty()->SetOpacity(opacity);
      this->Renderer->AddActor(actor);
      actors.push_back(actor);
    }
    this->Actor->VisibilityOff();
    const FloatImage image = this->RenderEncoded();
    this->Actor->VisibilityOn();
    for (vtkActor* actor : actors)
    {
      this->Renderer->RemoveActor(actor);
    }
    return image;
  }

  vtkSmartPointer<vtkPolyData> Blocks[4];
  vtkNew<vtkEnvironment> Sky;
  vtkNew<vtkLambertBRDF> Lambert;
  vtkNew<vtkBlinnPhongBRDF> Gloss;
  vtkNew<vtkLightSetRadianceIntegrator> Lights;
  vtkNew<vtkCompositeMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};
}

// By flat index and by name; a block's own before its parent's, an index before a name.
TEST_F(Composite, MaterialsOfBlocks)
{
  vtkNew<vtkLambertBRDF> green;
  green->SetAlbedo(0.1, 0.8, 0.1);
  vtkNew<vtkBlinnPhongBRDF> sharp;
  sharp->SetSpecular(0.5, 0.5, 0.5);
  sharp->SetExponent(200.0);
  this->Mapper->SetInputDataObject(this->MakeTree());
  this->Mapper->SetBRDF(this->Gloss);
  this->Mapper->SetBlockBRDF(3, this->Lambert); // the group
  this->Mapper->SetBlockBRDFByName("last", green);
  EXPECT_LE(GetLargestDifference(this->RenderEncoded(),
              this->RenderApart({ this->Gloss, this->Lambert, this->Lambert, green })),
    1e-6);
  this->Mapper->SetBlockBRDF(7, sharp);
  EXPECT_LE(GetLargestDifference(this->RenderEncoded(),
              this->RenderApart({ this->Gloss, this->Lambert, this->Lambert, sharp })),
    1e-6);
  EXPECT_TRUE(this->Mapper->HasBlockBRDF(7));
  vtkNew<vtkCompositeMeasuredBRDFMapper> copy;
  copy->ShallowCopy(this->Mapper);
  EXPECT_EQ(copy->GetBlockBRDF(7), sharp);
  std::ostringstream text;
  copy->Print(text);
  EXPECT_NE(text.str().find("BlockBRDF 7"), std::string::npos);
  this->Mapper->RemoveBlockBRDF(7);
  this->Mapper->RemoveBlockBRDF(3);
  EXPECT_LE(GetLargestDifference(this->RenderEncoded(),
              this->RenderApart({ this->Gloss, this->Gloss, this->Gloss, green })),
    1e-6);
  this->Mapper->RemoveBlockBRDFs();
  EXPECT_LE(GetLargestDifference(this->RenderEncoded(),
              this->RenderApart({ this->Gloss, this->Gloss, this->Gloss, this->Gloss })),
    1e-6);
}

// Visibility, opacity and color of blocks; a hidden block of one material stays hidden among
// others.
TEST_F(Composite, DisplayAttributes)
{
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  this->Mapper->SetCompositeDataDisplayAttributes(attributes);
  this->Mapper->SetInputDataObject(this->MakeTree());
  this->Mapper->SetBRDF(this->Gloss);
  this->Mapper->SetBlockBRDF(5, this->Lambert);
  this->Mapper->SetBlockBRDF(6, this->Lambert);
  this->Mapper->SetBlockVisibility(5, false);
  for (int frame = 0; frame < 2; ++frame)
  {
    EXPECT_LE(GetLargestDifference(this->RenderEncoded(),
                this->RenderApart({ this->Gloss, nullptr, this->Lambert, this->Gloss })),
      1e-6);
  }
  this->Mapper->SetBlockVisibility(5, true);
  EXPECT_LE(GetLargestDifference(this->RenderEncoded(),
              this->RenderApart({ this->Gloss, this->Lambert, this->Lambert, this->Gloss })),
    1e-6);

  // A display color, made linear, times the radiance.
  const float before = std::pow(this->RenderEncoded().At(48, 16)[0], 2.2f);
  this->Mapper->SetBlockColor(5, 0.5, 1.0, 1.0);
  const float after = std::pow(this->RenderEncoded().At(48, 16)[0], 2.2f);
  EXPECT_NEAR(after / before, std::pow(0.5, 2.2), 2e-3);
  this->Mapper->SetScalarColoringMode(vtkMeasuredBRDFMapper::IGNORE_SCALARS);
  EXPECT_NEAR(std::pow(this->RenderEncoded().At(48, 16)[0], 2.2f) / before, 1.0, 1e-4);
  this->Mapper->SetScalarColoringMode(vtkMeasuredBRDFMapper::MODULATE);
  this->Mapper->RemoveBlockColors();

  this->Actor->GetProperty()->BackfaceCullingOn();
  this->Mapper->SetBlockOpacity(5, 0.5);
  const FloatImage faint = this->RenderEncoded();
  EXPECT_NEAR(faint.At(48, 16)[0], 0.5 * std::pow(before, 1.0f / 2.2f), 2e-3);
}

// Blocks of no material among others: VTK's own Phong.
TEST_F(Composite, BlocksWithoutMaterial)
{
  this->Mapper->SetInputDataObject(this->MakeTree());
  this->Mapper->SetBRDF(this->Gloss);
  this->Mapper->SetBlockBRDF(5, nullptr);
  this->Actor->GetProperty()->SetAmbient(1.0);
  this->Actor->GetProperty()->SetDiffuse(0.0);
  this->Actor->GetProperty()->SetColor(0.25, 0.5, 0.75);
  const FloatImage image = this->RenderEncoded();
  EXPECT_NEAR(image.At(48, 16)[0], 0.25, 1e-3);
  EXPECT_NEAR(image.At(48, 16)[2], 0.75, 1e-3);
  EXPECT_GT(std::abs(image.At(16, 16)[0] - 0.25f), 0.01f);
}

TEST_F(Composite, PartitionedCollections)
{
  vtkNew<vtkPartitionedDataSetCollection> collection;
  for (unsigned int k = 0; k < 2; ++k)
  {
    vtkNew<vtkPartitionedDataSet> partitions;
    partitions->SetPartition(0, this->Blocks[2 * k]);
    partitions->SetPartition(1, this->Blocks[2 * k + 1]);
    collection->SetPartitionedDataSet(k, partitions);
  }
  collection->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "upper");
  this->Mapper->SetInputDataObject(collection);
  this->Mapper->SetBRDF(this->Gloss);
  this->Mapper->SetBlockBRDFByName("upper", this->Lambert);
  this->Mapper->SetBlockBRDF(2, this->Lambert); // 0 root, 1 partitioned, 2 its first
  EXPECT_LE(GetLargestDifference(this->RenderEncoded(),
              this->RenderApart({ this->Lambert, this->Gloss, this->Lambert, this->Lambert })),
    1e-6);
}

// The data change: blocks come, go and move between batches.
TEST_F(Composite, DataThatChange)
{
  vtkSmartPointer<vtkMultiBlockDataSet> tree = this->MakeTree();
  this->Mapper->SetInputDataObject(tree);
  this->Mapper->SetBRDF(this->Gloss);
  this->Mapper->SetBlockBRDF(1, this->Lambert);
  this->RenderEncoded();
  vtkNew<vtkPolyData> bare; // without normals: another batch
  bare->ShallowCopy(this->Blocks[0]);
  bare->GetPointData()->SetNormals(nullptr);
  tree->SetBlock(0, bare);
  this->RenderEncoded();
  tree->SetBlock(0, this->Blocks[1]);
  tree->SetBlock(2, nullptr);
  EXPECT_LE(GetLargestDifference(this->RenderEncoded(),
              this->RenderApart({ nullptr, this->Lambert, nullptr, nullptr })),
    1e-6);
  this->Mapper->SetInputDataObject(this->Blocks[3]); // no tree at all
  EXPECT_LE(GetLargestDifference(
              this->RenderEncoded(), this->RenderApart({ nullptr, nullptr, nullptr, this->Gloss })),
    1e-6);
}

// A name or an index that is not there: once.
TEST_F(Composite, MissingBlocksAreSaidOnce)
{
  this->Mapper->SetInputDataObject(this->MakeTree());
  this->Mapper->SetBlockBRDF(8, this->Lambert);
  this->Mapper->SetBlockBRDFByName("lost", this->Lambert);
  EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
  this->RenderEncoded();
  this->RenderEncoded();
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_NE(warnings.Text.find("index 8"), std::string::npos) << warnings.Text;
  EXPECT_NE(warnings.Text.find("lost"), std::string::npos) << warnings.Text;
}

// One plan for all blocks of a material; the picture's time follows a block's material.
TEST_F(Composite, PlansAndRedraw)
{
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetErrorTolerance(0.1);
  this->Mapper->SetInputDataObject(this->MakeTree());
  this->Mapper->SetBRDF(this->Lambert);
  EventCounter plans(this->Mapper, vtkCommand::UpdateDataEvent);
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 1);
  vtkNew<vtkLambertBRDF> other;
  other->SetAlbedo(0.1, 0.1, 0.1);
  this->Mapper->SetBlockBRDF(5, other);
  this->Mapper->SetBlockBRDF(6, other);
  this->RenderEncoded();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 2);
  const std::string text = this->Mapper->GetPlan();
  EXPECT_NE(text.find('\n'), std::string::npos) << text;
  EXPECT_GT(this->Mapper->GetTextureBytes(), 0);
  const vtkMTimeType before = this->Actor->GetRedrawMTime();
  other->SetAlbedo(0.9, 0.9, 0.9);
  EXPECT_GT(this->Actor->GetRedrawMTime(), before);
}

// What the plain mapper can't draw, it says once.
TEST_F(Composite, PlainMapperNamesThisOne)
{
  vtkNew<vtkMeasuredBRDFMapper> plain;
  plain->SetInputDataObject(this->MakeTree());
  plain->SetBRDF(this->Gloss);
  plain->SetEnvironment(this->Sky);
  plain->PlanForViewOn();
  this->Actor->SetMapper(plain);
  vtkNew<vtkMeasuredBRDFMapper> other; // which plans for all mappers of the renderer
  other->SetInputData(this->Blocks[0]);
  other->SetBRDF(this->Lambert);
  other->SetEnvironment(this->Sky);
  other->SetErrorTolerance(0.1);
  vtkNew<vtkActor> beside;
  beside->SetMapper(other);
  this->Renderer->AddActor(beside);
  EventCounter warnings(plain, vtkCommand::WarningEvent);
  this->RenderEncoded();
  this->RenderEncoded();
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_NE(warnings.Text.find("vtkCompositeMeasuredBRDFMapper"), std::string::npos);
}
