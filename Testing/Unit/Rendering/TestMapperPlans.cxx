// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The plans of a mapper in many views: what counts for each, what is shared, made side by side, or
// given up. Nothing is drawn.

#include "GatedBRDF.h"
#include "MapperPlans.h"
#include "PlanJob.h"
#include "SharedObjects.h"
#include "SpherePairs.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using measuredbrdf::CurrentPlan;
using measuredbrdf::MapperPlans;
using measuredbrdf::PlanInputs;
using measuredbrdf::PlanJob;
using measuredbrdf::PlanRequest;
using Timing = measuredbrdf::CurrentPlan::Timing;

namespace
{
class Views : public testing::Test
{
protected:
  void SetUp() override
  {
    this->BRDF->SetExponent(5.0);
    this->Sky = NewSmallEnvironment(false);
    ShrinkEnvironment(this->Sky, 32, 16);
  }
  void TearDown() override { this->BRDF->Door->OpenUp(); }

  PlanRequest GetRequest(vtkRenderer* renderer, vtkEnvironment* light)
  {
    PlanRequest request;
    request.Inputs = PlanInputs(this->BRDF, light, 0.3);
    request.Timing = this->When;
    request.Renderer = renderer;
    return request;
  }

  /// Whether the view is drawn by another plan than before.
  bool Update(const PlanRequest& request)
  {
    bool changed = false;
    this->Problem.clear();
    this->Drawn = this->Plans.Update(request, changed, this->Problem)->GetPlan();
    return changed;
  }
  bool Update() { return this->Update(this->GetRequest(this->One, this->Sky)); }

  vtkNew<GatedBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Sky;
  vtkNew<vtkRenderer> One;
  vtkNew<vtkRenderer> Two;
  Timing When = Timing::Foreground;
  MapperPlans Plans;
  vtkRadiancePlanner* Drawn = nullptr;
  std::string Problem;
};
}

//------------------------------------------------------------------------------
TEST_F(Views, EachViewportKeepsItsOwnLight)
{
  const auto other = NewSmallEnvironment(true);
  ShrinkEnvironment(other, 32, 16);
  for (const Timing when : { Timing::Foreground, Timing::Changes })
  {
    this->When = when;
    this->Plans.Clear();
    EXPECT_TRUE(this->Update(this->GetRequest(this->One, this->Sky)));
    const vtkRadiancePlanner* first = this->Drawn;
    // Another viewport's old plan is no stand-in for the first of this one.
    EXPECT_TRUE(this->Update(this->GetRequest(this->Two, other)));
    ASSERT_TRUE(this->Drawn);
    EXPECT_EQ(this->Drawn->GetEnvironment()->GetPixels(), other->GetPixels());
    const vtkRadiancePlanner* second = this->Drawn;
    this->BRDF->Door->TakePasses();
    for (int frame = 0; frame < 3; ++frame)
    {
      EXPECT_FALSE(this->Update(this->GetRequest(this->One, this->Sky)));
      EXPECT_EQ(this->Drawn, first);
      EXPECT_FALSE(this->Update(this->GetRequest(this->Two, other)));
      EXPECT_EQ(this->Drawn, second);
    }
    EXPECT_EQ(this->BRDF->Door->TakePasses(), 0);
  }

  // Old plans stand in for new ones in their own views only.
  this->BRDF->Door->Close();
  this->BRDF->SetExponent(7.0);
  EXPECT_FALSE(this->Update(this->GetRequest(this->One, this->Sky)));
  EXPECT_EQ(this->Drawn->GetEnvironment()->GetPixels(), this->Sky->GetPixels());
  EXPECT_FALSE(this->Update(this->GetRequest(this->Two, other)));
  EXPECT_EQ(this->Drawn->GetEnvironment()->GetPixels(), other->GetPixels());
  EXPECT_TRUE(this->Plans.IsPending());
  this->BRDF->Door->OpenUp();
  ASSERT_TRUE(WaitUntil([this]() { return this->Plans.IsReady(); }));
}

