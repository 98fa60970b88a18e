// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Plans made on a thread: what is drawn by meanwhile, what a change does to them, how they end.

#include "GatedBRDF.h"
#include "MapperPlans.h"
#include "SpherePairs.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using measuredbrdf::CurrentPlan;
using measuredbrdf::PlanInputs;
using measuredbrdf::PlanJob;
using Timing = measuredbrdf::CurrentPlan::Timing;

namespace
{
class Background : public testing::Test
{
protected:
  void SetUp() override
  {
    this->BRDF->SetSpecular(0.4, 0.3, 0.2);
    this->BRDF->SetExponent(5.0);
    this->Sky = NewSmallEnvironment(false);
    ShrinkEnvironment(this->Sky, 64, 32);
  }
  void TearDown() override { this->BRDF->Door->OpenUp(); }

  bool Update(CurrentPlan& plan, Timing timing = Timing::Changes)
  {
    return plan.Update(PlanInputs(this->BRDF, this->Sky, this->Tolerance), timing, this->Problem);
  }

  // A first plan, then something else to plan for behind a closed gate.
  void BeginAnother(CurrentPlan& plan)
  {
    ASSERT_TRUE(this->Update(plan));
    this->BRDF->Door->Close();
    this->BRDF->SetExponent(9.0);
    ASSERT_FALSE(this->Update(plan));
    ASSERT_TRUE(WaitUntil([this]() { return this->BRDF->Door->IsAwaited(); }));
  }

  void PlanAnew()
  {
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(this->BRDF);
    planner->SetEnvironment(this->Sky);
    planner->SetErrorTolerance(this->Tolerance);
    EXPECT_TRUE(planner->Update());
  }

  static double GetExponent(vtkRadiancePlanner* planner)
  {
    return vtkBlinnPhongBRDF::SafeDownCast(planner->GetBRDF())->GetExponent();
  }

  vtkNew<GatedBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Sky;
  double Tolerance = 0.05;
  std::string Problem;
};
}

TEST_F(Background, AChangeStopsWhatIsInTheMaking)
{
  this->BRDF->SetExponent(9.0);
  this->BRDF->Door->TakePasses();
  this->PlanAnew();
  const long whole = this->BRDF->Door->TakePasses();
  this->BRDF->SetExponent(5.0);

  CurrentPlan plan;
  this->BeginAnother(plan);
  const std::shared_ptr<Gate> firstDoor = this->BRDF->Door;
  firstDoor->TakePasses();
  this->BRDF->Door = std::make_shared<Gate>(); // of the next job
  this->BRDF->SetExponent(13.0);
  EXPECT_FALSE(this->Update(plan));
  EXPECT_TRUE(plan.IsPending());
  firstDoor->OpenUp();
  ASSERT_TRUE(WaitUntil([&]() { return plan.IsReady(); }));
  EXPECT_TRUE(this->Update(plan));
  EXPECT_EQ(GetExponent(plan.GetPlan()), 13.0);
  PlanJob::WaitForStopped();
  EXPECT_LT(firstDoor->TakePasses(), whole / 2);
}

TEST_F(Background, BackAndForth)
{
  CurrentPlan plan;
  ASSERT_TRUE(this->Update(plan));
  vtkRadiancePlanner* first = plan.GetPlan();
  this->BRDF->Door->Close();
  this->Tolerance = 0.04;
  EXPECT_FALSE(this->Update(plan));
  EXPECT_TRUE(plan.IsPending());
  this->Tolerance = 0.05; // the one that is there
  EXPECT_FALSE(this->Update(plan));
  EXPECT_FALSE(plan.IsPending());
  EXPECT_EQ(plan.GetPlan(), first);
  this->Tolerance = 0.04; // whose first job is about to stop
  EXPECT_FALSE(this->Update(plan));
  EXPECT_TRUE(plan.IsPending());
  this->BRDF->Door->OpenUp();
  ASSERT_TRUE(WaitUntil([&]() { return plan.IsReady(); }));
  EXPECT_TRUE(this->Update(plan));
  ASSERT_TRUE(plan.GetPlan());
  EXPECT_EQ(plan.GetPlan()->GetErrorTolerance(), 0.04);
}

TEST_F(Background, EverythingThatCountsBeginsAnother)
{
  const auto expectAnother = [&](const char* what, const std::function<void()>& change)
  {
    CurrentPlan plan;
    ASSERT_TRUE(this->Update(plan)) << what;
    EXPECT_FALSE(this->Update(plan)) << what;
    EXPECT_FALSE(plan.IsPending()) << what;
    change();
    EXPECT_FALSE(this->Update(plan)) << what;
    EXPECT_TRUE(plan.IsPending()) << what;
  };
  expectAnother("the tolerance", [this]() { this->Tolerance = 0.3; });
  expectAnother("a parameter", [this]() { this->BRDF->SetExponent(6.0); });
  expectAnother(
    "pixels", [this]() { this->Sky->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, 0.5f)); });
  expectAnother("another environment",
    [this]()
    {
      this->Sky = NewSmallEnvironment(true);
      ShrinkEnvironment(this->Sky, 32, 16);
    });
}

// A plan of the objects themselves bridges nothing that happens to them.
TEST_F(Background, ChangedPixelsAreNotBridgedByAPlanOfThem)
{
  this->Tolerance = 0.3;
  CurrentPlan plan;
  EXPECT_TRUE(this->Update(plan, Timing::Foreground));
  EXPECT_EQ(plan.GetPlan()->GetEnvironment(), this->Sky.Get());
  this->Sky->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, 0.5f));
  EXPECT_TRUE(this->Update(plan));
  EXPECT_FALSE(plan.IsPending());
  EXPECT_NE(plan.GetPlan()->GetEnvironment(), this->Sky.Get());
  EXPECT_EQ(plan.GetPlan()->GetEnvironment()->GetPixels(), this->Sky->GetPixels());
}

