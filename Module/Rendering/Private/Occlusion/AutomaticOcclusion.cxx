// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AutomaticOcclusion.h"

#include "BackgroundThreads.h"
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "ScopedErrorCapture.h"
#include "SharedTrace.h"
#include "SurfaceBlocks.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkOcclusionPredictor.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTracedScene.h"
#include "vtkTracedSurfaces.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int MostChanges = 3; // of a surface, in frames one after the other
constexpr int ProbePoints = 64;
constexpr int ProbeRays = 16;
constexpr double LeastError = 0.002;      // to be spoken of
constexpr std::size_t MostAnswers = 1024; // about a surface: views and materials that take turns

// Whether a thousand rays from points as cameras all around see them find that the scene hides
// anything from itself.
bool HidesAnything(vtkTracedScene* scene)
{
  const vtkTracedSurfaces& surfaces = scene->GetSurfaces();
  constexpr double golden = 2.399963229728653; // radians
  int ray = 0;
  for (const SurfacePoint& point : surfaces.DrawPoints(ProbePoints, glm::dvec3(0.0)))
  {
    const glm::dmat3 frame = FrameAbout(point.Normal);
    for (int s = 0; s < ProbeRays; ++s, ++ray)
    {
      const double z = std::sqrt((s + 0.5) / ProbeRays); // by cosines
      const double across = std::sqrt(1.0 - z * z);
      const double azimuth = golden * ray;
      if (surfaces.IsHidden(
            point, frame * glm::dvec3(across * std::cos(azimuth), across * std::sin(azimuth), z)))
      {
        return true;
      }
    }
  }
  return false;
}

// As environments are now: the job may go on while they are changed.
std::vector<OcclusionQuestion::Material> TakeSnapshots(
  std::vector<OcclusionQuestion::Material> materials)
{
  for (OcclusionQuestion::Material& material : materials)
  {
    material.Environment =
      vtkSmartPointer<vtkEnvironment>::Take(material.Environment->NewSnapshot());
  }
  return materials;
}
}

//------------------------------------------------------------------------------
class AutomaticOcclusion::Job
{
public:
  Job(const OcclusionQuestion& question, bool apart)
    : Materials(TakeSnapshots(question.Materials))
    , ToEnvironment(question.FindToEnvironment ? question.FindToEnvironment() : nullptr)
    , Tolerance(question.Tolerance)
    , IsAlways(question.Always)
    , Input(CopyBlocks(question.Input,
        [apart](vtkPolyData* surface)
        {
          vtkSmartPointer<vtkPolyData> copy = CopyGeometry(surface);
          if (apart)
          {
            const vtkSmartPointer<vtkPolyData> shared = copy;
            copy = vtkSmartPointer<vtkPolyData>::New();
            copy->DeepCopy(shared);
          }
          return copy;
        }))
  {
    this->Found.Most = apart ? MostPointsInBackground : MostPoints;
    for (vtkPolyData* surface : GetBlocks(this->Input))
    {
      this->Found.Points += surface->GetNumberOfPoints();
    }
  }

  ~Job() = default;
  Job(const Job&) = delete;
  void operator=(const Job&) = delete;

  // Whether the answer takes no time, because a look at few points finds nothing hidden.
  bool IsEasy() { return this->Found.Points <= MostPoints && !HidesAnything(this->GetScene()); }

  // Whether there is a thread for it, which holds it until it is done.
  static bool Start(const std::shared_ptr<Job>& job)
  {
    job->Done = false;
    const bool starts = RunInBackground(
      [job]()
      {
        job->Run();
        job->Done = true;
      },
      [running = std::weak_ptr<Job>(job)]()
      {
        if (const std::shared_ptr<Job> last = running.lock())
        {
          last->Stop();
        }
      });
    if (!starts)
    {
      job->Done = true;
    }
    return starts;
  }

  void Stop()
  {
    this->IsStopped = true;
    this->Predictor->SetAbort(true);
  }

