// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkSurfaceVisibilityFilter's point arrays, and the passes over all points of its surfaces that
 * fill them.
 */

#ifndef VisibilityTask_h
#define VisibilityTask_h

#include "HorizonCode.h"
#include "SurfaceTracer.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

class vtkPolyData;

namespace measuredbrdf
{
/// Of one side of a surface: the front, or the back.
struct SideArrays
{
  vtkSmartPointer<vtkUnsignedCharArray> Sky;
  vtkSmartPointer<vtkUnsignedCharArray> Light;
  vtkSmartPointer<vtkUnsignedCharArray> Bounced;
  std::map<vtkIdType, vtkIdType> Sources; // of points that have what another point sees

  HorizonCode::Code Get(vtkIdType point) const;
  void Set(vtkIdType point, const HorizonCode::Code& code) const;
};

struct SurfaceArrays
{
  std::vector<SideArrays> Sides;
  std::string Key; // of the points, normals and cells
};

struct VisibilitySettings
{
  int NumberOfRays;
  bool BothSides;
  bool SelfOcclusion; // whether the tracer has the surfaces as its first ones
  double Farthest;
  bool WithSky;    // else it is known
  bool WithBounce; // what comes back from what hides the sky
};

/// Traces what is wanted, on top of what is known of each surface. report: what share of all is
/// done; returns whether to go on. Returns whether it was not stopped.
bool TraceVisibility(const SurfaceTracer& tracer, const std::vector<vtkPolyData*>& surfaces,
  const VisibilitySettings& settings, const std::function<bool(double)>& report,
  std::vector<SurfaceArrays>& traced);
} // namespace measuredbrdf

#endif
