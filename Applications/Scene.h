// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One mesh with one measured material, rendered off screen into a float picture.
 */

#ifndef Scene_h
#define Scene_h

#include "Inputs.h"
#include "Picture.h"

#include "vtkNew.h"
#include "vtkPolyData.h"

#include <array>
#include <string>
#include <vector>

class vtkActor;
class vtkCamera;
class vtkFramebufferPass;
class vtkMeasuredBRDFMapper;
class vtkRenderWindow;
class vtkRenderer;

namespace tool
{
class Scene
{
public:
  Scene();
  ~Scene();
  Scene(const Scene&) = delete;
  void operator=(const Scene&) = delete;

  void SetMesh(vtkPolyData* mesh);
  void SetMaterial(vtkBRDF* brdf);
  void SetLight(vtkEnvironment* environment, const LightSetOptions& lights);

  /// These lights instead of an environment's, until null is set.
  void SetLightSet(vtkLightSet* lights);

  /**
   * Look at the mesh's middle from an azimuth (about +y, 0 = from +z, 90 = from +x) and an
   * elevation above the horizon, in degrees. fill: share of the picture's smaller side that the
   * mesh's bounding sphere takes.
   */
  void SetView(double azimuth, double elevation, double fill);

  /// Radiance per pixel, alpha 0 where there is no mesh. Throws Error.
  Picture Render(int width, int height);

  /// Time of one frame that was rendered before, in milliseconds, until the last pixel is done.
  double TimeFrame();

  /// World direction that pixel (x, y) of a picture of the given size looks along.
  std::array<double, 3> GetRay(double x, double y, int width, int height) const;

  std::string GetRendererName();
  std::size_t GetTextureBytes();
  int GetNumberOfLights();

private:
  void PlaceCamera(int width, int height);

  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkFramebufferPass> Pass;
  vtkNew<vtkRenderWindow> Window;
  double Azimuth = 0.0;
  double Elevation = 0.0;
  double Fill = 0.9;
};

/// Put the scene over a backdrop; both scaled by exposure. Alpha becomes 1.
void ComposeOver(Picture& picture, const Scene& scene, const Backdrop& backdrop, double exposure);
} // namespace tool

#endif
