// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The plans of a mapper in many views: what counts for each, what is shared, made side by side, or
// given up. Nothing is drawn.

#include "GatedBRDF.h"
#include "MapperPlans.h"
#include "PlanJob.h"
#include "SharedObjects.h"
#include "SpherePairs.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkWeakPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
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
    this->Sphere->SetThetaResolution(30);
    this->Sphere->SetPhiResolution(30);
    this->Sphere->Update();
    for (vtkRenderer* renderer : { this->One.Get(), this->Two.Get() })
    {
      vtkCamera* camera = renderer->GetActiveCamera();
      camera->ParallelProjectionOn();
      camera->SetParallelScale(1.0);
      camera->SetPosition(0.0, 0.0, 5.0);
      camera->SetClippingRange(0.1, 20.0);
    }
  }
  void TearDown() override { this->BRDF->Door->OpenUp(); }

  PlanRequest GetRequest(vtkRenderer* renderer, vtkEnvironment* light)
  {
    PlanRequest request;
    request.BRDF = this->Material ? this->Material.Get() : this->BRDF.Get();
    request.Environment = light;
    request.Tolerance = 0.3;
    request.Timing = this->When;
    request.ForView = this->ForView;
    request.Renderer = renderer;
    request.Actor = this->Actor;
    request.Surfaces = { this->Sphere->GetOutput() };
    return request;
  }

  vtkSmartPointer<vtkBRDF> Material; // instead of BRDF, if any

  /// Whether the view is drawn by another plan than before.
  bool Update(const PlanRequest& request)
  {
    bool changed = false;
    this->Problem.clear();
    this->Drawn = this->Plans.Update(request, changed, this->Problem)->GetPlan();
    return changed;
  }
  bool Update() { return this->Update(this->GetRequest(this->One, this->Sky)); }

  /// Plans made anew in so many frames.
  template <typename Change>
  int CountPlans(int frames, Change change)
  {
    int count = 0;
    for (int frame = 0; frame < frames; ++frame)
    {
      change(frame);
      this->BRDF->Door->TakePasses();
      this->Update();
      count += this->BRDF->Door->TakePasses() > 0 ? 1 : 0;
    }
    return count;
  }

  vtkNew<GatedBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Sky;
  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> One;
  vtkNew<vtkRenderer> Two;
  Timing When = Timing::Foreground;
  bool ForView = false;
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
  other.Tolerance = 0.25;
  EXPECT_TRUE(this->Update(other));
  EXPECT_NE(this->Drawn, first);
  EXPECT_FALSE(this->Update(this->GetRequest(this->One, this->Sky)));
  EXPECT_FALSE(this->Update(other));
}

//------------------------------------------------------------------------------
TEST_F(Views, GoWithTheirRenderersAndActors)
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
  {
    vtkNew<vtkRenderer> renderer;
    this->Update(this->GetRequest(renderer, other));
    plan = this->Drawn;
    this->ForView = true;
    this->Update();
    EXPECT_EQ(plan, nullptr);
  }
  {
    vtkNew<vtkActor> actor;
    PlanRequest request = this->GetRequest(this->One, this->Sky);
    request.Actor = actor;
    this->Update(request);
    this->Update();
    EXPECT_EQ(this->Plans.GetNumberOfViews(), 2);
  }
  this->Update();
  this->Update();
  EXPECT_EQ(this->Plans.GetNumberOfViews(), 1);
  this->Plans.Clear(this->Two);
  EXPECT_EQ(this->Plans.GetNumberOfViews(), 1);
  this->Plans.Clear(this->One);
  EXPECT_EQ(this->Plans.GetNumberOfViews(), 0);
}

