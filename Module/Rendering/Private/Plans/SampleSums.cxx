// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SampleSums.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkInformation.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderUtilities.h" // VTK's OpenGL, whichever library it loads it with
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkProperty.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkShaderProperty.h"
#include "vtkTexture.h"
#include "vtkTextureObject.h"
#include "vtkTransform.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>

namespace measuredbrdf
{
namespace
{
constexpr double LongestFrame = 0.5;     // seconds, of sub-frames while one looks on
constexpr double LongestSubframe = 0.1;  // after which whoever wants to abort is asked
constexpr unsigned long Pause = 10;      // milliseconds, for events between frames
constexpr unsigned long MostPasses = 64; // Renders of a mapper in one picture
constexpr std::size_t BytesOfPixel = 16 + 16 + 4;
constexpr std::size_t MostSumBytes = std::size_t(512) << 20; // of all sums
std::atomic<std::size_t> BytesInUse{ 0 };

int CountSamples(const std::vector<DrawnMaterial>& materials)
{
  int count = 0;
  for (const DrawnMaterial& drawn : materials)
  {
    auto* filtered = vtkFilteredRadianceIntegrator::SafeDownCast(drawn.Integrator);
    count = std::max(count, filtered && drawn.IsReady ? filtered->GetNumberOfSamples() : 0);
  }
  return count;
}

// Whether they come after the radiance, which they so do not change.
bool AreReplacementsLate(vtkShaderProperty* shaders)
{
  for (int k = 0; k < shaders->GetNumberOfShaderReplacements(); ++k)
  {
    std::string tag, text;
    bool isFirst, isOfAll;
    shaders->GetNthShaderReplacement(k, tag, isFirst, text, isOfAll);
    if (isFirst || tag != "//VTK::Light::Impl")
    {
      return false;
    }
  }
  return true;
}

// Passes that draw surfaces in several layers, or whose outputs are of their own, have all samples
// at once. So have programs' own shaders, whose uniforms need not say when they change.
bool MayAdd(const SummedPart& part)
{
  vtkMapper* mapper = part.Actor->GetMapper();
  vtkInformation* keys = part.Actor->GetPropertyKeys();
  const bool hasPasses = keys && keys->Has(vtkOpenGLRenderPass::RenderPasses());
  return mapper && !hasPasses && !part.Actor->IsRenderingTranslucentPolygonalGeometry() &&
         AreReplacementsLate(part.Actor->GetShaderProperty()) &&
         !mapper->HasObserver(vtkCommand::UpdateShaderEvent);
}

// Whether there are texture units for the sums.
bool HasRoom(const std::vector<DrawnMaterial>& materials, vtkOpenGLRenderWindow* window)
{
  const std::size_t units = CountTextureUnits(window);
  return std::all_of(materials.begin(), materials.end(),
    [units](const DrawnMaterial& drawn)
    {
      std::size_t samplers = 2;
      for (const auto& textures : { drawn.Material, drawn.Radiance })
      {
        samplers += textures ? textures->GetNumberOfSamplers() : 0;
      }
      return samplers <= units;
    });
}

// What the surface's place in the picture depends on, and its light.
std::vector<double> GetViewKey(const SummedPart& part, const int* viewport)
{
  vtkRenderer* renderer = part.Renderer;
  vtkCamera* camera = renderer->GetActiveCamera();
  std::vector<double> key(viewport, viewport + 4);
  const auto addTime = [&key](vtkObject* object)
  { key.push_back(object ? static_cast<double>(object->GetMTime()) : 0.0); };
  const double aspect = static_cast<double>(viewport[2]) / viewport[3];
  for (vtkMatrix4x4* matrix :
    { camera->GetCompositeProjectionTransformMatrix(aspect, -1, 1), part.Actor->GetMatrix() })
  {
    key.insert(key.end(), matrix->GetData(), matrix->GetData() + 16);
  }
  key.insert(key.end(), renderer->GetEnvironmentRight(), renderer->GetEnvironmentRight() + 3);
  key.insert(key.end(), renderer->GetEnvironmentUp(), renderer->GetEnvironmentUp() + 3);
  key.push_back(static_cast<double>(part.Time));
  addTime(part.Actor->GetProperty());
  addTime(part.Actor->GetBackfaceProperty());
  for (const auto& texture : part.Actor->GetProperty()->GetAllTextures())
  {
    addTime(texture.second);
  }
  vtkPlaneCollection* planes = part.Actor->GetMapper()->GetClippingPlanes();
  key.push_back(planes ? planes->GetNumberOfItems() : 0);
  for (int k = 0; planes && k < planes->GetNumberOfItems(); ++k)
  {
    addTime(planes->GetItem(k));
  }
  return key;
}

// What the samples depend on beside that. Times are never used twice.
std::vector<double> GetKey(const SummedPart& part, const std::vector<DrawnMaterial>& materials)
{
  std::vector<double> key = { static_cast<double>(part.OcclusionTime) };
  for (const DrawnMaterial& drawn : materials)
  {
    key.push_back(drawn.Integrator ? static_cast<double>(drawn.Integrator->GetInputsMTime()) : 0.0);
    key.push_back(drawn.Environment ? static_cast<double>(drawn.Environment->GetMTime()) : 0.0);
  }
  return key;
}

// Restores OpenGL's state, whatever way drawing ends.
class Target
{
public:
  Target(vtkOpenGLState* state, vtkOpenGLFramebufferObject* framebuffer, const int* viewport)
    : State(state)
  {
    state->Push();
    framebuffer->Bind();
    framebuffer->ActivateDrawBuffers(2);
    state->vtkglViewport(0, 0, viewport[2], viewport[3]);
    state->vtkglScissor(0, 0, viewport[2], viewport[3]);
    state->vtkglColorMask(1, 1, 1, 1);
    state->vtkglDepthMask(1);
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglBlendFunc(GL_ONE, GL_ONE);
  }
  ~Target() { this->State->Pop(); }
  Target(const Target&) = delete;
  void operator=(const Target&) = delete;