TEST_F(Background, ItsEndLeavesNothing)
{
  EXPECT_EQ(GatedBRDF::GetNumberOfObjects(), 1);
  {
    CurrentPlan plan;
    this->BeginAnother(plan);
    EXPECT_GT(GatedBRDF::GetNumberOfObjects(), 1);
    std::thread(
      [door = this->BRDF->Door]() { // while its end is waited for, mostly
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        door->OpenUp();
      })
      .detach();
  }
  PlanJob::WaitForStopped();
  EXPECT_FALSE(this->BRDF->Door->IsAwaited());
  EXPECT_EQ(GatedBRDF::GetNumberOfObjects(), 1);
  EXPECT_EQ(this->BRDF->GetReferenceCount(), 1);
  EXPECT_EQ(this->Sky->GetReferenceCount(), 1);
}

TEST_F(Background, TheForegroundWaitsForIt)
{
  CurrentPlan plan;
  this->BeginAnother(plan);
  this->BRDF->Door->OpenUp();
  EXPECT_TRUE(this->Update(plan, Timing::Foreground));
  EXPECT_FALSE(plan.IsPending());
  EXPECT_EQ(GetExponent(plan.GetPlan()), 9.0);
  // In the foreground nothing is bridged, and nothing copied.
  this->BRDF->SetExponent(10.0);
  EXPECT_TRUE(this->Update(plan, Timing::Foreground));
  EXPECT_EQ(plan.GetPlan()->GetBRDF(), this->BRDF.Get());
  // Back in the background, it is not made anew as long as it is of what is set...
  EXPECT_FALSE(this->Update(plan));
  EXPECT_FALSE(plan.IsPending());
  EXPECT_EQ(plan.GetPlan()->GetBRDF(), this->BRDF.Get());
  // ... and bridges nothing that happens to it.
  this->BRDF->SetExponent(11.0);
  EXPECT_TRUE(this->Update(plan));
  EXPECT_EQ(GetExponent(plan.GetPlan()), 11.0);
  EXPECT_NE(plan.GetPlan()->GetBRDF(), this->BRDF.Get());
}

TEST_F(Background, SharedBetweenMappers)
{
  auto first = std::make_unique<CurrentPlan>();
  CurrentPlan two;
  ASSERT_TRUE(this->Update(*first));
  EXPECT_TRUE(this->Update(two));
  EXPECT_EQ(first->GetPlan(), two.GetPlan());
  this->BRDF->Door->Close();
  this->BRDF->SetExponent(9.0);
  EXPECT_FALSE(this->Update(*first));
  EXPECT_FALSE(this->Update(two));
  // One leaves, the other still waits for it.
  first.reset();
  this->BRDF->Door->OpenUp();
  ASSERT_TRUE(WaitUntil([&]() { return two.IsReady(); }));
  EXPECT_TRUE(this->Update(two));
  ASSERT_TRUE(two.GetPlan());
  this->BRDF->Door->TakePasses();
  CurrentPlan third;
  EXPECT_TRUE(this->Update(third));
  EXPECT_EQ(third.GetPlan(), two.GetPlan());
  EXPECT_EQ(this->BRDF->Door->TakePasses(), 0);
}

namespace
{
/// Has no snapshots of its own class.
class Plain : public vtkBlinnPhongBRDF
{
public:
  static Plain* New();
  vtkTypeMacro(Plain, vtkBlinnPhongBRDF);
};
vtkStandardNewMacro(Plain);

/// Isotropic while candidates are listed, when the planner and three methods ask: tables are
/// planned, and then refused.
class Fickle : public vtkBlinnPhongBRDF
{
public:
  static Fickle* New();
  vtkTypeMacro(Fickle, vtkBlinnPhongBRDF);
  bool IsIsotropic() override { return this->Asked++ < 4; }
  std::atomic<int> Asked{ 0 };

protected:
  vtkBRDF* NewCopy() override { return Fickle::New(); }
};
vtkStandardNewMacro(Fickle);
}

TEST_F(Background, WithoutSnapshotsItIsTheForeground)
{
  vtkNew<Plain> plain;
  CurrentPlan plan;
  for (const double exponent : { 3.0, 4.0 })
  {
    plain->SetExponent(exponent);
    const PlanInputs inputs(plain, this->Sky, 0.05);
    EXPECT_TRUE(plan.Update(inputs, Timing::Always, this->Problem));
    EXPECT_FALSE(plan.IsPending());
    EXPECT_EQ(plan.GetPlan()->GetBRDF(), plain.Get());
    EXPECT_FALSE(plan.Update(inputs, Timing::Changes, this->Problem)); // once is enough
  }
}

TEST_F(Background, FailuresAreToldAndNotRepeated)
{
  CurrentPlan plan;
  ASSERT_TRUE(this->Update(plan));
  vtkNew<Fickle> fickle;
  const PlanInputs inputs(fickle, this->Sky, 0.05);
  EXPECT_FALSE(plan.Update(inputs, Timing::Changes, this->Problem));
  ASSERT_TRUE(WaitUntil([&]() { return plan.IsReady(); }));
  EXPECT_EQ(this->Problem, "");
  EXPECT_TRUE(plan.Update(inputs, Timing::Changes, this->Problem));
  EXPECT_NE(this->Problem.find("isotropic"), std::string::npos) << this->Problem;
  EXPECT_EQ(plan.GetPlan(), nullptr);
  this->Problem.clear();
  EXPECT_FALSE(plan.Update(inputs, Timing::Changes, this->Problem));
  EXPECT_FALSE(plan.IsPending());
  EXPECT_EQ(this->Problem, "");
}
