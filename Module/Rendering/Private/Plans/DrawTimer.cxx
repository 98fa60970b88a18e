// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DrawTimer.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
constexpr vtkIdType MostFrames = 100;
constexpr vtkIdType MostCells = 1000000;
constexpr double ShortestTime = 0.0001; // seconds
}

void DrawTimer::Start(vtkIdType cells)
{
  this->Runs = cells > 0 && ++this->Frames > std::min(MostFrames, MostCells / cells);
  if (this->Runs)
  {
    this->Frames = 0;
    this->Timer.ReusableStart();
  }
}

void DrawTimer::Stop()
{
  if (this->Runs)
  {
    this->Timer.ReusableStop();
    this->Seconds = this->Timer.GetReusableElapsedSeconds();
    this->Seconds = this->Seconds > 0.0 ? this->Seconds : ShortestTime;
  }
}

void DrawTimer::ReleaseGraphicsResources() { this->Timer.ReleaseGraphicsResources(); }
} // namespace measuredbrdf