  void Clear()
  {
    this->State->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    this->State->vtkglClearDepth(1.0);
    this->State->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }

  // First the front-most surface is found, then samples are added where it is.
  void Prepare(SumStage stage)
  {
    const bool adds = stage == SumStage::Add;
    adds ? this->State->vtkglEnable(GL_BLEND) : this->State->vtkglDisable(GL_BLEND);
    this->State->vtkglDepthFunc(adds ? GL_LEQUAL : GL_LESS);
  }

private:
  vtkOpenGLState* State;
};
}

// An actor as a renderer shows it to an eye.
struct SampleSums::View
{
  struct Progress
  {
    std::vector<double> Key;
    int Done = 0; // samples
    int Count = 1;
    double Seconds = 0.0;        // that these took
    double PerSample = HUGE_VAL; // of the last sub-frame
    unsigned long Render = 0;    // the last one

    // As many samples as take that long, and of the first sub-frame one; what is left is spread
    // evenly.
    int GetNext(double seconds) const
    {
      const int left = this->Count - this->Done;
      const double frames = std::ceil(std::min<double>(left * (this->PerSample / seconds), left));
      return static_cast<int>(std::ceil(left / std::max(frames, 1.0)));
    }
  };

  vtkWeakPointer<vtkRenderer> Renderer;
  vtkWeakPointer<vtkActor> Actor;
  bool IsLeft = true;
  bool IsCulled = false; // in the renderer's last picture
  unsigned long EndObserver = 0;
  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer; // null: nothing is kept
  std::size_t Bytes = 0;
  int Viewport[4] = { 0, 0, 0, 0 };
  std::vector<double> Key;
  std::map<const void*, Progress> Parts; // none: the framebuffer is to be cleared
  std::map<const void*, double> Seconds; // for all samples of parts, as last measured
  vtkWeakPointer<vtkRenderWindowInteractor> Interactor; // whose timer draws the next picture
  unsigned long Observer = 0;
  SampleSums* Sums = nullptr;
  int Timer = 0;

  View() = default;
  View(const View&) = delete;
  void operator=(const View&) = delete;
  ~View()
  {
    this->Free();
    this->RemoveTimer();
    if (this->Renderer)
    {
      this->Renderer->RemoveObserver(this->EndObserver);
    }
  }

  // Now, since another renderer's cullers write the same.
  void LookForCulling()
  {
    this->IsCulled = !(this->Actor && this->Actor->GetRenderTimeMultiplier() > 0.0);
  }

  // What was not drawn lately is not waited for, nor what has left the view.
  bool IsPending(unsigned long renders) const
  {
    return this->Renderer && this->Actor && this->Actor->GetVisibility() && !this->IsCulled &&
           std::any_of(this->Parts.begin(), this->Parts.end(),
             [renders](const auto& part)
             {
               const Progress& progress = part.second;
               return progress.Done < progress.Count && progress.Render + MostPasses > renders;
             });
  }

  void Free()
  {
    this->Parts.clear();
    this->Framebuffer = nullptr;
    BytesInUse -= this->Bytes;
    this->Bytes = 0;
  }

  // 0: of the samples' radiance, 1: of all else.
  vtkTextureObject* GetTexture(unsigned int which) const
  {
    return this->Framebuffer->GetColorAttachmentAsTextureObject(which);
  }

