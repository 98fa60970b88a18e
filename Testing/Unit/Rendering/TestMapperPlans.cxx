// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The plans of a mapper in many views: what counts for each, what is shared, made side by side, or
// given up. Nothing is drawn.
#include "GatedBRDF.h"
#include "MapperPlans.h"
#include "PlanJob.h"
#include "SharedObjects.h"
#include "SpherePairs.h"
#include "VisibleSurface.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCamera.h"
#include "vtkConeSource.h"
#include "vtkCubeSource.h"
#include "vtkEnvironment.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkStripper.h"
#include "vtkTransform.h"
#include "vtkWeakPointer.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using Timing = measuredbrdf::CurrentPlan::Timing;
using measuredbrdf::CurrentPlan;
using measuredbrdf::MapperPlans;
using measuredbrdf::PlanInputs;
using measuredbrdf::PlanJob;
using measuredbrdf::PlanRequest;
using measuredbrdf::VisibleSurface;

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
  this->When = Timing::Changes;
  EXPECT_TRUE(this->Update(this->GetRequest(this->One, this->Sky)));
  // Another viewport's old plan is no stand-in for the first of this one.
  EXPECT_TRUE(this->Update(this->GetRequest(this->Two, other)));
  ASSERT_TRUE(this->Drawn);
  EXPECT_EQ(this->Drawn->GetEnvironment()->GetPixels(), other->GetPixels());
  this->BRDF->Door->TakePasses();
  EXPECT_FALSE(this->Update(this->GetRequest(this->One, this->Sky)));
  EXPECT_FALSE(this->Update(this->GetRequest(this->Two, other)));
  EXPECT_FALSE(this->Plans.IsPending());
  EXPECT_EQ(this->BRDF->Door->TakePasses(), 0);

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

//------------------------------------------------------------------------------
// Plans made on a thread: what is drawn by meanwhile, what a change does to them, how they end.
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

/// Nothing can be planned for it.
class Troubled : public vtkBlinnPhongBRDF
{
public:
  static Troubled* New();
  vtkTypeMacro(Troubled, vtkBlinnPhongBRDF);
  void Prepare() override { throw std::runtime_error("its own trouble"); }

protected:
  vtkBRDF* NewCopy() override { return Troubled::New(); }
};
vtkStandardNewMacro(Troubled);
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
  vtkNew<Troubled> troubled;
  const PlanInputs inputs(troubled, this->Sky, 0.05);
  EXPECT_FALSE(plan.Update(inputs, Timing::Changes, this->Problem));
  ASSERT_TRUE(WaitUntil([&]() { return plan.IsReady(); }));
  EXPECT_EQ(this->Problem, "");
  EXPECT_TRUE(plan.Update(inputs, Timing::Changes, this->Problem));
  EXPECT_NE(this->Problem.find("its own trouble"), std::string::npos) << this->Problem;
  EXPECT_EQ(plan.GetPlan(), nullptr);
  this->Problem.clear();
  EXPECT_FALSE(plan.Update(inputs, Timing::Changes, this->Problem));
  EXPECT_FALSE(plan.IsPending());
  EXPECT_EQ(this->Problem, "");
}

//------------------------------------------------------------------------------
// What a camera sees of a surface, as plans for a view want it, against areas worked out by hand.
namespace
{
std::vector<glm::dvec3> Get(vtkDoubleArray* array)
{
  std::vector<glm::dvec3> directions(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t k = 0; k < directions.size(); ++k)
  {
    array->GetTuple(static_cast<vtkIdType>(k), &directions[k].x);
  }
  return directions;
}

glm::dvec3 GetMean(const std::vector<glm::dvec3>& directions)
{
  return std::accumulate(directions.begin(), directions.end(), glm::dvec3(0.0)) /
         static_cast<double>(directions.size());
}

constexpr double Pi = 3.14159265358979323846;

class Visible : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Sphere->SetThetaResolution(60);
    this->Sphere->SetPhiResolution(60);
    this->Sphere->Update();
    this->Camera->SetPosition(0.0, 0.0, 5.0);
    this->Camera->SetFocalPoint(0.0, 0.0, 0.0);
    this->Camera->SetViewUp(0.0, 1.0, 0.0);
    this->Camera->SetClippingRange(0.1, 100.0);
    this->Camera->ParallelProjectionOn();
    this->Camera->SetParallelScale(1.0);
  }

  VisibleSurface See(
    const std::vector<vtkPolyData*>& surfaces, const glm::dmat3& frame = glm::dmat3(1.0))
  {
    return VisibleSurface(surfaces, this->Matrix, this->Camera, 2.0, frame);
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkCamera> Camera;
  vtkNew<vtkMatrix4x4> Matrix;
};
}

