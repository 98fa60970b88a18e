// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeasuredBRDFMapper
 * @brief   draws polydata made of a measured material, lit by an environment and the scene's lights
 *
 * Use it where vtkPolyDataMapper stood: give it a vtkBRDF, and the surface reflects the renderer's
 * environment texture (vtkRenderer::SetEnvironmentTexture, the one that VTK's own physically based
 * rendering uses, lat-long or cube map; UseImageBasedLighting need not be on) or an environment of
 * its own, plus the renderer's vtkLights, but not the headlight that VTK creates where there are
 * none. The environment's light is integrated as planned for an error tolerance
 * (vtkRadiancePlanner), or over a set of directional lights made from it (O'Toole 2007).
 *
 * - A vtkLight of color c and intensity k gives irradiance k c on a surface that faces it, as in
 *   VTK's PBR: a white Lambert surface then shows k c / pi.
 * - Output is radiance^(1/2.2), as VTK's PBR writes it; vtkToneMappingPass expects that.
 * - Of vtkProperty, opacity, edges (tubes too), culling, representation, back faces, line width and
 *   point size count, as with the superclass. Its colors and their coefficients, Phong's and PBR's
 *   parameters have no effect, nor have PBR's textures, but for the normal map (with
 *   VTK_PBR and tangents); the mapper says so once.
 * - Scalars, colors of blocks and an actor's texture multiply the radiance. Their values are
 *   display colors, made linear as c^2.2; a texture with UseSRGBColorSpace is linear already. The
 *   property's Diffuse does not count.
 * - Clipping planes, picking, coincident topology: as the superclass. Points, lines, wireframe, and
 *   actors with vtkProperty::Lighting off are left to the superclass.
 * - A program's own replacement of the tag VTK::Light::Impl may read `vec3 diffuse` (the encoded
 *   color, edges included), `vec3 specular` (0), `brdfRadiance` (linear) and `normalVCVSOutput`,
 *   after the tag has been written back, with replaceFirst false:
 *   @code
 *   "//VTK::Light::Impl\n gl_FragData[0] = vec4(diffuse, opacity);"
 *   @endcode
 * - Without a material it is the superclass.
 * - Anisotropic materials use the polydata's float point tangents (PointData::SetTangents), which
 *   turn and stretch with the actor; without them the tangent turns about the environment's up
 *   axis, with a warning.
 * - In several viewports or windows, each is drawn by a plan for its own light. Selection, shadow
 *   maps and other passes that show no color neither plan nor upload, and draw as the superclass.
 * - Composite data sets: vtkCompositeMeasuredBRDFMapper.
 *
 * The setters below do not call Modified(): that would rebuild vertex buffers and shaders. What
 * they set shows at the next Render. Changing the material's parameters, the environment or the
 * number of lights costs no new vertex buffers, and no shader rebuild unless the plan changes;
 * rotating the environment costs nothing. Mappers that share a BRDF share its textures; mappers
 * that share an environment share its light sets, and plans if they share both.
 */

#ifndef vtkMeasuredBRDFMapper_h
#define vtkMeasuredBRDFMapper_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkOpenGLPolyDataMapper.h"

#include <map>    // for shaders
#include <memory> // for Internals
#include <string> // for descriptions

class vtkBRDF;
class vtkDataArray;
class vtkEnvironment;
class vtkMaterialMap;
class vtkProperty;
class vtkRadianceIntegrator;
class vtkRadiancePlanner;