  // False: there is no room.
  bool Allocate(vtkOpenGLRenderWindow* window)
  {
    const int* size = this->Viewport + 2;
    if (this->Framebuffer && this->Window == window &&
        std::equal(size, size + 2, this->Framebuffer->GetLastSize()))
    {
      return true;
    }
    this->Free();
    const std::size_t bytes =
      BytesOfPixel * static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    if (bytes + BytesInUse > MostSumBytes)
    {
      return false;
    }
    this->Window = window;
    this->Framebuffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Bytes = bytes;
    BytesInUse += bytes;
    this->Framebuffer->SetContext(window);
    window->GetState()->PushFramebufferBindings();
    const bool works =
      this->Framebuffer->PopulateFramebuffer(size[0], size[1], true, 2, VTK_FLOAT, true, 24, 0);
    window->GetState()->PopFramebufferBindings();
    if (!works)
    {
      this->Free();
    }
    return works;
  }

  // Whether nobody may look at a part of the sum. Screenshots (vtkWindowToImageFilter) are seen by
  // a shallow copy of the camera, which shares its transforms.
  bool Waits() const
  {
    vtkRenderWindow* window = this->Renderer->GetRenderWindow();
    const int* tiles = window->GetTileScale();
    vtkRenderWindowInteractor* interactor = window->GetInteractor();
    vtkTransform* seen = this->Renderer->GetActiveCamera()->GetModelViewTransformObject();
    return seen->GetReferenceCount() > 1 || tiles[0] > 1 || tiles[1] > 1 ||
           !window->GetShowWindow() || window->GetUseOffScreenBuffers() ||
           !window->GetSwapBuffers() || !interactor || !interactor->GetEnabled();
  }

  // For the next picture; false: the interactor has none.
  bool StartTimer(SampleSums* sums)
  {
    vtkRenderWindowInteractor* interactor = this->Renderer->GetRenderWindow()->GetInteractor();
    if (this->Interactor != interactor)
    {
      this->RemoveTimer();
      this->Interactor = interactor;
      this->Sums = sums;
      this->Observer = interactor->AddObserver(vtkCommand::TimerEvent, this, &View::GoOn);
    }
    this->Timer = this->Timer != 0 ? this->Timer : interactor->CreateOneShotTimer(Pause);
    return this->Timer != 0;
  }

  void GoOn(vtkObject*, unsigned long, void* timer)
  {
    if (timer && *static_cast<int*>(timer) == this->Timer)
    {
      this->Timer = 0;
      if (this->IsPending(this->Sums->Renders))
      {
        this->Interactor->Render(); // *this may be gone then
      }
    }
  }

  void RemoveTimer()
  {
    if (this->Interactor)
    {
      this->Interactor->RemoveObserver(this->Observer);
    }
    this->Timer = 0;
  }

