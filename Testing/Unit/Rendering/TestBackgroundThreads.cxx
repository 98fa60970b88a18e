// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Threads of the module's own: what they throw, threads that are not to be had, work that nobody
// waits for any more, and the end of a process.
#include "AutomaticOcclusion.h"
#include "BackgroundThreads.h"
#include "GatedBRDF.h"
#include "MapperPlans.h"
#include "ParallelFor.h"
#include "RecentlyUsed.h"
#include "SharedIntegrators.h"
#include "SpherePairs.h"
#include "vtkBRDFFormats.h"
#include "vtkBRDFModels.h"
#include "vtkBRDFResampler.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadianceMethods.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#if defined(__linux__) && defined(__GLIBC__)
#define TEST_ENDS_OF_PROCESSES
#include <pthread.h>
#include <unistd.h>
#endif

using measuredbrdf::AutomaticOcclusion;
using measuredbrdf::CurrentPlan;
using measuredbrdf::OcclusionQuestion;
using measuredbrdf::PlanInputs;
using measuredbrdf::RecentlyUsed;

#ifdef TEST_ENDS_OF_PROCESSES
namespace
{
// All VTK objects that live: what VTK_DEBUG_LEAKS would know, in any build of VTK.
struct LivingObjects
{
  std::mutex Mutex;
  std::set<vtkObject*> All;
  bool IsBusy = false;
  static LivingObjects& Get()
  {
    static LivingObjects& objects = *new LivingObjects;
    return objects;
  }
};

class DeathObserver : public vtkCommand
{
public:
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    LivingObjects& living = LivingObjects::Get();
    const std::lock_guard<std::mutex> lock(living.Mutex);
    living.All.erase(caller);
  }
};

std::atomic<bool> AreCounted{ false };
}

// Instead of VTK's, which does nothing without VTK_DEBUG_LEAKS.
void vtkObjectBase::InitializeObjectBase()
{
  auto* object = AreCounted ? vtkObject::SafeDownCast(this) : nullptr;
  if (object)
  {
    LivingObjects& living = LivingObjects::Get();
    {
      const std::lock_guard<std::mutex> lock(living.Mutex);
      living.All.insert(object);
    }
    auto* observer = new DeathObserver;
    object->AddObserver(vtkCommand::DeleteEvent, observer);
    observer->UnRegister(nullptr);
  }
}

namespace
{
constexpr int Leaked = 3;
constexpr int StillRuns = 4;
std::shared_ptr<Gate> Watched; // of a material that is planned for while the process ends

// Runs after all that was made later, such as what the module releases.
void CheckEnd()
{
  if (Watched)
  {
    Watched->TakePasses();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (Watched->TakePasses() > 0)
    {
      std::fprintf(stderr, "a thread still plans\n");
      _exit(StillRuns);
    }
  }
  LivingObjects& living = LivingObjects::Get();
  const std::lock_guard<std::mutex> lock(living.Mutex);
  for (vtkObject* object : living.All)
  {
    std::fprintf(stderr, "never destroyed: %s\n", object->GetClassName());
  }
  if (AreCounted && !living.All.empty())
  {
    _exit(Leaked);
  }
}
const int IsRegistered = std::atexit(CheckEnd);
}
#endif

namespace
{
bool Throws = false; // while nothing plans

class ThrowingBRDF : public vtkLambertBRDF
{
public:
  static ThrowingBRDF* New();
  vtkTypeMacro(ThrowingBRDF, vtkLambertBRDF);

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    if (Throws)
    {
      throw std::bad_alloc();
    }
    this->Superclass::EvaluateAbove(i, o, f);
  }
};
vtkStandardNewMacro(ThrowingBRDF);

vtkSmartPointer<vtkPolyData> MakeHollowSphere(int steps)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(2 * steps);
  sphere->SetPhiResolution(steps);
  sphere->SetEndPhi(115.0);
  sphere->Update();
  return sphere->GetOutput();
}

class Forecast : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Gated->SetExponent(5.0);
    this->Question.Input = this->Hollow;
    this->Question.InBackground = true;
  }
  void TearDown() override
  {
    Throws = false;
    this->Gated->Door->OpenUp();
  }

  static vtkSmartPointer<vtkEnvironment> NewSky(float value)
  {
    auto sky = vtkSmartPointer<vtkEnvironment>::New();
    sky->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, value));
    return sky;
  }

  void Ask(vtkBRDF* brdf, vtkEnvironment* sky)
  {
    this->Question.Materials = { { brdf, sky, sky->GetPixelsMTime(), 0.01 } };
  }

  vtkNew<GatedBRDF> Gated;
  vtkSmartPointer<vtkPolyData> Hollow = MakeHollowSphere(12);
  OcclusionQuestion Question;
};
}