//------------------------------------------------------------------------------
// Seen in parallel, pairs are uniform over the disc.
TEST_F(Visible, SpheresCoverTheirDiscs)
{
  const VisibleSurface seen = this->See({ this->Sphere->GetOutput() });
  const std::vector<glm::dvec3> normals = Get(seen.Normals);
  const std::vector<glm::dvec3> views = Get(seen.Views);
  EXPECT_NEAR(static_cast<double>(normals.size()), 0.25 * Pi * 16384.0, 200.0);
  ASSERT_EQ(views.size(), normals.size());
  for (std::size_t k = 0; k < normals.size(); ++k)
  {
    EXPECT_NEAR(glm::length(normals[k]), 1.0, 1e-6);
    EXPECT_NEAR(glm::distance(views[k], glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-9);
    EXPECT_GE(normals[k].z, 0.0);
  }
  // The cosine's mean is 2/3.
  EXPECT_LT(glm::distance(GetMean(normals), glm::dvec3(0.0, 0.0, 2.0 / 3.0)), 0.02);
}

//------------------------------------------------------------------------------
// A cone from its tip: the flank is seen, not the base.
TEST_F(Visible, ConesShowTheirFlank)
{
  vtkNew<vtkConeSource> cone;
  cone->SetDirection(0.0, 0.0, 1.0);
  cone->SetHeight(1.0);
  cone->SetRadius(0.5);
  cone->SetResolution(100);
  cone->Update();
  const VisibleSurface seen = this->See({ cone->GetOutput() });
  ASSERT_FALSE(seen.IsEmpty());
  for (const glm::dvec3& n : Get(seen.Normals))
  {
    EXPECT_NEAR(n.z, 0.5 / std::sqrt(1.25), 0.01);
  }
}

//------------------------------------------------------------------------------
// Two equal plates that face the camera, one at twice the distance: pixels fall by its square. What
// hides behind the nearer one does not count.
TEST_F(Visible, WhatIsNearCountsForMore)
{
  this->Camera->ParallelProjectionOff();
  this->Camera->SetViewAngle(30.0);
  std::vector<vtkPolyData*> surfaces;
  vtkNew<vtkPlaneSource> plates[3];
  for (int k = 0; k < 3; ++k)
  {
    plates[k]->SetOrigin(-0.25, -0.25, 0.0);
    plates[k]->SetPoint1(0.25, -0.25, 0.0);
    plates[k]->SetPoint2(-0.25, 0.25, 0.0);
    plates[k]->SetCenter(k == 0 ? -0.5 : 1.0, 0.0, k == 0 ? 3.0 : 1.0);
    plates[k]->Update();
    surfaces.push_back(plates[k]->GetOutput());
  }
  plates[2]->SetCenter(-1.5, 0.0, -1.0); // seen through the middle of the first
  plates[2]->Update();
  const std::vector<glm::dvec3> views = Get(this->See(surfaces).Views);
  ASSERT_FALSE(views.empty());
  const auto near =
    std::count_if(views.begin(), views.end(), [](const glm::dvec3& view) { return view.x > 0.0; });
  EXPECT_NEAR(static_cast<double>(near) / static_cast<double>(views.size()), 0.8, 0.01);
}

//------------------------------------------------------------------------------
// Scaled unevenly and turned: normals by the inverse transpose.
TEST_F(Visible, ActorsAreTransformed)
{
  vtkNew<vtkPlaneSource> plane; // 1 x 1, normal +z
  plane->Update();
  vtkNew<vtkTransform> transform;
  transform->RotateY(60.0);
  transform->Scale(0.5, 0.25, 7.0);
  this->Matrix->DeepCopy(transform->GetMatrix());
  const VisibleSurface seen = this->See({ plane->GetOutput() });
  ASSERT_FALSE(seen.IsEmpty());
  for (const glm::dvec3& n : Get(seen.Normals))
  {
    EXPECT_NEAR(glm::distance(n, glm::dvec3(std::sqrt(0.75), 0.0, 0.5)), 0.0, 1e-6);
  }

  // A slanted one, stretched along x, faces further away from x.
  vtkNew<vtkPlaneSource> slanted;
  slanted->SetNormal(0.6, 0.0, 0.8);
  slanted->Update();
  vtkNew<vtkMatrix4x4> stretched;
  stretched->SetElement(0, 0, 2.0);
  const VisibleSurface wide(
    { slanted->GetOutput() }, stretched, this->Camera, 2.0, glm::dmat3(1.0));
  ASSERT_FALSE(wide.IsEmpty());
  const glm::dvec3 expected = glm::normalize(glm::dvec3(0.3, 0.0, 0.8));
  EXPECT_NEAR(glm::distance(Get(wide.Normals)[0], expected), 0.0, 1e-6);

  // Into another frame: z becomes x.
  const glm::dmat3 frame({ 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 });
  const VisibleSurface turned = this->See({ plane->GetOutput() }, frame);
  EXPECT_NEAR(
    glm::distance(Get(turned.Normals)[0], glm::dvec3(0.5, std::sqrt(0.75), 0.0)), 0.0, 1e-6);
  EXPECT_NEAR(glm::distance(Get(turned.Views)[0], glm::dvec3(1.0, 0.0, 0.0)), 0.0, 1e-9);
}

//------------------------------------------------------------------------------
TEST_F(Visible, OnlyWhatIsInThePictureCounts)
{
  // Half of the sphere right of the picture's left edge.
  this->Camera->SetPosition(2.0, 0.0, 5.0);
  this->Camera->SetFocalPoint(2.0, 0.0, 0.0);
  const VisibleSurface half = this->See({ this->Sphere->GetOutput() });
  ASSERT_FALSE(half.IsEmpty());
  for (const glm::dvec3& n : Get(half.Normals))
  {
    EXPECT_GE(n.x, -0.05);
  }
  this->Camera->SetPosition(9.0, 0.0, 5.0);
  this->Camera->SetFocalPoint(9.0, 0.0, 0.0);
  EXPECT_TRUE(this->See({ this->Sphere->GetOutput() }).IsEmpty());
  vtkNew<vtkPolyData> nothing;
  EXPECT_TRUE(this->See({ nothing }).IsEmpty());
}

//------------------------------------------------------------------------------
// A room shows the sides that face away.
TEST_F(Visible, RoomsAreSeenFromInside)
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  this->Camera->ParallelProjectionOff();
  this->Camera->SetPosition(0.0, 0.0, 0.1);
  const VisibleSurface seen = this->See({ cube->GetOutput() });
  const std::vector<glm::dvec3> normals = Get(seen.Normals);
  const std::vector<glm::dvec3> views = Get(seen.Views);
  EXPECT_EQ(normals.size(), 16384u);
  for (std::size_t k = 0; k < normals.size(); ++k)
  {
    EXPECT_GT(glm::dot(normals[k], views[k]), 0.0);
  }
}