  // Seconds that this actor has in a frame: its share of them, as VTK allots it. Actors inside of
  // others are allotted nothing and have VTK's default, which may be longer than the frame.
  double GetBudget() const
  {
    const double rate = std::max(this->Renderer->GetRenderWindow()->GetDesiredUpdateRate(), 1e-4);
    return std::min(this->Actor->GetAllocatedRenderTime() * rate, 1.0) *
           std::min(LongestFrame, 1.0 / rate);
  }
};

SampleSums::SampleSums() = default;

SampleSums::~SampleSums() = default;

void SampleSums::Begin()
{
  this->Start = Clock::now();
  ++this->Renders;
}

SampleSums::View& SampleSums::FindView(const SummedPart& part)
{
  const bool isLeft = part.Renderer->GetActiveCamera()->GetLeftEye() != 0;
  this->Views.remove_if([](const View& view) { return !view.Renderer || !view.Actor; });
  for (View& view : this->Views)
  {
    if (view.Renderer == part.Renderer && view.Actor == part.Actor && view.IsLeft == isLeft)
    {
      return view;
    }
  }
  View& view = this->Views.emplace_back();
  view.Renderer = part.Renderer;
  view.Actor = part.Actor;
  view.IsLeft = isLeft;
  view.EndObserver = part.Renderer->AddObserver(vtkCommand::EndEvent, &view, &View::LookForCulling);
  return view;
}

bool SampleSums::IsConcerned(const std::vector<DrawnMaterial>& materials) const
{
  return !materials.empty() && (CountSamples(materials) > 1 || !this->Views.empty());
}

void SampleSums::Add(const SummedPart& part, const std::vector<DrawnMaterial>& materials,
  const std::function<void()>& draw)
{
  const int samples = CountSamples(materials);
  View& view = this->FindView(part);
  if (samples < 2)
  {
    view.Parts.erase(part.Who);
    if (view.Parts.empty())
    {
      view.Free();
    }
    return;
  }
  view.Seconds.erase(part.Who); // until it is known of this picture
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(part.Renderer->GetRenderWindow());
  bool waits = view.Waits();
  if (!MayAdd(part) ||
      (waits && !view.Framebuffer && !window->HasObserver(vtkCommand::AbortCheckEvent)))
  {
    return;
  }
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, view.Viewport);
  if (!HasRoom(materials, window) || !view.Allocate(window))
  {
    return;
  }
  std::vector<double> viewKey = GetViewKey(part, view.Viewport);
  std::vector<double> key = GetKey(part, materials);
  const auto known = view.Parts.find(part.Who);
  if (view.Key != viewKey || (known != view.Parts.end() && known->second.Key != key))
  {
    view.Parts.clear();
  }
  const bool isFirst = view.Parts.empty();
  View::Progress& progress = view.Parts[part.Who];
  view.Key = std::move(viewKey);
  progress.Key = std::move(key);
  progress.Count = samples;
  progress.Render = this->Renders;
  if (progress.Done < progress.Count)
  {
    waits = waits || !view.StartTimer(this);
    const double budget = view.GetBudget();
    Target target(window->GetState(), view.Framebuffer, view.Viewport);
    if (isFirst)
    {
      target.Clear();
    }
    const auto drawStage = [&](SumStage stage)
    {
      this->Stage = stage;
      target.Prepare(stage);
      draw();
    };
    try
    {
      for (bool goesOn = true; goesOn;)
      {
        const auto begin = Clock::now();
        const int next = progress.GetNext(std::min(budget, LongestSubframe));
        this->Samples = { static_cast<float>(progress.Done),
          static_cast<float>(progress.Done + next), static_cast<float>(progress.Count) };
        if (progress.Done == 0)
        {
          drawStage(SumStage::Others);
        }
        progress.Done += next;
        drawStage(SumStage::Add);
        window->WaitForCompletion();
        const auto end = Clock::now();
        const double seconds = std::chrono::duration<double>(end - begin).count();
        progress.PerSample = seconds / next;
        progress.Seconds += seconds;
        const std::chrono::duration<double> taken = end - this->Start;
        goesOn = progress.Done < progress.Count && (waits || taken.count() < budget);
        if (goesOn) // VTK's own CheckAbortStatus asks five times a second at most
        {
          window->InvokeEvent(vtkCommand::AbortCheckEvent);
          goesOn = !window->GetAbortRender();
        }
        if (!view.Framebuffer) // whoever was asked had all released
        {
          this->Stage = SumStage::None;
          return;
        }
      }
    }
    catch (...)
    {
      view.Parts.clear(); // what was drawn of the sub-frame stays there
      throw;
    }
  }
  view.Seconds[part.Who] = progress.Seconds + (progress.Count - progress.Done) * progress.PerSample;
  view.GetTexture(0)->Activate();
  view.GetTexture(1)->Activate();
  this->Shown = &view;
  this->Stage = SumStage::Show;
}

void SampleSums::End()
{
  if (this->Shown && this->Shown->Framebuffer)
  {
    this->Shown->GetTexture(0)->Deactivate();
    this->Shown->GetTexture(1)->Deactivate();
  }
  this->Shown = nullptr;
  this->Stage = SumStage::None;
}

void SampleSums::SetUniforms(vtkShaderProgram* program) const
{
  if (this->Stage == SumStage::Add)
  {
    program->SetUniform3f("brdfPart", this->Samples.data());
  }
  else if (this->Stage == SumStage::Show)
  {
    program->SetUniformi("brdfSum", this->Shown->GetTexture(0)->GetTextureUnit());
    program->SetUniformi("brdfOthers", this->Shown->GetTexture(1)->GetTextureUnit());
    program->SetUniform2i("brdfSumOrigin", this->Shown->Viewport);
  }
}

bool SampleSums::IsPending() const
{
  return std::any_of(this->Views.begin(), this->Views.end(),
    [this](const View& view) { return view.IsPending(this->Renders); });
}

bool SampleSums::HasTime(vtkRenderer* renderer, vtkActor* actor, const void* who) const
{
  return std::any_of(this->Views.begin(), this->Views.end(),
    [&](const View& view)
    {
      double seconds = 0.0;
      for (const auto& part : view.Seconds)
      {
        seconds += part.second;
      }
      return view.Renderer == renderer && view.Actor == actor && view.Seconds.count(who) > 0 &&
             seconds < view.GetBudget();
    });
}

void SampleSums::Forget(const void* who)
{
  for (View& view : this->Views)
  {
    view.Seconds.erase(who);
    if (view.Parts.count(who) > 0)
    {
      view.Parts.clear(); // it hides others there
    }
  }
}

void SampleSums::Release(vtkWindow* window)
{
  for (View& view : this->Views)
  {
    if (!window || view.Window == window)
    {
      view.Free();
    }
  }
}
} // namespace measuredbrdf