TEST(RecentlyUsed, KeepsWhatWasUsedLast)
{
  RecentlyUsed<int, std::string> values(3);
  for (int k = 0; k < 3; ++k)
  {
    values[k] = std::to_string(k);
  }
  ASSERT_TRUE(values.Find(0));
  values[3] = "3"; // for 1, which was used longest ago
  EXPECT_EQ(values.GetSize(), 3u);
  EXPECT_FALSE(values.Find(1));
  EXPECT_EQ(*values.Find(0), "0");
  EXPECT_EQ(*values.Find(2), "2");
  values.Remove(2);
  EXPECT_FALSE(values.Find(2));
  values[4] = "4";
  EXPECT_EQ(values.GetSize(), 3u);
  EXPECT_EQ(values.begin()->first, 4);
  values.Clear();
  EXPECT_FALSE(values.Find(4));
}

// Loops beside a VTK that is built for one thread: all elements, each once, on several threads. A
// loop within a loop stays on its thread.
TEST(OwnThreads, RunEachElementOnce)
{
  for (const vtkIdType grain : { 0, 1, 7, 1000 })
  {
    std::vector<std::atomic<int>> visits(100);
    std::mutex mutex;
    std::set<std::thread::id> threads;
    measuredbrdf::RunOnThreads(3, 20, 120, grain,
      [&](vtkIdType begin, vtkIdType end)
      {
        measuredbrdf::RunOnThreads(3, begin, end, 1,
          [&, outer = std::this_thread::get_id()](vtkIdType first, vtkIdType last)
          {
            EXPECT_EQ(std::this_thread::get_id(), outer);
            for (; first < last; ++first)
            {
              ++visits[static_cast<std::size_t>(first - 20)];
            }
          });
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const std::lock_guard<std::mutex> lock(mutex);
        threads.insert(std::this_thread::get_id());
      });
    for (const std::atomic<int>& count : visits)
    {
      EXPECT_EQ(count, 1) << "grain " << grain;
    }
    EXPECT_EQ(threads.size() > 1, grain < 1000);
    EXPECT_LE(threads.size(), 3u);
  }
  measuredbrdf::RunOnThreads(3, 5, 5, 0, [](vtkIdType, vtkIdType) { ADD_FAILURE(); });
}

TEST(BackgroundThreads, WhatIsThrownEndsTheWorkOnly)
{
  std::atomic<bool> ran{ false };
  const auto held = std::make_shared<int>(1);
  ASSERT_TRUE(measuredbrdf::RunInBackground(
    [&ran, held]()
    {
      ran = true;
      throw std::runtime_error("its own trouble");
    },
    []() {}));
  EXPECT_TRUE(WaitUntil([&]() { return ran && held.use_count() == 1; }));
}

// Memory that runs out on the thread is a problem that is told once, and nothing is predicted.
TEST_F(Forecast, TellsWhatIsThrown)
{
  vtkNew<ThrowingBRDF> brdf;
  const auto sky = this->NewSky(1.0f);
  for (const bool background : { true, false })
  {
    AutomaticOcclusion forecast;
    this->Ask(brdf, sky);
    this->Question.InBackground = background;
    Throws = true;
    std::string problem = forecast.Update(this->Question);
    if (problem.empty()) // its thread may have ended before that
    {
      ASSERT_TRUE(background);
      ASSERT_TRUE(WaitUntil([&]() { return forecast.IsReady(); }));
      problem = forecast.Update(this->Question);
    }
    EXPECT_EQ(problem, "std::bad_alloc");
    EXPECT_EQ(forecast.Update(this->Question), "");
    EXPECT_FALSE(forecast.IsPending());
    EXPECT_LT(forecast.GetError(), 0.0);
    EXPECT_EQ(forecast.GetTraced(), nullptr);
    // What changes is tried again.
    Throws = false;
    brdf->SetAlbedo(0.6, 0.6, background ? 0.6 : 0.5);
    EXPECT_EQ(forecast.Update(this->Question), "");
    ASSERT_TRUE(WaitUntil([&]() { return !forecast.IsPending() || forecast.IsReady(); }));
    EXPECT_EQ(forecast.Update(this->Question), "");
    EXPECT_GT(forecast.GetError(), 0.0);
  }
}