//------------------------------------------------------------------------------
TEST_F(Views, EqualViewportsShareOnePlan)
{
  EXPECT_TRUE(this->Update(this->GetRequest(this->One, this->Sky)));
  const vtkRadiancePlanner* first = this->Drawn;
  this->BRDF->Door->TakePasses();
  EXPECT_TRUE(this->Update(this->GetRequest(this->Two, this->Sky)));
  EXPECT_EQ(this->Drawn, first);
  EXPECT_EQ(this->BRDF->Door->TakePasses(), 0);
  // Of two members, each keeps its own.
  PlanRequest other = this->GetRequest(this->One, this->Sky);
  other.Member = this->BRDF;
  other.Inputs.Tolerance = 0.25;
  EXPECT_TRUE(this->Update(other));
  EXPECT_NE(this->Drawn, first);
  EXPECT_FALSE(this->Update(this->GetRequest(this->One, this->Sky)));
  EXPECT_FALSE(this->Update(other));
}

//------------------------------------------------------------------------------
TEST_F(Views, GoWithTheirRenderers)
{
  vtkWeakPointer<vtkRadiancePlanner> plan;
  const auto other = NewSmallEnvironment(true);
  ShrinkEnvironment(other, 32, 16);
  this->Update();
  {
    vtkNew<vtkRenderer> renderer;
    this->Update(this->GetRequest(renderer, other));
    plan = this->Drawn;
    EXPECT_EQ(this->Plans.GetNumberOfViews(), 2);
  }
  this->Update();
  this->Update();
  EXPECT_EQ(this->Plans.GetNumberOfViews(), 1);
  EXPECT_EQ(plan, nullptr);
  this->Plans.Clear(this->Two);
  EXPECT_EQ(this->Plans.GetNumberOfViews(), 1);
  this->Plans.Clear(this->One);
  EXPECT_EQ(this->Plans.GetNumberOfViews(), 0);
}

//------------------------------------------------------------------------------
TEST_F(Views, AnObserverMayClearAllMeanwhile)
{
  PlanRequest request = this->GetRequest(this->One, this->Sky);
  int asked = 0;
  request.Progress = [&](double)
  {
    this->Plans.Clear();
    return ++asked > 0;
  };
  bool changed = false;
  const auto current = this->Plans.Update(request, changed, this->Problem);
  EXPECT_GT(asked, 0);
  EXPECT_EQ(this->Plans.GetNumberOfViews(), 0);
  EXPECT_TRUE(changed);
  ASSERT_TRUE(current->GetPlan());
  EXPECT_EQ(current->GetEnvironment(), this->Sky);
}

//------------------------------------------------------------------------------
// Whoever waits for a plan on another thread can stop waiting.
TEST_F(Views, WaitingCanBeStopped)
{
  this->BRDF->Door->Close();
  CurrentPlan plan;
  const PlanInputs inputs(this->BRDF, this->Sky, 0.3);
  plan.Begin(inputs);
  ASSERT_TRUE(WaitUntil([this]() { return this->BRDF->Door->IsAwaited(); }));
  std::thread opener( // a call that does not ask would else never return
    [door = this->BRDF->Door]()
    {
      std::this_thread::sleep_for(std::chrono::seconds(3));
      door->OpenUp();
    });
  int asked = 0;
  EXPECT_TRUE(plan.Update(
    inputs, Timing::Foreground, this->Problem, [&asked](double) { return ++asked < 3; }));
  EXPECT_TRUE(this->BRDF->Door->IsAwaited());
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(this->Problem, "aborted");
  EXPECT_EQ(plan.GetPlan(), nullptr);
  opener.join();
}

namespace
{
/// Several mappers' wishes for one frame, as the mapper collects them.
class SideBySide : public Views
{
protected:
  static constexpr int Count = 5;

  void SetUp() override
  {
    Views::SetUp();
    for (int k = 0; k < Count; ++k)
    {
      this->Materials.push_back(vtkSmartPointer<GatedBRDF>::New());
      this->Materials.back()->SetExponent(3.0 + 4.0 * k);
      this->Mappers.push_back(std::make_unique<MapperPlans>());
    }
  }
  void TearDown() override
  {
    for (const auto& material : this->Materials)
    {
      material->Door->OpenUp();
    }
    Views::TearDown();
  }

  PlanRequest GetRequestOf(int k)
  {
    PlanRequest request = this->GetRequest(this->One, this->Sky);
    request.Inputs = PlanInputs(this->Materials[static_cast<std::size_t>(k)], this->Sky, 0.3);
    return request;
  }

  vtkRadiancePlanner* Update(int k)
  {
    bool changed = false;
    return this->Mappers[static_cast<std::size_t>(k)]
      ->Update(this->GetRequestOf(k), changed, this->Problem)
      ->GetPlan();
  }

  std::vector<vtkSmartPointer<GatedBRDF>> Materials;
  std::vector<std::unique_ptr<MapperPlans>> Mappers;
};
}

