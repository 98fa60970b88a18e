// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadianceCostCalibrator
 * @brief   measures what a pixel costs by each method on a renderer (vtkRadianceCostModel)
 *
 * Draws a small patch with the normals of a sphere, off screen, by light sets of 1 and 64 soft
 * lights, a table of radiance, 16 filtered samples and at most 25 pre-integrated functions: as
 * large a patch, or as many over each other, as take some milliseconds. Costs are the least time of
 * 5 frames (other work on the machine only adds to it) less that of an empty one, per pixel that
 * was shaded. They are of an isotropic Ashikhmin-Shirley lobe; a light of other materials may cost
 * half or twice as much. A cost that drowns in BASE's counts as a hundredth of it, and BASE as a
 * tenth of a pixel with one light at least.
 *
 * Nothing else should be at work on the machine meanwhile. Renderers that shade nothing which is
 * hidden by what comes later in the same draw call are measured by patches side by side only, and
 * less exactly if they are fast.
 */

#ifndef vtkRadianceCostCalibrator_h
#define vtkRadianceCostCalibrator_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

#include <atomic> // for Abort
#include <memory> // for Internals
#include <string> // for names

class vtkRadianceCostModel;
class vtkRenderWindow;

class VTKMEASUREDBRDF_EXPORT vtkRadianceCostCalibrator : public vtkObject
{
public:
  static vtkRadianceCostCalibrator* New();
  vtkTypeMacro(vtkRadianceCostCalibrator, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A window on the renderer to measure, which it is not drawn to: one off screen shares its
   * context's objects. Null (default): what an off-screen window of this VTK gets.
   */
  void SetRenderWindow(vtkRenderWindow* window);
  vtkRenderWindow* GetRenderWindow();
  ///@}

  /**
   * Measure. It takes about a second on Mesa's llvmpipe, and
   * needs an OpenGL context. Returns false with an error event, the model unchanged, where nothing
   * can be drawn, the times tell nothing, or the run was aborted. Raises ProgressEvent.
   */
  bool Calibrate();

  /**
   * The result, with the renderer's name (before Calibrate: the defaults).
   */
  vtkRadianceCostModel* GetCostModel();

  ///@{
  /**
   * Set from an observer to stop a running Calibrate, which starts with it cleared.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

protected:
  vtkRadianceCostCalibrator();
  ~vtkRadianceCostCalibrator() override;

  std::atomic<bool> Abort{ false };

private:
  vtkRadianceCostCalibrator(const vtkRadianceCostCalibrator&) = delete;
  void operator=(const vtkRadianceCostCalibrator&) = delete;

  /// Nanoseconds per pixel of every method, into the model; what went wrong, or "".
  std::string Measure(vtkRenderWindow* window, const std::string& name);

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
