// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What stands in for the first plan in the background: what is asked of a material for it, when,
// and how often.

#include "EventCounter.h"
#include "RenderFixture.h"

#include "../Unit/Support/GatedBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkObjectFactory.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

namespace
{
// What a material and its snapshots were asked for, on the thread that draws or apart.
struct Asked
{
  struct Side
  {
    std::atomic<int> Prepared{ 0 };
    std::atomic<int> Forms{ 0 };
    bool Fails = false; // Prepare
  };
  Side Here, Apart;
  std::thread::id Drawing = std::this_thread::get_id();
  Gate Door; // of the other threads' Prepare
  Side& Get() { return std::this_thread::get_id() == this->Drawing ? this->Here : this->Apart; }
};

// A program's own class, which says what shaders evaluate and nothing of a quick form.
class AskedBRDF : public vtkBlinnPhongBRDF
{
public:
  static AskedBRDF* New();
  vtkTypeMacro(AskedBRDF, vtkBlinnPhongBRDF);
  void Prepare() override
  {
    Asked::Side& side = this->Record->Get();
    ++side.Prepared;
    if (&side == &this->Record->Apart)
    {
      this->Record->Door.Pass();
    }
    if (side.Fails)
    {
      throw std::runtime_error("its own trouble");
    }
  }
  vtkBRDF* GetRenderable() override
  {
    ++this->Record->Get().Forms;
    return this;
  }
  std::shared_ptr<Asked> Record = std::make_shared<Asked>();

protected:
  vtkBRDF* NewCopy() override
  {
    AskedBRDF* copy = AskedBRDF::New();
    copy->Record = this->Record;
    copy->SetExponent(this->GetExponent());
    copy->SetSpecular(this->GetSpecular());
    return copy;
  }
};
vtkStandardNewMacro(AskedBRDF);

class StandIns : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->Sky->SetPixels(2, 1, { 1.0f, 0.2f, 0.1f, 0.3f, 1.0f, 0.2f }); // no lamp
    this->BRDF->SetExponent(5.0);
    this->BRDF->SetSpecular(0.4, 0.3, 0.2);
    this->Measured->SetInputConnection(this->Sphere->GetOutputPort());
    this->Measured->SetBRDF(this->BRDF);
    this->Measured->SetEnvironment(this->Sky);
    this->Measured->SetErrorTolerance(0.05);
    this->Measured->SetPlanningModeToBackgroundFromStart();
    this->Actor->SetMapper(this->Measured);
    this->Renderer->AddActor(this->Actor);
  }
  void TearDown() override { this->Record().Door.OpenUp(); }

  Asked& Record() { return *this->BRDF->Record; }

  void WaitUntilReady()
  {
    this->Record().Door.OpenUp();
    ASSERT_TRUE(WaitUntil([this]() { return this->Measured->GetPlanReady(); }));
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkEnvironment> Sky;
  vtkNew<AskedBRDF> BRDF;
  vtkNew<vtkMeasuredBRDFMapper> Measured;
  vtkNew<vtkActor> Actor;
};
}

TEST_F(StandIns, NoFormWhereNoLightNeedsIt)
{
  this->Record().Door.Close();
  this->RenderEncoded();
  this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  EXPECT_EQ(this->Record().Here.Forms, 0);
  this->WaitUntilReady();
  this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_EQ(this->Record().Here.Forms, 0);
  EXPECT_EQ(this->Record().Apart.Forms, 0);
}

// The stand-in takes its form from a light's first frame on; whoever plans makes the plan's.
TEST_F(StandIns, LightsThatComeWhileAPlanIsMade)
{
  this->Record().Door.Close();
  const FloatImage dark = this->RenderEncoded();
  EXPECT_EQ(this->Record().Here.Forms, 0);
  this->AddHeadlight();
  const FloatImage lit = this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  EXPECT_NE(lit.RGBA, dark.RGBA);
  EXPECT_GT(this->Record().Here.Forms, 0);
  EXPECT_EQ(this->Record().Apart.Forms, 0);
  this->WaitUntilReady();
  EXPECT_GT(this->Record().Apart.Forms, 0);
  this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
}

// It says why, once, and is drawn by what stood in, which is not made again in every frame.
TEST_F(StandIns, PlansThatFail)
{
  this->AddHeadlight();
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  this->Record().Apart.Fails = true;
  this->Record().Door.Close();
  const FloatImage coarse = this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  EXPECT_EQ(errors.Count, 0);
  this->WaitUntilReady();
  const FloatImage failed = this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(errors.Text.find("its own trouble"), std::string::npos) << errors.Text;
  EXPECT_EQ(this->Measured->GetPlan(), "");
  EXPECT_TRUE(this->Measured->GetCurrentIntegrator());
  EXPECT_LT(GetLargestDifference(failed, coarse), 0.02);
  const int here = this->Record().Here.Prepared;
  const int apart = this->Record().Apart.Prepared;
  EXPECT_EQ(this->RenderEncoded().RGBA, failed.RGBA);
  EXPECT_EQ(this->Record().Here.Prepared, here);
  EXPECT_EQ(this->Record().Apart.Prepared, apart);
  EXPECT_EQ(errors.Count, 1);

  this->Record().Apart.Fails = false; // and the material changes
  this->BRDF->SetExponent(6.0);
  this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  this->WaitUntilReady();
  this->RenderEncoded();
  EXPECT_NE(this->Measured->GetPlan(), "");
  EXPECT_EQ(errors.Count, 1);
}

// What cannot stand in is tried once, not in every frame of a plan's time.
TEST_F(StandIns, ThoseThatFailAreTriedOnce)
{
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  this->Record().Here.Fails = true;
  this->Record().Door.Close();
  this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  const int first = this->Record().Here.Prepared;
  EXPECT_LE(first, 2); // by what tells whether it is mirror-like, and by its table
  for (int frame = 0; frame < 3; ++frame)
  {
    this->RenderEncoded();
  }
  EXPECT_EQ(this->Record().Here.Prepared, first);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(errors.Text.find("its own trouble"), std::string::npos) << errors.Text;
  this->Record().Here.Fails = false;
  this->WaitUntilReady();
  this->RenderEncoded();
  EXPECT_NE(this->Measured->GetPlan(), "");
  EXPECT_EQ(errors.Count, 1);
}
