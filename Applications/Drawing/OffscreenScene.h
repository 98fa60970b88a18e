// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A window off screen that one mesh is rendered in, into a float picture.
 */

#ifndef Stage_h
#define Stage_h

#include "Picture.h"

#include "vtkNew.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <string>

class vtkActor;
class vtkCamera;
class vtkFramebufferPass;
class vtkRenderWindow;
class vtkRenderer;

namespace tool
{
class OffscreenScene
{
public:
  /// The mapper draws the mesh. No lights.
  explicit OffscreenScene(vtkOpenGLPolyDataMapper* mapper);
  virtual ~OffscreenScene();
  OffscreenScene(const OffscreenScene&) = delete;
  void operator=(const OffscreenScene&) = delete;

  void SetMesh(vtkPolyData* mesh);

  /**
   * Look at the mesh's middle from an azimuth (about +y, 0 = from +z, 90 = from +x) and an
   * elevation above the horizon, with a vertical angle of view, all in degrees. fill: share of the
   * picture's smaller side that the mesh's bounding sphere takes.
   */
  void SetView(double azimuth, double elevation, double fill, double angle = 30.0);

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
  std::array<double, 3> GetRay(double x, double y, int width, int height) const;

  /// Where the camera is that PlaceCamera placed.
  std::array<double, 3> GetEye() const;

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
  double Azimuth = 0.0;
  double Elevation = 0.0;
  double Fill = 0.9;
  double ViewAngle = 30.0;
};
} // namespace tool

#endif
