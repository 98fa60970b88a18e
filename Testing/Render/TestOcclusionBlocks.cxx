// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Hidden skies of composite data: some blocks have vtkSurfaceVisibilityFilter's arrays, others do
// not; and many blocks.
#include "AutomaticOcclusion.h"
#include "OcclusionArrays.h"
#include "RenderFixture.h"
#include "SharedTrace.h"
#include "vtkCellArray.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTableRadianceIntegrator.h"

#include <cstdio>
#include <ctime>
#include <string>

using measuredbrdf::OcclusionCache;
using measuredbrdf::SharedTrace;

namespace
{
// A hollow that is open downwards.
vtkSmartPointer<vtkPolyData> MakeBowl(double x)
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetCenter(x, 0.0, 0.0);
  bowl->SetRadius(0.42);
  bowl->SetThetaResolution(40);
  bowl->SetPhiResolution(24);
  bowl->SetEndPhi(115.0);
  bowl->Update();
  return bowl->GetOutput();
}

// Blocks that count how often they are listed.
class CountedBlocks : public vtkMultiBlockDataSet
{
public:
  static CountedBlocks* New();
  vtkTypeMacro(CountedBlocks, vtkMultiBlockDataSet);
  vtkCompositeDataIterator* NewIterator() override
  {
    ++Listings;
    return this->Superclass::NewIterator();
  }
  static int Listings;
};

int CountedBlocks::Listings = 0;
vtkStandardNewMacro(CountedBlocks);

vtkSmartPointer<CountedBlocks> MakeTriangles(int count)
{
  auto blocks = vtkSmartPointer<CountedBlocks>::New();
  for (int k = 0; k < count; ++k)
  {
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(k % 100, k / 100, 0.0);
    points->InsertNextPoint(k % 100 + 0.9, k / 100, 0.0);
    points->InsertNextPoint(k % 100, k / 100 + 0.9, 0.0);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1, 2 });
    vtkNew<vtkPolyData> triangle;
    triangle->SetPoints(points);
    triangle->SetPolys(cells);
    blocks->SetBlock(static_cast<unsigned int>(k), triangle);
  }
  return blocks;
}

}

class OcclusionBlocks : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("sky"));
    this->Mapper->SetBRDF(this->BRDF);
    this->Mapper->SetEnvironment(this->Environment);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, -5.0); // into the hollows
  }

  /// In the middle of either bowl.
  struct Pair
  {
    float Given;
    float Bare;
  };
  Pair Show(int mode, vtkPolyData* given, vtkPolyData* bare)
  {
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, given);
    blocks->SetBlock(1, bare);
    blocks->SetBlock(3, vtkNew<vtkPolyData>()); // counts for nothing
    this->Mapper->SetInputDataObject(blocks);
    this->Mapper->SetOcclusionMode(mode);
    this->Renderer->ResetCameraClippingRange();
    const FloatImage picture = this->RenderLinear();
    // x = -0.5 lies to the right, as seen from below.
    return { picture.At(48, 32)[0], picture.At(16, 32)[0] };
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkLambertBRDF> BRDF;
  vtkNew<vtkCompositeMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

// Each block with its own arrays where it has some, here of a bowl behind a lid; the others as the
// mode says. The plan says how many have some.
TEST_F(OcclusionBlocks, SomeHaveArrays)
{
  const auto one = MakeBowl(-0.5);
  const auto other = MakeBowl(0.5);
  vtkNew<vtkSphereSource> lid;
  lid->SetCenter(-0.5, 0.0, -0.9);
  lid->SetRadius(0.6);
  lid->Update();
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputData(one);
  filter->BothSidesOn();
  filter->AddOccluder(lid->GetOutput());
  filter->Update();
  auto* given = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  const auto plan = [this]() { return this->Mapper->GetPlan(); };
  const auto has = [&plan](const std::string& text)
  { return plan().find(text) != std::string::npos; };

  const Pair off = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_OFF, given, other);
  EXPECT_FALSE(has("hidden sky")) << plan();
  const Pair traced = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ON, one, other);
  EXPECT_FALSE(has("hidden sky")) << plan();
  ASSERT_GT(off.Given, 0.05f);
  EXPECT_LT(traced.Bare, 0.8f * off.Bare);

  const Pair arrays = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ARRAYS, given, other);
  EXPECT_LT(arrays.Given, 0.8f * traced.Given); // behind the lid
  EXPECT_NEAR(arrays.Bare, off.Bare, 1e-5f);
  EXPECT_TRUE(has("; hidden sky is given for 1 of 2 blocks, left out of the others")) << plan();

  const Pair on = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ON, given, other);
  EXPECT_NEAR(on.Given, arrays.Given, 1e-5f);
  EXPECT_NEAR(on.Bare, traced.Bare, 1e-5f);
  EXPECT_TRUE(has("; hidden sky is given for 1 of 2 blocks, traced for the others")) << plan();

  const Pair automatic = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_AUTO, given, other);
  EXPECT_NEAR(automatic.Given, arrays.Given, 1e-5f);
  EXPECT_NEAR(automatic.Bare, traced.Bare, 1e-5f);
  EXPECT_TRUE(has("%), modeled; hidden sky is given for 1 of 2 blocks")) << plan();
  EXPECT_EQ(plan().find("hidden sky"), plan().rfind("hidden sky")) << plan();

  // Arrays that are of another surface by now.
  vtkNew<vtkPolyData> moved;
  moved->DeepCopy(given);
  double point[3];
  moved->GetPoint(0, point);
  moved->GetPoints()->SetPoint(0, point[0], point[1], point[2] + 1e-4);
  this->Mapper->GlobalWarningDisplayOff();
  const Pair stale = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ARRAYS, moved, other);
  this->Mapper->GlobalWarningDisplayOn();
  EXPECT_NEAR(stale.Given, off.Given, 1e-3f);
  EXPECT_TRUE(has("; hidden sky that is given does not fit 1 of the blocks and is left out"))
    << plan();
  this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ARRAYS, given, other);
  EXPECT_FALSE(has("does not fit")) << plan();

  vtkNew<vtkTableRadianceIntegrator> table; // nothing is predicted for it
  this->Mapper->SetIntegrator(table);
  const Pair bySet = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_AUTO, given, other);
  EXPECT_LT(bySet.Given, 0.9f * traced.Given);
  EXPECT_GT(bySet.Bare, 0.9f * off.Bare);
  EXPECT_TRUE(has("left out of the others")) << plan();
}

