// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkSurfaceVisibilityFilter's passes over all points of its surfaces. Private to the module.
 */

#ifndef VisibilityTask_h
#define VisibilityTask_h

#include "SurfaceTracer.h"
#include "VisibilityArrays.h"

#include <functional>
#include <utility>
#include <vector>

class vtkPolyData;

namespace measuredbrdf
{
class VisibilityTask
{
public:
  struct Settings
  {
    int NumberOfRays;
    std::vector<SideNames> Sides; // one or two: the front, the back
    bool SelfOcclusion;           // whether the tracer has the surfaces as its first ones
    double Farthest;
  };

  /// passes: how many will be made. report: what share of all is done; returns whether to go on.
  VisibilityTask(const SurfaceTracer& tracer, const std::vector<vtkPolyData*>& surfaces,
    const Settings& settings, int passes, std::function<bool(double)> report);

  ///@{
  /// Return whether they were not stopped. What is hidden of the sky, of each surface:
  bool TraceSky(std::vector<SurfaceArrays>& traced);
  /// And thereafter, what comes back from what hides it.
  bool TraceBounce(std::vector<SurfaceArrays>& traced);
  ///@}

private:
  template <typename Visit>
  bool ForEach(vtkIdType count, const Visit& visit);

  const SurfaceTracer& Tracer;
  const std::vector<vtkPolyData*>& Surfaces;
  Settings Options;
  std::function<bool(double)> Report;
  vtkIdType All = 1;
  vtkIdType Done = 0;
  vtkIdType Chunk = 64; // points until it is asked whether to go on: they take some 50 ms
};
} // namespace measuredbrdf

#endif