//------------------------------------------------------------------------------
// Everything that a plan for the view depends on makes another one, of these pairs.
TEST_F(Views, WhatIsSeenDependsOn)
{
  this->ForView = true;
  vtkNew<vtkSphereSource> patch; // bent, and looked at askew: no symmetry
  patch->SetEndTheta(80.0);
  patch->SetEndPhi(60.0);
  patch->SetThetaResolution(12);
  patch->SetPhiResolution(12);
  patch->Update();
  vtkCamera* camera = this->One->GetActiveCamera();
  camera->SetPosition(3.0, 2.0, 5.0);
  const auto update = [&](MapperPlans& plans)
  {
    PlanRequest request = this->GetRequest(this->One, this->Sky);
    request.Surfaces = { patch->GetOutput() };
    bool changed = false;
    this->Drawn = plans.Update(request, changed, this->Problem)->GetPlan();
    return changed;
  };
  const auto expectAnother = [&](const char* what, const std::function<void(bool)>& change)
  {
    MapperPlans plans;
    EXPECT_TRUE(update(plans)) << what;
    EXPECT_FALSE(update(plans)) << what;
    change(true);
    EXPECT_TRUE(update(plans)) << what;
    change(false);
  };
  expectAnother("the camera", [&](bool on) { camera->Azimuth(on ? 60.0 : -60.0); });
  expectAnother("the actor's matrix", [&](bool on) { this->Actor->RotateY(on ? 60.0 : -60.0); });
  expectAnother("the mesh",
    [&](bool on)
    {
      patch->SetStartTheta(on ? 120.0 : 0.0);
      patch->SetEndTheta(on ? 200.0 : 80.0);
      patch->Update();
    });
  expectAnother("the light's rotation", [&](bool on) { this->Sky->SetRotationY(on ? 60.0 : 0.0); });
  expectAnother("the renderer's frame",
    [&](bool on)
    {
      double right[3] = { on ? 0.0 : 1.0, 0.0, on ? 1.0 : 0.0 };
      this->One->SetEnvironmentRight(right);
    });
}

//------------------------------------------------------------------------------
// What is checked for a light that is turned is what would be for turned pixels.
TEST_F(Views, ATurnedLightIsTurnedPixels)
{
  this->ForView = true;
  vtkNew<vtkSphereSource> patch;
  patch->SetEndTheta(80.0);
  patch->Update();
  this->One->GetActiveCamera()->SetPosition(3.0, 2.0, 5.0);
  // Rotation by a quarter: the columns move by a quarter of the width.
  const auto turned = vtkSmartPointer<vtkEnvironment>::New();
  const auto plan = [&](vtkEnvironment* light)
  {
    MapperPlans plans;
    PlanRequest request = this->GetRequest(this->One, light);
    request.Surfaces = { patch->GetOutput() };
    request.Tolerance = 0.02;
    bool changed = false;
    vtkRadiancePlanner* planner = plans.Update(request, changed, this->Problem)->GetPlan();
    const int choice = planner->GetChoice();
    return std::make_pair(planner->GetMethodName(choice) + planner->GetDescription(choice),
      planner->GetPredictedError(choice) - planner->GetErrorUncertainty(choice));
  };
  const int width = this->Sky->GetWidth();
  const int height = this->Sky->GetHeight();
  std::vector<float> pixels(this->Sky->GetPixels().size());
  vtkNew<vtkEnvironment> probe; // which way a rotation goes: VTK's word for it
  probe->SetRotationY(90.0);
  double rows[9];
  probe->GetWorldToEnvironment(rows);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      double d[3];
      this->Sky->GetTexelDirection(x, y, d);
      const double in[3] = { rows[0] * d[0] + rows[1] * d[1] + rows[2] * d[2],
        rows[3] * d[0] + rows[4] * d[1] + rows[5] * d[2],
        rows[6] * d[0] + rows[7] * d[1] + rows[8] * d[2] };
      double rgb[3];
      this->Sky->GetRadiance(in, rgb);
      for (int c = 0; c < 3; ++c)
      {
        pixels[3 * static_cast<std::size_t>(y * width + x) + c] = static_cast<float>(rgb[c]);
      }
    }
  }
  turned->SetPixels(width, height, pixels);
  const auto straight = plan(this->Sky);
  this->Sky->SetRotationY(90.0);
  const auto rotated = plan(this->Sky);
  const auto pixelwise = plan(turned);
  EXPECT_EQ(rotated.first, pixelwise.first);
  // The reference's lights are cut from another corner of the map. The mean alone is compared: what
  // is added for chance has the reference's own error, which these lights show on a few pairs.
  EXPECT_NEAR(rotated.second, pixelwise.second, 8e-3 * rotated.second);
  EXPECT_GT(std::abs(straight.second - rotated.second), 1e-2 * rotated.second);
}