//------------------------------------------------------------------------------
TEST_F(SideBySide, NoMoreThanCores)
{
  this->When = Timing::Always;
  for (const auto& material : this->Materials)
  {
    material->Door->Close();
  }
  for (int k = 0; k < Count; ++k)
  {
    EXPECT_EQ(this->Update(k), nullptr);
    EXPECT_TRUE(this->Mappers[static_cast<std::size_t>(k)]->IsPending());
  }
  // One core is left to drawing.
  const int limit = std::max(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1);
  const auto countWaiting = [this]()
  {
    int count = 0;
    for (const auto& material : this->Materials)
    {
      count += material->Door->IsAwaited() ? 1 : 0;
    }
    return count;
  };
  ASSERT_TRUE(WaitUntil([&]() { return countWaiting() == std::min(limit, Count); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(countWaiting(), std::min(limit, Count));
  // What has not begun is dropped at once, without waiting for those that run.
  for (int k = limit; k < Count; ++k)
  {
    this->Mappers[static_cast<std::size_t>(k)].reset();
  }
  for (const auto& material : this->Materials)
  {
    material->Door->OpenUp();
  }
  ASSERT_TRUE(WaitUntil([this]() { return this->Mappers[0]->IsReady(); }));
  EXPECT_TRUE(this->Update(0));
}

//------------------------------------------------------------------------------
// Several that would be waited for, of one mapper.
TEST_F(SideBySide, AllBeginBeforeTheFirstIsWaitedFor)
{
  std::vector<PlanRequest> requests;
  for (int k = 0; k < 2; ++k)
  {
    this->Materials[k]->Door->Close();
    requests.push_back(this->GetRequestOf(k));
    requests.back().Member = this->Materials[k];
  }
  MapperPlans& plans = *this->Mappers[0];
  plans.BeginAll({ requests[0] });
  EXPECT_FALSE(plans.IsPending());
  std::thread opener(
    [this]()
    {
      EXPECT_TRUE(WaitUntil([this]() { return this->Materials[1]->Door->IsAwaited(); }));
      this->Materials[0]->Door->OpenUp();
      this->Materials[1]->Door->OpenUp();
    });
  plans.BeginAll(requests);
  for (const PlanRequest& request : requests)
  {
    bool changed = false;
    EXPECT_TRUE(plans.Update(request, changed, this->Problem)->GetPlan());
  }
  opener.join();
}

//------------------------------------------------------------------------------
TEST_F(SideBySide, HeldUntilSomebodyWaits)
{
  this->When = Timing::Always;
  auto hold = std::make_unique<PlanJob::Hold>();
  EXPECT_EQ(this->Update(0), nullptr);
  EXPECT_EQ(this->Update(1), nullptr);
  this->Materials[1]->Door->TakePasses();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(this->Materials[1]->Door->TakePasses(), 0);
  EXPECT_FALSE(this->Mappers[0]->IsReady());
  this->When = Timing::Foreground;
  EXPECT_TRUE(this->Update(0));
  hold.reset();
  EXPECT_TRUE(WaitUntil([this]() { return this->Mappers[1]->IsReady(); }));
}

//------------------------------------------------------------------------------
// What the rendering component shares may be looked up by threads that draw different windows.
TEST(TwoThreads, ShareWhatTheyFind)
{
  measuredbrdf::SharedObjects<int, vtkObject> shared;
  std::atomic<int> made{ 0 };
  std::atomic<int> started{ 0 };
  const auto use = [&]()
  {
    ++started;
    while (started < 2)
    {
    }
    for (int k = 0; k < 20000; ++k)
    {
      const vtkSmartPointer<vtkObject> object = shared.Find(k / 4 % 16,
        [&made]()
        {
          ++made;
          return vtkSmartPointer<vtkObject>::New();
        });
      ASSERT_TRUE(object);
      ASSERT_GE(object->GetReferenceCount(), 1);
    }
  };
  std::thread one(use);
  std::thread two(use);
  one.join();
  two.join();
  EXPECT_GE(made, 16);
  // Nothing stays that nobody holds.
  const auto make = []() { return vtkSmartPointer<vtkObject>::New(); };
  const vtkSmartPointer<vtkObject> held = shared.Find(1, make);
  vtkWeakPointer<vtkObject> weak = shared.Find(2, make).Get();
  shared.Sweep();
  EXPECT_EQ(weak, nullptr);
  EXPECT_EQ(shared.Find(1, make), held);
}