// A block that moves shows on the others.
TEST_F(OcclusionBlocks, OneThatMovesShowsOnTheOthers)
{
  const auto bowl = MakeBowl(-0.5);
  vtkNew<vtkSphereSource> lid;
  lid->SetRadius(0.6);
  lid->SetCenter(-0.5, 0.0, -0.9);
  lid->Update();
  vtkNew<vtkPolyData> ball;
  ball->DeepCopy(lid->GetOutput());
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, bowl);
  blocks->SetBlock(1, ball);
  OcclusionCache cache;
  std::string problem;
  const auto find = [&]()
  {
    cache.Begin();
    return cache.Find({ bowl, blocks, nullptr, true, false, false }, problem);
  };
  const auto findWhole = [&]() // for parts, under a map
  {
    cache.Begin();
    return cache.FindWhole(bowl, blocks, false);
  };
  const auto before = find();
  ASSERT_TRUE(before) << problem;
  EXPECT_EQ(find(), before);
  const auto wholeBefore = findWhole();
  EXPECT_EQ(findWhole(), wholeBefore);
  ball->GetPoints()->SetPoint(0, -0.5, 0.0, 5.0);
  ball->GetPoints()->Modified();
  const auto after = find();
  ASSERT_TRUE(after) << problem;
  EXPECT_NE(after, before);
  const auto wholeAfter = findWhole();
  EXPECT_NE(wholeAfter, wholeBefore);
  EXPECT_EQ(findWhole(), wholeAfter);
}

// Ten thousand blocks are listed as often as ten: each asks for its own, traced and forecast.
TEST_F(OcclusionBlocks, ManyAreListedOnce)
{
  int listings[2];
  for (const int count : { 10, 10000 })
  {
    const auto blocks = MakeTriangles(count);
    OcclusionCache cache;
    std::string problem;
    const double start = GetProcessorTime();
    CountedBlocks::Listings = 0;
    cache.Begin();
    int found = 0;
    for (int k = 0; k < count; ++k)
    {
      auto* block = vtkPolyData::SafeDownCast(blocks->GetBlock(static_cast<unsigned int>(k)));
      found += cache.Find({ block, blocks, nullptr, true, false, false }, problem) ? 1 : 0;
      ASSERT_LT(CountedBlocks::Listings, 50) << k;
    }
    const double made = GetProcessorTime();
    const auto traced = SharedTrace::Find(blocks)->Attach(blocks, false, []() { return true; });
    for (int k = 0; k < count; ++k)
    {
      auto* block = vtkPolyData::SafeDownCast(blocks->GetBlock(static_cast<unsigned int>(k)));
      found += cache.Find({ block, blocks, traced, false, false, false }, problem) ? 1 : 0;
      ASSERT_LT(CountedBlocks::Listings, 50) << k;
    }
    EXPECT_EQ(found, 2 * count) << problem;
    listings[count > 10 ? 1 : 0] = CountedBlocks::Listings;
    std::printf("%d blocks: %d listings, %.2f s of processor time to trace and ask, then %.2f s\n",
      count, CountedBlocks::Listings, made - start, GetProcessorTime() - made);
  }
  EXPECT_EQ(listings[0], listings[1]);
}