// Five views with five environments: each is answered once.
TEST_F(Forecast, ViewsThatTakeTurnsComeToAnEnd)
{
  AutomaticOcclusion forecast;
  std::vector<vtkSmartPointer<vtkEnvironment>> skies;
  for (int k = 0; k < 5; ++k)
  {
    skies.push_back(this->NewSky(1.0f + static_cast<float>(k)));
  }
  bool pending = true;
  for (int round = 0; round < 20 && pending; ++round)
  {
    pending = false;
    for (const auto& sky : skies)
    {
      this->Ask(this->Gated, sky);
      forecast.Update(this->Question);
      if (forecast.IsPending())
      {
        pending = true;
        ASSERT_TRUE(WaitUntil([&]() { return forecast.IsReady(); }));
      }
    }
  }
  EXPECT_FALSE(pending);
  this->Gated->Door->TakePasses();
  this->Question.InBackground = false;
  for (const auto& sky : skies)
  {
    this->Ask(this->Gated, sky);
    forecast.Update(this->Question);
    EXPECT_GE(forecast.GetError(), 0.0);
  }
  EXPECT_EQ(this->Gated->Door->TakePasses(), 0);
}

// Neither another surface nor the forecast's end waits for what is in the making.
TEST_F(Forecast, NobodyWaitsForWhatIsLeft)
{
  const auto sky = this->NewSky(1.0f);
  const auto snapshot = vtkSmartPointer<vtkBRDF>::Take(this->Gated->NewSnapshot());
  const auto door = this->Gated->Door;
  door->Close();
  std::thread opener( // a call that waits would else never return
    [door]()
    {
      for (int k = 0; k < 400 && door->TakePasses() < 1000; ++k)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
      std::this_thread::sleep_for(std::chrono::seconds(3));
      door->OpenUp();
    });
  auto forecast = std::make_unique<AutomaticOcclusion>();
  this->Ask(snapshot, sky);
  forecast->Update(this->Question);
  ASSERT_TRUE(forecast->IsPending());
  EXPECT_TRUE(WaitUntil([&]() { return door->IsAwaited(); }));
  const auto other = MakeHollowSphere(13);
  this->Question.Input = other;
  forecast->Update(this->Question);
  EXPECT_TRUE(door->IsAwaited());
  forecast.reset();
  EXPECT_TRUE(door->IsAwaited());
  opener.join();
  EXPECT_TRUE(WaitUntil([&]() { return !door->IsAwaited(); }));
  this->Question.Materials.clear();
  EXPECT_TRUE(WaitUntil([&]() { return snapshot->GetReferenceCount() == 1; }));
}

namespace
{
// Its form for shaders is a long search for a table.
class ResampledBRDF : public GatedBRDF
{
public:
  static ResampledBRDF* New();
  vtkTypeMacro(ResampledBRDF, GatedBRDF);

  bool IsRenderable() override { return false; }
  vtkBRDF* GetRenderable() override
  {
    this->Door->Close();
    this->Door->TakePasses();
    this->Resampler->SetInput(this);
    this->Resampler->SetTolerance(1e-6);
    this->Resampler->Resample();
    return this->Resampler->GetOutput();
  }

protected:
  vtkBRDF* NewCopy() override
  {
    ResampledBRDF* copy = ResampledBRDF::New();
    copy->Door = this->Door;
    return copy;
  }

private:
  vtkNew<vtkBRDFResampler> Resampler;
};
vtkStandardNewMacro(ResampledBRDF);
}

// Neither is a table for shaders made to its end that nobody waits for.
TEST(CurrentPlan, LeavesResamplingInTheMiddle)
{
  vtkNew<ResampledBRDF> brdf;
  vtkNew<vtkEnvironment> sky;
  sky->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, 0.5f));
  {
    CurrentPlan plan;
    std::string problem;
    PlanInputs inputs(brdf, sky, 0.3);
    inputs.WithShaderInputs = true;
    plan.Update(inputs, CurrentPlan::Timing::Always, problem);
    ASSERT_TRUE(WaitUntil([&]() { return brdf->Door->IsAwaited(); }));
  }
  brdf->Door->OpenUp();
  measuredbrdf::PlanJob::WaitForStopped();
  EXPECT_LT(brdf->Door->TakePasses(), 1 << 14);
}

