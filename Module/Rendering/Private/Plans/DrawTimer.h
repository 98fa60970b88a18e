// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How long the graphics card draws what several mappers draw together, as vtkOpenGLPolyDataMapper
 * measures it for one: actors with levels of detail choose by it. Private to the rendering room.
 */

#ifndef DrawTimer_h
#define DrawTimer_h

#include "vtkOpenGLRenderTimer.h"
#include "vtkType.h"

class vtkWindow;

namespace measuredbrdf
{
class DrawTimer
{
public:
  /// Before and after drawing that many cells. Timers cost time: they run in every hundredth frame,
  /// or once in a million cells.
  void Start(vtkIdType cells);
  void Stop();

  /// In seconds, not 0 once there is one; the same before as VTK's mappers have.
  double GetSeconds() const { return this->Seconds; }

  void ReleaseGraphicsResources();

private:
  vtkOpenGLRenderTimer Timer;
  vtkIdType Frames = 1;
  bool Runs = false;
  double Seconds = 0.0001;
};
} // namespace measuredbrdf

#endif