  void Run()
  {
    // Nobody catches it above a thread.
    if (const auto problem = FindThrown([this]() { this->Forecast(); }))
    {
      this->Found = { -1.0, 0.0, false, this->Found.Points, this->Found.Most, *problem };
      this->Traced = nullptr;
      this->Trace = nullptr;
    }
  }

  std::vector<OcclusionQuestion::Material> Materials;
  vtkSmartPointer<vtkMatrix4x4> ToEnvironment;
  double Tolerance;
  bool IsAlways;
  bool WithBounce = false;
  vtkSmartPointer<vtkDataObject> Input;
  std::atomic<bool> Done{ true };
  Prediction Found;
  vtkSmartPointer<vtkDataObject> Traced;
  std::shared_ptr<SharedTrace> Trace;

private:
  void Forecast()
  {
    if ((!this->IsAlways && !this->IsWorthIt()) || this->Traced) // for another map, say
    {
      return;
    }
    this->Trace = SharedTrace::Find(this->Input);
    this->Traced =
      this->Trace->Attach(this->Input, this->WithBounce, [this]() { return !this->IsStopped; });
  }

  bool IsWorthIt()
  {
    if (this->Found.Points > MostPointsInBackground)
    {
      return false;
    }
    if (!HidesAnything(this->GetScene()))
    {
      this->Found.Error = 0.0;
      return false;
    }
    bool worth = false;
    for (const OcclusionQuestion::Material& material : this->Materials)
    {
      worth = !this->IsStopped && (this->Predict(material) || worth);
    }
    this->Found.IsLeftOut = worth && (this->IsStopped || this->Found.Points > this->Found.Most);
    return worth && !this->Found.IsLeftOut;
  }

  vtkTracedScene* GetScene()
  {
    if (!this->Scene)
    {
      this->Scene = vtkSmartPointer<vtkTracedScene>::New();
      for (vtkPolyData* surface : GetBlocks(this->Input))
      {
        this->Scene->AddSurface(surface, this->ToEnvironment);
      }
    }
    return this->Scene;
  }

  // Whether it is worth modeling.
  bool Predict(const OcclusionQuestion::Material& material)
  {
    vtkOcclusionPredictor* predictor = this->Predictor;
    predictor->SetScene(this->GetScene());
    predictor->SetBRDF(material.BRDF);
    predictor->SetEnvironment(material.Environment);
    const ScopedErrorCapture stopped(predictor); // nobody waits for it any more
    const bool done = predictor->Update();
    if (done && predictor->GetError() > this->Found.Error)
    {
      this->Found.Error = predictor->GetError();
      this->Found.Uncertainty = predictor->GetUncertainty();
    }
    return done && vtkOcclusionPredictor::IsWorthModeling(
                     predictor->GetError(), material.PlanError, this->Tolerance);
  }

  vtkSmartPointer<vtkTracedScene> Scene;
  vtkNew<vtkOcclusionPredictor> Predictor;
  std::atomic<bool> IsStopped{ false };
};

//------------------------------------------------------------------------------
AutomaticOcclusion::AutomaticOcclusion()
  : Known(MostAnswers)
{
}

AutomaticOcclusion::~AutomaticOcclusion() { this->Leave(); }

// Its thread, if it has one, holds it until it has stopped: a trace may take a while to do so.
void AutomaticOcclusion::Leave()
{
  if (this->Work)
  {
    this->Work->Stop();
    this->Work.reset();
  }
}

// Whether it is the same surface as in the frame before, or one that is worth an answer yet.
bool AutomaticOcclusion::FollowsSurface(vtkDataObject* input)
{
  std::vector<std::pair<void*, vtkMTimeType>> stamp;
  for (vtkPolyData* surface : GetBlocks(input))
  {
    for (vtkObject* array : { static_cast<vtkObject*>(surface->GetPoints()),
           static_cast<vtkObject*>(surface->GetPointData()->GetNormals()),
           static_cast<vtkObject*>(surface->GetPolys()),
           static_cast<vtkObject*>(surface->GetStrips()) })
    {
      stamp.emplace_back(array, array ? array->GetMTime() : 0);
    }
  }
  if (stamp == this->Stamp)
  {
    this->Changes = 0;
    return true;
  }
  this->Stamp = std::move(stamp);
  const std::string before = std::exchange(this->Content, GetContentKey(input));
  this->Changes = this->Content == before ? 0 : this->Changes + 1;
  return this->Changes <= MostChanges;
}