//------------------------------------------------------------------------------
// Half spheres: as strips, without normals; and two of them as blocks.
TEST_F(Visible, StripsAndBlocksAreAlike)
{
  vtkNew<vtkSphereSource> halves[2];
  for (int k = 0; k < 2; ++k)
  {
    halves[k]->SetThetaResolution(30);
    halves[k]->SetPhiResolution(60);
    halves[k]->SetStartTheta(180.0 * k);
    halves[k]->SetEndTheta(180.0 * k + 180.0);
    halves[k]->Update();
  }
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(halves[0]->GetOutputPort());
  stripper->Update();
  vtkNew<vtkPolyData> bare;
  bare->ShallowCopy(stripper->GetOutput());
  bare->GetPointData()->SetNormals(nullptr);                   // the triangles' own
  const glm::dvec3 expected(0.0, 4.0 / (3.0 * Pi), 2.0 / 3.0); // of half a disc
  for (vtkPolyData* half : { halves[0]->GetOutput(), stripper->GetOutput(), bare.Get() })
  {
    EXPECT_LT(glm::distance(GetMean(Get(this->See({ half }).Normals)), expected), 0.03);
  }
  const VisibleSurface both = this->See({ halves[0]->GetOutput(), halves[1]->GetOutput() });
  EXPECT_NEAR(GetMean(Get(both.Normals)).y, 0.0, 0.03);
}