class VTKMEASUREDBRDF_EXPORT vtkMeasuredBRDFMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkMeasuredBRDFMapper* New();
  vtkTypeMacro(vtkMeasuredBRDFMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material; null (default): draw as the superclass does.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF();
  ///@}

  ///@{
  /**
   * Which material each place of the surface is made of, by an array of the data; null (default):
   * all of it is of BRDF. With a map, BRDF is the material of the places that the map says nothing
   * of. A class map costs about what one material costs. Each material has a plan of its own.
   * Scalars that choose the material do not color it. A map that does not fit the data is reported
   * once, and BRDF is drawn.
   */
  void SetMaterialMap(vtkMaterialMap* map);
  vtkMaterialMap* GetMaterialMap();
  ///@}

  ///@{
  /**
   * An environment for this mapper alone; null (default): the renderer's environment texture. The
   * environment's own rotation comes on top of the renderer's EnvironmentUp and EnvironmentRight.
   */
  void SetEnvironment(vtkEnvironment* environment);
  vtkEnvironment* GetEnvironment();
  ///@}

  ///@{
  /**
   * What integrates the environment's light. Null (default): what vtkRadiancePlanner plans for the
   * material, the environment and the error tolerance, mostly a table of radiance that costs about
   * as much as VTK's own PBR. Planning takes some tenths of a second (seconds for mirror-like
   * materials) before the first frame and after a change of the material or the environment (its
   * rotation is none), see SetPlanningMode.
   *
   * Any other integrator draws the same pixels as its Integrate gives. The mapper never changes it.
   * Where it has this mapper's material and environment, it is drawn with what it has prepared;
   * else a copy with its properties is, which mappers with the same material and environment share.
   * Its own environment counts where the mapper and the renderer have none.
   */
  void SetIntegrator(vtkRadianceIntegrator* integrator);
  vtkRadianceIntegrator* GetIntegrator();
  ///@}

  ///@{
  /**
   * Where plans are made: relative L1 error over a sphere to stay below where that is possible
   * (default 0.02, in [1e-3, 1]).
   */
  void SetErrorTolerance(double tolerance);
  double GetErrorTolerance();
  ///@}

  ///@{
  /**
   * What a pixel of a planned method may cost, times a table's (vtkRadiancePlanner::SetMaximumCost;
   * default 150, in [1, 1e6]). GetPlan says what was given up for it.
   */
  void SetMaximumCost(double cost);
  double GetMaximumCost();
  ///@}

  /**
   * What was planned for the last render, with its predicted error, its size and why; "" if there
   * was no plan.
   */
  std::string GetPlan();

  enum PlanningModeType
  {
    FOREGROUND = 0,
    BACKGROUND = 1,
    BACKGROUND_FROM_START = 2
  };

  ///@{
  /**
   * When plans are made.
   * - FOREGROUND (default): Render plans, so every picture is of what is set. Plans of several
   *   materials of a map or of blocks are made side by side, on all cores.
   * - BACKGROUND: the first Render plans. After a change of the material, the environment, the
   *   tolerance or the maximum cost, a thread plans, and pictures stay as they were until a Render
   *   finds the new plan made. (The first change after a plan in the FOREGROUND is waited for.)
   * - BACKGROUND_FROM_START: a thread makes the first plan, too. Until then a small table stands in
   *   for it (vtkHybridRadianceIntegrator, of 65 rows); 64 lights for anisotropic materials.
   *
   * A mapper does not render by itself when a plan is ready. Interactive programs choose BACKGROUND
   * and render in a timer of their event loop where GetPlanReady(). Threads work on snapshots
   * (vtkBRDF::NewSnapshot): Render plans for a material that has none. The destructor stops the
   * thread and waits for that.
   */
  void SetPlanningMode(int mode);
  int GetPlanningMode();
  void SetPlanningModeToForeground() { this->SetPlanningMode(FOREGROUND); }
  void SetPlanningModeToBackground() { this->SetPlanningMode(BACKGROUND); }
  void SetPlanningModeToBackgroundFromStart() { this->SetPlanningMode(BACKGROUND_FROM_START); }
  ///@}

  ///@{
  /**
   * Whether to plan for what the camera sees instead of for every view (default off).
   * Candidates are then checked on the normals and views of the first picture after this was set,
   * in proportion to the pixels that show them: flat objects get cheaper plans. The plan stays
   * when the camera or the object moves; set it again to plan for what is seen then.
   */
  void SetPlanForView(bool view);
  bool GetPlanForView();
  void PlanForViewOn() { this->SetPlanForView(true); }
  void PlanForViewOff() { this->SetPlanForView(false); }
  ///@}

  /**
   * What PlanForView sees of an actor that this mapper draws: unit normals and unit directions to
   * the camera (as many of both, resized to 3 components), in proportion to the pixels that
   * show them, ready for vtkRadiancePlanner::SetPairs. None where nothing is in view.
   */
  void GetVisiblePairs(
    vtkRenderer* renderer, vtkActor* actor, vtkDataArray* normals, vtkDataArray* views);

  ///@{
  /**
   * A Render that plans for this mapper raises ProgressEvent meanwhile. Set AbortPlanning from its
   * observer to stop the planning of all of its materials: what stands in for plans in
   * BACKGROUND_FROM_START is drawn then, with an error event for each, until something changes.
   * Each Render begins with it cleared.
   */
  void SetAbortPlanning(bool abort);
  bool GetAbortPlanning();
  ///@}

  ///@{
  /**
   * Whether the last Render showed another plan than was asked for, since that is still being made;
   * whether it is made now and the next Render takes it up, which raises
   * vtkCommand::UpdateDataEvent. Both are true, too, while samples (vtkFilteredRadianceIntegrator)
   * add up: in a window that is shown and has an interactor, each Render draws some of them for at
   * most half a second or the frame's time (vtkRenderWindow::SetDesiredUpdateRate), and a timer of
   * the interactor renders the next ones. Everywhere else a Render draws all. It stops early where
   * an observer of AbortCheckEvent calls SetAbortRender, and the next one goes on.
   */
  bool GetPlanPending();
  bool GetPlanReady();
  ///@}

  /**
   * Set a property to VTK's physically based shading with the usual values that come nearest to the
   * material under a neutral light (vtkPBRPropertyFitter, UsualValues), for what draws the property
   * and not the material: exporters, OSPRay, ANARI, glyphs, levels of detail. Returns the relative
   * L1 error of that; negative, with the property as it was, where there is no material or no
   * property.
   */
  double FitProperty(vtkProperty* property);

  enum ScalarColoringModeType
  {
    IGNORE_SCALARS = 0,
    MODULATE = 1
  };

  ///@{
  /**
   * What scalar colors do to the material: multiply it (default; colors are taken as display
   * colors and made linear) or nothing. Without scalars the property's colors have no effect.
   */
  void SetScalarColoringMode(int mode);
  int GetScalarColoringMode();
  ///@}

  ///@{
  /**
   * Whether the renderer's vtkLights light the material beside the environment (default on). Off is
   * for hosts whose own lights stand for an environment, such as ParaView's and PyVista's light
   * kits. The headlight that VTK creates in a renderer without lights
   * (vtkRenderer::AutomaticLightCreation) lights the material only where there is no environment.
   */
  void SetUseSceneLights(bool use);
  bool GetUseSceneLights();
  void UseSceneLightsOn() { this->SetUseSceneLights(true); }
  void UseSceneLightsOff() { this->SetUseSceneLights(false); }
  ///@}

  enum OcclusionModeType
  {
    OCCLUSION_OFF = 0,
    OCCLUSION_AUTO = 1,
    OCCLUSION_ON = 2,
    OCCLUSION_ARRAYS = 3
  };

  ///@{
  /**
   * Whether the surface hides the environment from itself.
   * - OCCLUSION_OFF: never.
   * - OCCLUSION_ARRAYS: where it has the point arrays of vtkSurfaceVisibilityFilter.
   * - OCCLUSION_ON: always. Where there are no arrays, the first Render and each one after a change
   *   of the surface run that filter (seconds for half a million triangles).
   * - OCCLUSION_AUTO (default): where it has the arrays, and where a plan is made and the predicted
   *   error of leaving occlusion out exceeds what the tolerance leaves
   *   (vtkOcclusionPredictor::IsWorthModeling): before the frame for up to 20,000 points (2 s of a
   *   core), on a thread for up to two million where plans are made in the background, else not.
   *   GetPlan then ends with "unoccluded light: 9 % on this surface (+- 2 %), modeled". A surface
   *   that changes in each of four frames is drawn without until it rests; one that a material map
   *   divides, always.
   *
   * Of composite data, blocks that have the arrays keep them; GetPlan says how many have some.
   * Arrays of another surface, or damaged ones, are reported once and not used. vtkLights are not
   * hidden: vtkShadowMapPass does that. Methods that tell a material's matte part and its lobe
   * apart (table, hybrid; what plans choose) are the most accurate.
   */
  void SetOcclusionMode(int mode);
  int GetOcclusionMode();
  void SetOcclusionModeToOff() { this->SetOcclusionMode(OCCLUSION_OFF); }
  void SetOcclusionModeToAuto() { this->SetOcclusionMode(OCCLUSION_AUTO); }
  void SetOcclusionModeToOn() { this->SetOcclusionMode(OCCLUSION_ON); }
  void SetOcclusionModeToArrays() { this->SetOcclusionMode(OCCLUSION_ARRAYS); }
  ///@}

  ///@{
  /**
   * Whether what the surface hides from itself sends light back: one bounce (default off: hidden
   * parts of the sky are black), which nearly doubles the time of tracing. Arrays of a program need
   * vtkSurfaceVisibilityFilter::BounceOn, which is reported once where it is missing. What hides is
   * taken to be matte, of the point's own material and albedo. GetPlan ends with "one bounce
   * modeled" where any part has the arrays.
   */
  void SetOcclusionBounce(bool bounce);
  bool GetOcclusionBounce();
  void OcclusionBounceOn() { this->SetOcclusionBounce(true); }
  void OcclusionBounceOff() { this->SetOcclusionBounce(false); }
  ///@}

  ///@{
  /**
   * About the last render: the integrator that was drawn (null before the first render or without
   * an environment) and the planner that chose it (null without a plan), neither to be changed;
   * bytes of the textures in use (material and lights).
   */
  vtkRadianceIntegrator* GetCurrentIntegrator();
  vtkRadiancePlanner* GetCurrentPlanner();
  vtkIdType GetTextureBytes();
  ///@}

  ///@{
  /**
   * As the superclass. Composite data, which this mapper draws nothing of, as vtkPolyDataMapper
   * does, are met here first: a warning, once, names the mapper for them.
   */
  double* GetBounds() VTK_SIZEHINT(6) override;
  void GetBounds(double bounds[6]) override { this->Superclass::GetBounds(bounds); }
  ///@}

  void RenderPiece(vtkRenderer* ren, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  void ShallowCopy(vtkAbstractMapper* m) override;

  /**
   * Also when anything last changed that the picture depends on: the material, the environment, the
   * light set, the integrator or a property of this mapper, or a plan made in the background. Views
   * that draw only what changed (vtkProp::GetRedrawMTime) therefore draw anew; vertex buffers and
   * shaders are not rebuilt for it.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkMeasuredBRDFMapper();
  ~vtkMeasuredBRDFMapper() override;

  ///@{
  /// The steps of the superclass in which a material takes part.
  void RenderPieceStart(vtkRenderer* ren, vtkActor* actor) override;
  void RenderPieceDraw(vtkRenderer* ren, vtkActor* actor) override;
  void RenderPieceFinish(vtkRenderer* ren, vtkActor* actor) override;
  bool GetNeedToRebuildBufferObjects(vtkRenderer* ren, vtkActor* actor) override;
  void BuildBufferObjects(vtkRenderer* ren, vtkActor* actor) override;
  bool GetNeedToRebuildShaders(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderLight(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  void SetPropertyShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  ///@}

private:
  vtkMeasuredBRDFMapper(const vtkMeasuredBRDFMapper&) = delete;
  void operator=(const vtkMeasuredBRDFMapper&) = delete;

  bool RenderParts(vtkRenderer* ren, vtkActor* actor);

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
