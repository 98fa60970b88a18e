// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A window off screen that one mesh is rendered in, into a float picture: with a measured material,
 * or with VTK's own physically based shading.
 */

#ifndef Scenes_h
#define Scenes_h

#include "Inputs.h"
#include "Methods.h"
#include "Picture.h"
#include "Surface.h"

#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

class vtkActor;
class vtkCamera;
class vtkEnvironment;
class vtkFramebufferPass;
class vtkImageData;
class vtkRadianceIntegrator;
class vtkRenderWindow;

namespace tool
{
/// Lets a camera look at the middle of a mesh from an azimuth (about +y, 0 = from +z, 90 = from +x)
/// and an elevation above the horizon, with a vertical angle of view. fill: share of the picture's
/// smaller side that the mesh's bounding sphere takes; aspect: the picture's width over its height.
void PlaceCamera(
  vtkCamera* camera, vtkPolyData* mesh, const View& view, double fill, double aspect);

/// A window off screen that one mesh is rendered in, into a float picture.
class OffscreenScene
{
public:
  /// The mapper draws the mesh. No lights.
  explicit OffscreenScene(vtkOpenGLPolyDataMapper* mapper);
  virtual ~OffscreenScene();
  OffscreenScene(const OffscreenScene&) = delete;
  void operator=(const OffscreenScene&) = delete;

  void SetMesh(vtkPolyData* mesh);

  /// Look at the mesh as tool::PlaceCamera says.
  void SetView(const View& view, double fill);

  /// Look as that camera (perspective) does instead; null: as SetView says. Not copied.
  void SetCamera(vtkCamera* camera);

  /// Point the camera for a picture of that size; Render does so itself. GetRay needs it.
  void PlaceCamera(int width, int height);

  /// Radiance per pixel, alpha 0 where there is no mesh. Throws Error.
  Picture Render(int width, int height);

  /// Time of one frame of the size that was rendered last, in milliseconds, until the last pixel is
  /// done.
  double TimeFrame();

  /// Open the window and render nothing, so that a context's own start is over; then TimeFrame
  /// may follow.
  void Open(int width, int height);

  /// World direction that pixel (x, y) of a picture of the given size looks along.
  glm::dvec3 GetRay(double x, double y, int width, int height) const;

  /// The camera that PlaceCamera placed.
  vtkCamera* GetCamera() const { return this->Renderer->GetActiveCamera(); }

  std::string GetRendererName();

  /// What follows that name, such as "OpenGL version string", in what the driver says of itself.
  std::string GetCapability(const std::string& name);

protected:
  /// Render with the camera as it is; what the shader wrote, as it is. Throws Error.
  Picture Capture(int width, int height);

  /// x^(1/2.2) -> x, of colors, in this scene's unit.
  void Decode(Picture& picture) const;

  double Unit = 1.0; // of what is drawn: radiance is so many times as much
  vtkSmartPointer<vtkOpenGLPolyDataMapper> StageMapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;

private:
  vtkNew<vtkFramebufferPass> Pass;
  vtkNew<vtkRenderWindow> Window;
  vtkSmartPointer<vtkCamera> Camera; // of SetCamera
  View Seen = { 0.0, 0.0 };
  double Fill = 0.9;
};

/// Light for VTK's own shading, which keeps half floats of it: the map in units of about its mean
/// radiance, a power of two, which changes no digit.
struct StockLight
{
  explicit StockLight(vtkEnvironment* environment);

  double Unit = 1.0;
  vtkSmartPointer<vtkImageData> Image;
};

struct StockMaterial
{
  double Roughness = 0.5;
  double Metallic = 0.0;
  std::array<double, 3> Albedo = { 0.5, 0.5, 0.5 }; // linear
};

/// The mesh as VTK draws it by itself: physically based shading under image-based lighting.
class StockScene : public OffscreenScene
{
public:
  StockScene();

  void SetLight(vtkEnvironment* environment);
  void SetMaterial(const StockMaterial& material);

  /**
   * The material of least mean |x - r| against a reference of the surface's pixels (3 doubles
   * each): a search over roughness and metallic, coarse then fine; for each, the best albedo of
   * each channel. Sets it, too. Throws Error.
   */
  StockMaterial Fit(const Surface& surface, const Size& size, const std::vector<double>& reference);

  /// What the environment and VTK's tables of it take on the GPU, once something was rendered: half
  /// floats but for the environment, with their levels.
  std::size_t GetTextureBytes();

private:
  /// Sets the material's albedo to the best one and returns what is left: the sum of |x - r|.
  double FitAlbedo(StockMaterial& material, const Surface& surface, const Size& size,
    const std::vector<double>& reference);

  double ColorExponent = 1.0; // albedo = color^this: a property's color may be the display's
};

/// Radiance of a surface's pixels in a picture, 3 doubles each.
std::vector<double> Pick(const Picture& picture, const Surface& surface);

class ProgressBar;

/// The mesh with one measured material.
class Scene : public OffscreenScene
{
public:
  Scene();
  ~Scene() override;

  /// The environment and what integrates it; null: what the mapper plans. Planning shows a progress
  /// bar, and Ctrl-C stops it where there is an Interruptible.
  void SetLight(vtkEnvironment* environment, vtkRadianceIntegrator* integrator);

  /// Draw a first frame of the size that is open. Of a planned method, its integrator and its
  /// planner are those that were drawn. Throws Error.
  void Begin(Method& method, vtkEnvironment* environment, const PlanOptions& options);

  /// Draw with the method that Begin has found, and with what the mesh hides as in that frame, also
  /// where the picture's size would be planned for anew.
  void HoldPlan(const Method& method, vtkEnvironment* environment);

  /// What a picture of that size shows, as the mapper plans for it.
  void Look(int width, int height, VisiblePairs& seen);

  /// What draws the mesh. It models what the mesh hides unless it is told not to. References have
  /// nothing hidden: what is compared with them is drawn with OCCLUSION_OFF.
  const vtkSmartPointer<vtkMeasuredBRDFMapper> Mapper;

private:
  void OnProgress(vtkObject*, unsigned long, void* share);

  std::unique_ptr<ProgressBar> Bar;
};

/// Put the scene over a backdrop; both scaled by exposure. Alpha becomes 1.
void ComposeOver(
  Picture& picture, const OffscreenScene& scene, const Backdrop& backdrop, double exposure);
} // namespace tool

#endif
