// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// One trace for all mappers that show a surface, and traces that nobody waits for any more.
#include "AutomaticOcclusion.h"
#include "OcclusionTools.h"
#include "RenderFixture.h"
#include "SharedTrace.h"
#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTableRadianceIntegrator.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <thread>

using measuredbrdf::AutomaticOcclusion;
using measuredbrdf::SharedTrace;

namespace
{
// A hollow that is open downwards.
vtkSmartPointer<vtkPolyData> MakeBowl(int steps)
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetRadius(0.9);
  bowl->SetThetaResolution(2 * steps);
  bowl->SetPhiResolution(steps);
  bowl->SetEndPhi(115.0);
  bowl->Update();
  return bowl->GetOutput();
}

bool GoOn() { return true; }

bool HasArrays(vtkDataObject* data)
{
  auto* surface = vtkPolyData::SafeDownCast(data);
  return surface && GetBytes(surface, vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName());
}
}

class SharedTraceTest : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("sky"));
    MakeSmall(this->Table.Get());
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, -5.0); // into the hollow
  }

  // What one more mapper shows of a surface.
  vtkSmartPointer<vtkMeasuredBRDFMapper> Show(
    vtkPolyData* surface, bool bounce, FloatImage& picture)
  {
    auto mapper = vtkSmartPointer<vtkMeasuredBRDFMapper>::New();
    mapper->SetInputData(surface);
    mapper->SetBRDF(this->BRDF);
    mapper->SetEnvironment(this->Environment);
    mapper->SetIntegrator(this->Table);
    mapper->SetOcclusionModeToOn();
    mapper->SetOcclusionBounce(bounce);
    this->ShowAgain(mapper, picture);
    return mapper;
  }

  void ShowAgain(vtkMeasuredBRDFMapper* mapper, FloatImage& picture)
  {
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    this->Renderer->ResetCameraClippingRange();
    picture = this->RenderLinear();
    this->Renderer->RemoveActor(actor);
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkLambertBRDF> BRDF;
  vtkNew<vtkTableRadianceIntegrator> Table;
};

// The same object, a copy of it, and another surface; then with what comes back.
TEST_F(SharedTraceTest, MappersOfOneSurfaceTraceOnce)
{
  const auto bowl = MakeBowl(12);
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(bowl);
  FloatImage pictures[4];
  {
    const auto first = this->Show(bowl, false, pictures[0]);
    const auto second = this->Show(bowl, false, pictures[1]);
    const auto third = this->Show(copy, false, pictures[2]);
    EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 1);
    EXPECT_EQ(SharedTrace::Find(bowl), SharedTrace::Find(copy));
    EXPECT_EQ(pictures[0].RGBA, pictures[1].RGBA);
    EXPECT_EQ(pictures[0].RGBA, pictures[2].RGBA);
    const auto bouncing = this->Show(bowl, true, pictures[3]);
    EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 2);
    EXPECT_GT(pictures[3].At(32, 32)[0], 1.02f * pictures[0].At(32, 32)[0]);
    const auto other = MakeBowl(13);
    const auto fourth = this->Show(other, false, pictures[1]);
    EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 2);
    EXPECT_EQ(SharedTrace::Find(other)->GetNumberOfTraces(), 1);
  }
  // Nobody has it any more.
  EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 0);
}

// Arrays of a filter with occluders are those of its own output, for nobody else.
TEST_F(SharedTraceTest, OccludersAreNotShared)
{
  const auto bowl = MakeBowl(12);
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.0, 0.0, -1.2);
  ball->SetRadius(0.7);
  ball->Update();
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputData(bowl);
  filter->BothSidesOn();
  filter->AddOccluder(ball->GetOutput());
  filter->Update();
  FloatImage alone, beside, again;
  const auto first = this->Show(bowl, false, alone);
  const auto second =
    this->Show(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0)), false, beside);
  const auto third = this->Show(bowl, false, again);
  EXPECT_LT(beside.At(32, 32)[0], 0.8f * alone.At(32, 32)[0]);
  EXPECT_EQ(alone.RGBA, again.RGBA);
  EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 1);
}