#ifdef TEST_ENDS_OF_PROCESSES
namespace
{
// No thread is to be had while this lives: no address space has room for such a stack.
class NoThreads
{
public:
  NoThreads()
  {
    pthread_getattr_default_np(&this->Before);
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, static_cast<std::size_t>(1) << 46);
    EXPECT_EQ(pthread_setattr_default_np(&attributes), 0);
    pthread_attr_destroy(&attributes);
  }
  ~NoThreads()
  {
    pthread_setattr_default_np(&this->Before);
    pthread_attr_destroy(&this->Before);
  }
  NoThreads(const NoThreads&) = delete;
  void operator=(const NoThreads&) = delete;

private:
  pthread_attr_t Before;
};
}

TEST_F(Forecast, WithoutThreads)
{
  const auto sky = this->NewSky(1.0f);
  this->Ask(this->Gated, sky);
  AutomaticOcclusion forecast;
  {
    const NoThreads none;
    EXPECT_FALSE(measuredbrdf::RunInBackground([]() {}, []() {}));
    EXPECT_EQ(forecast.Update(this->Question), "");
    EXPECT_FALSE(forecast.IsPending());
    EXPECT_GE(forecast.GetError(), 0.0);
  }
  EXPECT_TRUE(measuredbrdf::RunInBackground([]() {}, []() {}));
}

namespace
{
void EndWhilePlanning()
{
  EXPECT_TRUE(measuredbrdf::RunInBackground([]() {}, []() {})); // a thread that ends before
  auto* brdf = GatedBRDF::New();
  brdf->SetExponent(90.0);
  Watched = brdf->Door;
  vtkNew<vtkEnvironment> sky;
  sky->SetPixels(512, 256, std::vector<float>(3 * 512 * 256, 0.5f));
  auto* plan = new CurrentPlan;
  std::string problem;
  plan->Update(PlanInputs(brdf, sky, 0.001), CurrentPlan::Timing::Always, problem);
  EXPECT_TRUE(WaitUntil([&]() { return Watched->TakePasses() > 0; }));
  std::exit(plan->IsReady() ? 1 : 0);
}

void EndWhileForecasting()
{
  auto* brdf = GatedBRDF::New();
  Watched = brdf->Door;
  vtkNew<vtkEnvironment> sky;
  sky->SetPixels(256, 128, std::vector<float>(3 * 256 * 128, 0.5f));
  const auto hollow = MakeHollowSphere(120);
  OcclusionQuestion question;
  question.Input = hollow;
  question.InBackground = true;
  question.Materials = { { brdf, sky.Get(), sky->GetPixelsMTime(), 0.01 } };
  auto* forecast = new AutomaticOcclusion;
  forecast->Update(question);
  EXPECT_TRUE(WaitUntil([&]() { return Watched->TakePasses() > 0; }));
  std::exit(forecast->IsReady() ? 1 : 0);
}

void UseAllAndEnd()
{
  AreCounted = true;
  {
    vtkNew<GatedBRDF> brdf;
    vtkNew<vtkEnvironment> sky;
    sky->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, 0.5f));
    std::string problem;
    for (const auto timing : { CurrentPlan::Timing::Foreground, CurrentPlan::Timing::Changes })
    {
      CurrentPlan plan;
      EXPECT_TRUE(plan.Update(PlanInputs(brdf, sky, 0.3), timing, problem));
    }
    const auto standIn = measuredbrdf::FindStandIn(brdf, sky, true);
    standIn->Prepare();
    EXPECT_FALSE(vtkBRDFFormats::GetFormats().empty());
    EXPECT_FALSE(vtkBRDFModels::GetModels().empty());
    EXPECT_FALSE(vtkRadianceMethods::GetMethods().empty());
  }
  std::exit(0);
}
}

// A leaked plan is in the making when the process ends: its thread stops before anything goes.
TEST(EndOfProcess, StopsPlans)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(EndWhilePlanning(), testing::ExitedWithCode(0), "");
}

TEST(EndOfProcess, StopsForecasts)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(EndWhileForecasting(), testing::ExitedWithCode(0), "");
}

// What the module shares goes when the process ends.
TEST(EndOfProcess, LeavesNoObjects)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(UseAllAndEnd(), testing::ExitedWithCode(0), "");
}
#endif
