// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What the rest of a VTK scene does with a measured surface: textures, colors, tangents, PBR
// properties, back faces, texture units, redraw, edges, other people's shader replacements.
#include "RenderFixture.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkShaderProperty.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"
#include "vtkTransform.h"

#include <set>

namespace
{
constexpr double Albedo = 0.6;

/// A square that fills the picture, seen head-on, under light of radiance 1 from everywhere.
class Scene : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->Plane->SetOrigin(-1.0, -1.0, 0.0);
    this->Plane->SetPoint1(1.0, -1.0, 0.0);
    this->Plane->SetPoint2(-1.0, 1.0, 0.0);
    this->Plane->Update();
    this->Data->ShallowCopy(this->Plane->GetOutput());
    this->White->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, 1.0f));
    this->Lambert->SetAlbedo(Albedo, Albedo, Albedo);
    this->Measured->SetInputData(this->Data);
    this->Measured->SetBRDF(this->Lambert);
    this->Measured->SetEnvironment(this->White);
    this->Actor->SetMapper(this->Measured);
    this->Renderer->AddActor(this->Actor);
  }

  /// Linear RGB of the middle, which is white furnace times what colors it.
  std::array<float, 3> RenderMiddle()
  {
    const FloatImage image = this->RenderLinear();
    const float* pixel = image.At(32, 32);
    return { pixel[0], pixel[1], pixel[2] };
  }

  static vtkSmartPointer<vtkTexture> MakeTexture(unsigned char r, unsigned char g, unsigned char b)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(2, 2, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* values = static_cast<unsigned char*>(image->GetScalarPointer());
    for (int k = 0; k < 4; ++k)
    {
      values[3 * k] = r;
      values[3 * k + 1] = g;
      values[3 * k + 2] = b;
    }
    auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(image);
    return texture;
  }

  void AddTangents(double x, double y, double z)
  {
    vtkNew<vtkFloatArray> tangents;
    tangents->SetNumberOfComponents(3);
    for (vtkIdType k = 0; k < this->Data->GetNumberOfPoints(); ++k)
    {
      tangents->InsertNextTuple3(x, y, z);
    }
    this->Data->GetPointData()->SetTangents(tangents);
  }

  vtkNew<vtkPlaneSource> Plane;
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkEnvironment> White;
  vtkNew<vtkLambertBRDF> Lambert;
  vtkNew<vtkMeasuredBRDFMapper> Measured;
  vtkNew<vtkActor> Actor;
};

double Decode(double display) { return std::pow(display, 2.2); }
}

// The actor's texture multiplies radiance, as what it is: display colors, or, where it says so,
// sRGB, which OpenGL makes linear.
TEST_F(Scene, TexturesMultiplyLinearly)
{
  vtkSmartPointer<vtkTexture> texture = MakeTexture(255, 188, 0);
  this->Actor->SetTexture(texture);
  std::array<float, 3> middle = this->RenderMiddle();
  EXPECT_NEAR(middle[0], Albedo, 2e-3);
  EXPECT_NEAR(middle[1], Albedo * Decode(188.0 / 255.0), 2e-3);
  EXPECT_NEAR(middle[2], 0.0, 1e-6);

  texture = MakeTexture(255, 188, 0);
  texture->UseSRGBColorSpaceOn();
  this->Actor->SetTexture(texture);
  middle = this->RenderMiddle();
  EXPECT_NEAR(middle[0], Albedo, 2e-3);
  EXPECT_NEAR(middle[1], Albedo * 0.5029, 4e-3); // sRGB's 188
  EXPECT_NEAR(middle[2], 0.0, 1e-6);
}

// Textures of VTK's PBR that cannot color a measured material say so once.
TEST_F(Scene, TexturesWithoutEffectSaySo)
{
  this->Actor->GetProperty()->SetInterpolationToPBR();
  vtkSmartPointer<vtkTexture> base = MakeTexture(10, 20, 30);
  base->UseSRGBColorSpaceOn();
  this->Actor->GetProperty()->SetBaseColorTexture(base);
  this->Actor->GetProperty()->SetORMTexture(MakeTexture(1, 2, 3));
  EventCounter warnings(this->Measured, vtkCommand::WarningEvent);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->Actor->GetProperty()->SetRoughness(0.1 * frame); // a new shader each time
    EXPECT_NEAR(this->RenderMiddle()[2], Albedo, 2e-3);
  }
  EXPECT_EQ(warnings.Count, 2) << warnings.Text;
}

// Tangents are directions of the surface: a shear turns them, not as normals turn.
TEST_F(Scene, TangentsFollowTheActor)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(400.0, 2.0);
  brushed->SetSpecularScale(1.0, 1.0, 1.0);
  this->Measured->SetBRDF(brushed);
  this->Measured->SetEnvironment(nullptr);
  this->AddSceneLight(2.0, 1.0, 5.0);

  // Stretched by 3 along x, a diagonal tangent lies along (3, 1).
  this->AddTangents(1.0, 1.0, 0.0);
  vtkNew<vtkTransform> stretch;
  stretch->Scale(3.0, 1.0, 1.0);
  this->Actor->SetUserTransform(stretch);
  const std::array<float, 3> stretched = this->RenderMiddle();

  this->Actor->SetUserTransform(nullptr);
  this->AddTangents(3.0, 1.0, 0.0);
  const std::array<float, 3> expected = this->RenderMiddle();
  this->AddTangents(1.0, 3.0, 0.0); // where a normal would point
  const std::array<float, 3> wrong = this->RenderMiddle();
  ASSERT_GT(std::abs(expected[0] - wrong[0]), 0.05f * expected[0]);
  EXPECT_NEAR(stretched[0], expected[0], 1e-3f * expected[0]);
}