//------------------------------------------------------------------------------
TEST_F(Views, AnOrbitNeedsFewPlans)
{
  this->ForView = true;
  vtkCamera* camera = this->One->GetActiveCamera();
  const auto orbit = [camera](int) { camera->Azimuth(5.0); };
  const int first = this->CountPlans(72, orbit);
  EXPECT_GE(first, 2);
  EXPECT_LE(first, 5);
  EXPECT_EQ(this->CountPlans(72, orbit), 0) << "the second time around";
  EXPECT_EQ(this->CountPlans(40, [camera](int) { camera->Elevation(2.0); }), 0);
  EXPECT_EQ(this->CountPlans(36, [this](int k) { this->Sky->SetRotationY(10.0 * k); }), 0);
}

//------------------------------------------------------------------------------
// To and fro between two views and two actors.
TEST_F(Views, PlansForTheViewAreTakenUpAgain)
{
  this->ForView = true;
  vtkCamera* camera = this->One->GetActiveCamera();
  EXPECT_EQ(this->CountPlans(1, [](int) {}), 1);
  const vtkRadiancePlanner* first = this->Drawn;
  EXPECT_EQ(this->CountPlans(1, [camera](int) { camera->Azimuth(60.0); }), 1);
  const int again = this->CountPlans(6, [camera](int k) { camera->Azimuth(k % 2 ? 60.0 : -60.0); });
  EXPECT_EQ(again, 0);
  camera->Azimuth(-60.0);
  EXPECT_TRUE(this->Update());
  EXPECT_EQ(this->Drawn, first);

  vtkNew<vtkActor> other;
  other->RotateX(70.0);
  vtkNew<vtkSphereSource> patch;
  patch->SetEndTheta(60.0);
  patch->Update();
  PlanRequest request = this->GetRequest(this->One, this->Sky);
  request.Actor = other;
  request.Surfaces = { patch->GetOutput() };
  EXPECT_TRUE(this->Update(request));
  this->BRDF->Door->TakePasses();
  for (int frame = 0; frame < 3; ++frame)
  {
    EXPECT_FALSE(this->Update());
    EXPECT_FALSE(this->Update(request));
  }
  EXPECT_EQ(this->BRDF->Door->TakePasses(), 0);

  // Those of another material are not kept.
  this->BRDF->SetExponent(8.0);
  EXPECT_EQ(this->CountPlans(2, [](int) {}), 1);
  EXPECT_EQ(this->CountPlans(1, [camera](int) { camera->Azimuth(60.0); }), 1);
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
TEST_F(Views, SwitchedPlansAreMadeAnew)
{
  EXPECT_TRUE(this->Update());
  EXPECT_TRUE(this->Update(this->GetRequest(this->Two, this->Sky)));
  this->ForView = true;
  EXPECT_TRUE(this->Update());
  EXPECT_EQ(this->Plans.GetNumberOfViews(), 1);
  this->ForView = false;
  EXPECT_TRUE(this->Update());
  EXPECT_EQ(this->Plans.GetNumberOfViews(), 1);
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
    request.BRDF = this->Materials[static_cast<std::size_t>(k)];
    return request;
  }

  vtkRadiancePlanner* Update(int k)
  {
    PlanRequest request = this->GetRequestOf(k);
    request.Others = [this](const PlanRequest::Visit& visit)
    {
      ++this->Visits;
      for (int other = 0; other < Count; ++other)
      {
        visit(*this->Mappers[static_cast<std::size_t>(other)], this->GetRequestOf(other));
      }
    };
    bool changed = false;
    return this->Mappers[static_cast<std::size_t>(k)]
      ->Update(request, changed, this->Problem)
      ->GetPlan();
  }

  std::vector<vtkSmartPointer<GatedBRDF>> Materials;
  std::vector<std::unique_ptr<MapperPlans>> Mappers;
  int Visits = 0;
};
}

//------------------------------------------------------------------------------
TEST_F(SideBySide, TheFirstFrameBeginsAll)
{
  // The second waits at its gate while the first frame asks for the first only.
  this->Materials[1]->Door->Close();
  ASSERT_TRUE(this->Update(0));
  EXPECT_EQ(this->Problem, "");
  ASSERT_TRUE(WaitUntil([this]() { return this->Materials[1]->Door->IsAwaited(); }));
  this->Materials[1]->Door->OpenUp();
  for (int k = 1; k < Count; ++k)
  {
    EXPECT_FALSE(this->Mappers[static_cast<std::size_t>(k)]->IsPending()); // not drawn yet
    EXPECT_TRUE(this->Update(k));
  }
  EXPECT_EQ(this->Visits, 1);
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
  EXPECT_EQ(this->Visits, 0); // each begins its own
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
