// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a mapper that users know draws with: its properties and, for each frame, the light, the
 * plan and the textures of each material. MaterialShading makes shader text and uniforms of them.
 */

#ifndef MaterialDrawing_h
#define MaterialDrawing_h

#include "AutomaticOcclusion.h"
#include "DrawnMaterial.h"
#include "MapperPlans.h"
#include "MaterialSettings.h"
#include "OcclusionArrays.h"
#include "OcclusionLight.h"
#include "OcclusionShader.h"
#include "SampleSums.h"
#include "SurfaceBlocks.h"
#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

class vtkDataArray;
class vtkOpenGLRenderWindow;
class vtkPolyData;
class vtkRadiancePlanner;
class vtkShaderProgram;
class vtkWindow;

namespace measuredbrdf
{
class MaterialDrawing
{
public:
  /// owner: the mapper that users know, which warns and reports errors. toCome: the materials of a
  /// map that it will draw next, as far as it knows between its renders.
  MaterialDrawing(vtkMapper* owner, std::function<std::vector<vtkBRDF*>()> toCome);
  ~MaterialDrawing();
  MaterialDrawing(const MaterialDrawing&) = delete;
  void operator=(const MaterialDrawing&) = delete;

  vtkMapper* GetOwner() const { return this->Owner; }

  /// The owner's warning event, the first time for that cause.
  void WarnOnce(const std::string& cause, const std::string& text);

  /// Report at the end of this Render what can't be drawn as it should be.
  void AddFailure(const std::string& text) { this->Failures.insert(text); }

  MaterialSettings& GetSettings() const { return *this->Settings; }

  /// A mapper's Render: draw begins and ends a frame for each part. What fails is one error event
  /// of the mapper. The same error is reported again after a Render without it. styleTime: when
  /// what says which blocks are seen last changed.
  void Render(vtkRenderer* renderer, vtkActor* actor, const std::function<void()>& draw,
    vtkMTimeType styleTime = 0);

  /// Do a step of a Render. Returns false where it threw, which becomes a failure of the Render:
  /// VTK catches nothing.
  bool Try(const std::function<void()>& step);

  /// Get ready to draw a part of a frame: bring plans and textures up to date. In passes that take
  /// no color from the material (picking, shadow maps) VTK's class draws, and nothing is planned.
  /// part: which of the mappers that share this object draws. brdfs: its materials; null: VTK's
  /// class draws.
  void BeginFrame(
    vtkRenderer* renderer, vtkActor* actor, const void* part, const std::vector<vtkBRDF*>& brdfs);
  void EndFrame();

  /// Add samples up before the frame is drawn (SampleSums), between BeginFrame and EndFrame.
  void AddSamples(
    vtkRenderer* renderer, vtkActor* actor, const void* part, const std::function<void()>& draw);
  const SampleSums& GetSums() const { return this->Sums; }

  /// The materials that BeginFrame was given, to be drawn one after the other. None where VTK's
  /// class draws all.
  const std::vector<DrawnMaterial>& GetMaterials() const;

  ///@{
  /// Draw with one material from now on; with several, mixed as the text says; with none.
  void Select(std::size_t material);
  void SelectMixture(const std::vector<std::size_t>& materials, MixtureText text);
  void Unselect() { this->Selected.Clear(); }
  ///@}

  /// The materials that are drawn with now. None where VTK's class draws.
  const SelectedMaterials& GetSelected() const { return this->Selected; }

  ///@{
  /// For surfaces that hide the sky from themselves (SetOcclusionMode): the attributes of one that
  /// is drawn, null where it has none; of a material, null without an environment. isPart: of a
  /// surface that a material map divides. Both stay valid until the next frame.
  /// part: who draws it.
  std::shared_ptr<OcclusionArrays> FindOcclusion(
    vtkPolyData* surface, const void* part, bool isPart);
  /// Before those that a part's new buffers ask for.
  void BeginOcclusion(const void* part) { this->BouncingParts.erase(part); }
  const OcclusionLight* FindOcclusionLight(const DrawnMaterial& drawn);
  /// What FindWhole found last.
  struct WholeSurface
  {
    vtkSmartPointer<vtkPolyData> Traced;
    vtkMTimeType Time = 0; // of the surface
    vtkSmartPointer<vtkPolyData> Data;
  };
  /// Of a surface that a material map will divide: itself, or with the arrays that it has to have
  /// (SetOcclusionModeToOn). The same object while nothing changes.
  vtkPolyData* FindWhole(vtkPolyData* surface, WholeSurface& last);
  /// What was traced for a part because it is worth that, or for all of them because the mode says
  /// so (AutomaticOcclusion); null: nothing.
  vtkDataObject* GetTracedOcclusion(const void* part);
  /// Of the selected materials; none where nothing is hidden. any: whether the buffers have some.
  OcclusionLights GetSelectedOcclusion(bool any);
  ///@}

  ///@{
  /// About the last frame of all parts.
  std::vector<const DrawnMaterial*> GetLastFrame() const;
  /// Whether a plan, what is traced beside it, or a sum of samples is in the making; whether the
  /// next Render takes it up.
  bool IsPending() const;
  bool IsReady() const;
  /// What leaving occlusion out costs and whether it is left out, as a line of a plan; or "".
  std::string DescribeOcclusion() const;
  ///@}