bool AutomaticOcclusion::IsReady() const { return this->Work && this->Work->Done; }

// Numbers are kept: the tree of half a million triangles takes 45 MB.
std::string AutomaticOcclusion::Take()
{
  const std::shared_ptr<Job> done = std::move(this->Work);
  if (done->Traced)
  {
    this->Traced = done->Traced;
    this->Trace = done->Trace;
  }
  this->Known[this->Asked] = done->Found;
  return done->Found.Problem;
}

// On a thread, or else at once.
void AutomaticOcclusion::Begin(const OcclusionQuestion& question)
{
  this->Work = std::make_shared<Job>(question, question.InBackground);
  this->Work->WithBounce = this->WithBounce;
  this->Work->Traced = this->Traced;
  this->Work->Trace = this->Trace;
  if (question.InBackground && !this->Work->IsEasy() && Job::Start(this->Work))
  {
    return;
  }
  this->Work->Found.Most = MostPoints;
  this->Work->Run();
}

// What an answer depends on beside the surface.
AutomaticOcclusion::Key AutomaticOcclusion::GetKey(const OcclusionQuestion& question)
{
  Key key(1);
  static_assert(sizeof(question.Tolerance) == sizeof(key[0]), "as many bits");
  std::memcpy(key.data(), &question.Tolerance, sizeof(question.Tolerance));
  for (const OcclusionQuestion::Material& material : question.Materials)
  {
    key.insert(key.end(), { reinterpret_cast<std::uintptr_t>(material.BRDF.Get()),
                            material.BRDF->GetMTime(), material.PixelsTime });
  }
  return key;
}

// Views with different lights ask in turns: each has its answer, and what was traced serves all.
std::string AutomaticOcclusion::Update(const OcclusionQuestion& question)
{
  const std::string before = this->Content;
  const bool follows = this->FollowsSurface(question.Input);
  if (this->Content != before || (question.WithBounce && !this->WithBounce))
  {
    this->WithBounce = question.WithBounce;
    this->Leave();
    this->Known.Clear();
    this->Answer.reset();
    this->Traced = nullptr;
    this->Trace = this->Content != before ? nullptr : this->Trace; // which knows the sky
  }
  const Key key = GetKey(question);
  std::string problem = this->IsReady() ? this->Take() : "";
  if (!this->Work && !this->Known.Find(key) &&
      (question.Always || (follows && !question.Materials.empty())))
  {
    this->Asked = key;
    try
    {
      this->Begin(question);
      problem = this->IsReady() ? this->Take() : problem;
    }
    catch (const std::exception& e) // no memory for copies of the surface, say
    {
      this->Leave();
      problem = e.what();
      this->Known[key].Problem = problem;
    }
  }
  const Prediction* known = this->Known.Find(key);
  this->Answer = known ? std::optional<Prediction>(*known) : std::nullopt;
  return problem;
}

double AutomaticOcclusion::GetError() const { return this->Answer ? this->Answer->Error : -1.0; }

std::string AutomaticOcclusion::GetText() const
{
  if (!this->Answer)
  {
    return this->Changes > MostChanges ? "occlusion is left out while the surface changes" : "";
  }
  if (this->Answer->Error + this->Answer->Uncertainty < LeastError)
  {
    return "";
  }
  const std::string text =
    vtkOcclusionPredictor::FormatText(this->Answer->Error, this->Answer->Uncertainty);
  if (this->Traced)
  {
    return text + ", modeled";
  }
  return text + (this->Answer->IsLeftOut
                    ? ", not modeled: " + std::to_string(this->Answer->Points) +
                        " points are more than " + std::to_string(this->Answer->Most)
                    : ", within the tolerance");
}
} // namespace measuredbrdf