// More textures than a graphics card binds at once: one error, and VTK's own shading.
TEST_F(Scene, TooManyTextures)
{
  vtkNew<vtkSumBRDF> sum;
  const int dimensions[3] = { 2, 2, 2 };
  for (int k = 0; k < 33; ++k)
  {
    vtkNew<vtkTabulatedBRDF> table;
    table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions,
      std::vector<float>(24, 0.001f));
    sum->AddTerm(table);
  }
  this->AddHeadlight();
  this->Measured->SetEnvironment(nullptr);
  this->Measured->SetBRDF(sum);
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  for (int frame = 0; frame < 3; ++frame)
  {
    EXPECT_GT(this->RenderMiddle()[0], 0.5f); // the property's white
  }
  EXPECT_EQ(errors.Count, 1) << errors.Text;
  EXPECT_NE(errors.Text.find("texture units"), std::string::npos) << errors.Text;
}

// What draws only what changed asks props when they did; buffers and shaders are another matter.
TEST_F(Scene, RedrawTimeFollowsAppearance)
{
  this->RenderEncoded();
  const auto changes = [this](const char* what, const auto& change)
  {
    const vtkMTimeType before = this->Actor->GetRedrawMTime();
    EXPECT_EQ(this->Actor->GetRedrawMTime(), before) << what;
    change();
    EXPECT_GT(this->Actor->GetRedrawMTime(), before) << what;
  };
  changes("material", [this]() { this->Lambert->SetAlbedo(0.2, 0.2, 0.2); });
  changes("environment", [this]() { this->White->SetRotationY(20.0); });
  changes("tolerance", [this]() { this->Measured->SetErrorTolerance(0.1); });
  changes("another material",
    [this]()
    {
      vtkNew<vtkLambertBRDF> other;
      this->Measured->SetBRDF(other);
    });
  changes("no environment", [this]() { this->Measured->SetEnvironment(nullptr); });
}

// A failure is said and tried once, not in every frame; what changed is tried anew.
TEST_F(Scene, TexturesThatLightNothing)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(8, 4, 1);
  image->AllocateScalars(VTK_FLOAT, 2);
  std::fill_n(static_cast<float*>(image->GetScalarPointer()), 64, 1.0f);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  this->Measured->SetEnvironment(nullptr);
  this->Renderer->SetEnvironmentTexture(texture);
  EventCounter warnings(this->Measured, vtkCommand::WarningEvent);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->RenderEncoded();
  }
  EXPECT_EQ(warnings.Count, 1) << warnings.Text;
  EXPECT_NE(warnings.Text.find("2 components"), std::string::npos) << warnings.Text;
}

// Mappers that hold the same material and environment draw with the same textures.
TEST_F(Scene, LightsAreUploadedOnce)
{
  this->Measured->SetIntegrator(vtkNew<vtkLightSetRadianceIntegrator>());
  const auto countTextures = [this]()
  {
    // OpenGL hands out names one after the other.
    vtkNew<vtkTextureObject> probe;
    probe->SetContext(vtkOpenGLRenderWindow::SafeDownCast(this->Window));
    probe->Create2D(1, 1, 4, VTK_FLOAT, false);
    return probe->GetHandle();
  };
  this->RenderEncoded();
  const unsigned int before = countTextures();
  std::vector<vtkSmartPointer<vtkActor>> actors;
  for (int k = 0; k < 20; ++k)
  {
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    mapper->ShallowCopy(this->Measured);
    actors.push_back(vtkSmartPointer<vtkActor>::New());
    actors.back()->SetMapper(mapper);
    this->Renderer->AddActor(actors.back());
  }
  this->RenderEncoded();
  EXPECT_LE(countTextures(), before + 3);
}

// A user's own lines after the lighting may read what VTK's lighting would have left there.
TEST_F(Scene, ReplacementsReadWhatStockShadersHave)
{
  this->AddHeadlight();
  this->Actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", false,
    "//VTK::Light::Impl\n"
    "  gl_FragData[0] = vec4(0.5 * (diffuse + specular), opacity);\n",
    false);
  const double encoded = std::pow(Albedo + Albedo / 3.14159265, 1.0 / 2.2);
  EXPECT_NEAR(this->RenderEncoded().At(32, 32)[0], 0.5 * encoded, 2e-3);
}

//------------------------------------------------------------------------------
// Composite data: the same pixels as with a plain mapper for each block, whatever the tree.
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
  EventCounter warnings(plain, vtkCommand::WarningEvent);
  this->RenderEncoded();
  this->RenderEncoded();
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_NE(warnings.Text.find("vtkCompositeMeasuredBRDFMapper"), std::string::npos);
}
