// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How long the graphics card draws what several mappers draw together, as vtkOpenGLPolyDataMapper
 * measures it for one: actors with levels of detail choose by it.
 */

#ifndef DrawTimer_h
#define DrawTimer_h

#include "vtkOpenGLRenderTimer.h"
#include "vtkType.h"

#include <algorithm>

namespace measuredbrdf
{
class DrawTimer
{
public:
  /// Before and after drawing that many cells. Timers cost time: they run in every hundredth frame,
  /// or once in a million cells.
  void Start(vtkIdType cells)
  {
    this->Runs = cells > 0 && ++this->Frames > std::min<vtkIdType>(100, 1000000 / cells);
    if (this->Runs)
    {
      this->Frames = 0;
      this->Timer.ReusableStart();
    }
  }
  void Stop()
  {
    if (this->Runs)
    {
      this->Timer.ReusableStop();
      const double seconds = this->Timer.GetReusableElapsedSeconds();
      this->Seconds = seconds > 0.0 ? seconds : Shortest;
    }
  }

  /// In seconds, not 0 once there is one; the same before as VTK's mappers have.
  double GetSeconds() const { return this->Seconds; }

  void ReleaseGraphicsResources() { this->Timer.ReleaseGraphicsResources(); }

private:
  static constexpr double Shortest = 0.0001;
  vtkOpenGLRenderTimer Timer;
  vtkIdType Frames = 1;
  bool Runs = false;
  double Seconds = Shortest;
};
} // namespace measuredbrdf

#endif