  /// What PlanForView sees of all surfaces to come: normals and as many views, ready for
  /// vtkRadiancePlanner::SetPairs.
  void GetVisiblePairs(
    vtkRenderer* renderer, vtkActor* actor, vtkDataArray* normals, vtkDataArray* views);

  ///@{
  /// Stop the planning of all materials that a Render has begun. Each Render clears it first.
  void SetAbortPlanning(bool abort) { this->AbortPlanning = abort; }
  bool GetAbortPlanning() const { return this->AbortPlanning; }
  ///@}

  /// When anything last changed that the next picture depends on.
  vtkMTimeType GetAppearanceMTime();

  /// Forget what a part has on this window's graphics card.
  void ReleaseGraphicsResources(vtkWindow* window, const void* part);

  /// A part that draws no more.
  void Forget(const void* part);

  /// Drop plans in the making that nothing to come is drawn by, and all plans of materials that the
  /// mapper does not have any more.
  void KeepPlansInUse();

private:
  /// What a part was last drawn with in a renderer.
  struct ViewFrame
  {
    vtkWeakPointer<vtkRenderer> Renderer;
    std::vector<DrawnMaterial> Materials;
  };

  /// What all materials of a frame have in common.
  struct FrameState
  {
    vtkRenderer* Renderer;
    vtkActor* Actor;
    vtkSmartPointer<vtkEnvironment> Environment; // null: there is none
    bool Hurries = false; // one interacts, and samples are not known to be drawn in a frame's time
  };

  /// As plans know a material (PlanRequest::Member).
  vtkBRDF* GetMember(vtkBRDF* brdf) const { return brdf == this->Settings->BRDF ? nullptr : brdf; }
  PlanRequest GetRequest(vtkBRDF* brdf, const FrameState& state);
  void Look(const FrameState& state);
  bool IsPlanned() const { return !this->Settings->Integrator; }
  void DropPlans(const FrameState& state, bool anyMaterial);
  void DropOcclusionLights();
  void ForecastOcclusion(const FrameState& state, const void* part, const ViewFrame& frame);
  void UpdateForecast(const void* part, const OcclusionQuestion& question);
  vtkPolyData* FindTraced(vtkPolyData* surface, const void* part);
  ViewFrame& FindFrame(vtkRenderer* renderer, const void* part);

  ///@{
  /// The stages of a frame, in this order; the last three for each material.
  vtkSmartPointer<vtkEnvironment> ResolveEnvironment(vtkRenderer* renderer);
  void ResolveAll(ViewFrame& frame, const FrameState& state, const std::vector<vtkBRDF*>& brdfs);
  DrawnMaterial Resolve(vtkBRDF* brdf, const FrameState& state);
  void ResolveIntegrator(DrawnMaterial& drawn, const FrameState& state);
  /// Whether one is being made.
  bool ResolvePlan(DrawnMaterial& drawn, const FrameState& state);
  std::string UploadInputs(DrawnMaterial& drawn, vtkRenderer* renderer);
  ///@}

  // First, so that it is the last to go: what the others held is released then.
  struct SweepAtEnd
  {
    SweepAtEnd() = default;
    ~SweepAtEnd();
    SweepAtEnd(const SweepAtEnd&) = delete;
    void operator=(const SweepAtEnd&) = delete;
  };
  SweepAtEnd AtEnd;

  vtkMapper* const Owner;
  std::set<std::string> Warned;
  std::set<std::string> Failures;                                 // of this Render
  std::map<std::string, std::pair<vtkRenderer*, vtkActor*>> Said; // and whose Render had it last
  std::unique_ptr<MaterialSettings> Settings = std::make_unique<MaterialSettings>();
  std::function<std::vector<vtkBRDF*>()> ToCome;
  MapperPlans Plans;
  /// Of parts and renderers. Each keeps its textures for the next Render.
  std::map<std::pair<const void*, vtkRenderer*>, ViewFrame> Frames;
  std::shared_ptr<const VisibleSurface> Seen; // what PlanForView plans for
  vtkTimeStamp SeenTime;
  using ViewStamp = std::tuple<vtkRenderer*, vtkMTimeType, vtkMTimeType>; // camera, actor
  ViewStamp SeenIn;                                                       // only compared
  const ViewFrame* Frame = nullptr;                                       // drawn now
  vtkWeakPointer<vtkRenderer> LastRenderer;
  SelectedMaterials Selected;
  SampleSums Sums;
  vtkMTimeType StyleTime = 0;
  std::atomic<bool> AbortPlanning{ false };
  struct KnownLight
  {
    vtkMTimeType Time;
    std::unique_ptr<OcclusionLight> Light;
  };
  std::map<vtkSmartPointer<vtkRadianceIntegrator>, KnownLight> KnownLights;
  BlockPairs TracedBlocks;
  bool IsTraceCurrent = false; // of this Render, where the mode says to trace
  struct GivenOcclusion
  {
    std::size_t Blocks = 0; // with arrays of whoever made them
    std::size_t All = 0;
  };
  GivenOcclusion Given; // with the surfaces of the last frame
  /// Of parts; null: of all of them, where the mode says to trace.
  std::map<const void*, std::unique_ptr<AutomaticOcclusion>> Forecasts;
  std::set<const void*> BouncingParts; // whose buffers have what comes back
  bool WasReady = false;               // whether a plan made in the background waited to be drawn
  vtkTimeStamp ReadyTime;
};
} // namespace measuredbrdf

#endif