// Two surfaces of the same points, which are the newest of both.
TEST_F(SharedTraceTest, SurfacesThatSharePointsKeepApart)
{
  const auto bowl = MakeBowl(12);
  vtkNew<vtkPolyData> part; // the rim
  part->ShallowCopy(bowl);
  vtkNew<vtkCellArray> polygons;
  for (vtkIdType cell = bowl->GetNumberOfCells() / 2; cell < bowl->GetNumberOfCells(); ++cell)
  {
    polygons->InsertNextCell(bowl->GetCell(cell));
  }
  part->SetPolys(polygons);
  FloatImage alone, whole, changed;
  this->Show(part, false, alone);
  bowl->GetPoints()->Modified();
  ASSERT_EQ(bowl->GetMTime(), part->GetMTime());
  const auto mapper = this->Show(bowl, false, whole);
  mapper->SetInputData(part);
  this->ShowAgain(mapper, changed);
  EXPECT_NE(whole.RGBA, alone.RGBA);
  EXPECT_EQ(changed.RGBA, alone.RGBA);
}

// Threads that ask at once, a question that nobody waits for, and one from inside of the trace.
TEST_F(SharedTraceTest, ThreadsWaitForOneAnother)
{
  const auto bowl = MakeBowl(60);
  const auto trace = SharedTrace::Find(bowl);
  EXPECT_EQ(trace->Attach(bowl, false, []() { return false; }), nullptr);
  EXPECT_EQ(trace->GetNumberOfTraces(), 0);
  {
    const auto small = MakeBowl(8);
    const auto stopped = SharedTrace::Find(small);
    EXPECT_EQ(stopped->Attach(small, false, []() { return false; }), nullptr);
    EXPECT_TRUE(HasArrays(stopped->Attach(small, false, GoOn)));
  }
  vtkSmartPointer<vtkDataObject> results[2];
  std::atomic<bool> began{ false };
  std::thread threads[2];
  for (int k = 0; k < 2; ++k)
  {
    threads[k] = std::thread(
      [&, k]()
      {
        results[k] = trace->Attach(bowl, false,
          [&]()
          {
            began = true;
            return true;
          });
      });
  }
  while (!began)
  {
    std::this_thread::yield();
  }
  EXPECT_EQ(trace->Attach(bowl, true, []() { return false; }), nullptr);
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(trace->GetNumberOfTraces(), 1);
  ASSERT_TRUE(HasArrays(results[0]));
  EXPECT_EQ(GetBytes(vtkPolyData::SafeDownCast(results[0]),
              vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()),
    GetBytes(
      vtkPolyData::SafeDownCast(results[1]), vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()));
  const auto other = MakeBowl(8);
  const auto inside = SharedTrace::Find(other);
  int asked = 0;
  EXPECT_TRUE(HasArrays(inside->Attach(other, false,
    [&]()
    {
      asked += HasArrays(inside->Attach(other, false, GoOn)) ? 1 : 0;
      return true;
    })));
  EXPECT_GT(asked, 0);
  EXPECT_EQ(inside->GetNumberOfTraces(), 1);
}

// A forecast that goes stops its thread, whatever that does: tens of milliseconds on each core, and
// a tenth of a second to build what rays meet. All of it takes 25 s of processor time.
TEST_F(SharedTraceTest, ForecastsStopWhenTheyGo)
{
  const auto bowl = MakeBowl(250);
  measuredbrdf::OcclusionQuestion question;
  question.Input = bowl;
  question.Materials.push_back(
    { this->BRDF.Get(), this->Environment, this->Environment->GetPixelsMTime(), 0.01 });
  question.InBackground = true;
  const auto trace = SharedTrace::Find(bowl);
  for (const double work : { 0.0, 0.1, 0.3, 2.0 }) // seconds of processor time: the last one traces
  {
    auto forecast = std::make_unique<AutomaticOcclusion>();
    const int holders = this->BRDF->GetReferenceCount();
    const double start = GetProcessorTime();
    forecast->Update(question);
    ASSERT_TRUE(forecast->IsPending());
    while (GetProcessorTime() < start + work && !forecast->IsReady())
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_FALSE(forecast->IsReady()) << work;
    const double before = GetProcessorTime();
    forecast.reset(); // which does not wait for its thread
    while (this->BRDF->GetReferenceCount() > holders)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    const double stopped = GetProcessorTime() - before;
    std::printf("after %.1f s: stopped within %.3f s of processor time\n", work, stopped);
    EXPECT_LT(stopped, 0.4 + 0.1 * std::thread::hardware_concurrency()) << work;
  }
  EXPECT_EQ(trace->GetNumberOfTraces(), 0);
}
