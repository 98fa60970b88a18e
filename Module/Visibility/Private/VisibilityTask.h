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
#include <utility>
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
};

class VisibilityTask
{
public:
  /// passes: how many will be made. report: what share of all is done; returns whether to go on.
  VisibilityTask(const SurfaceTracer& tracer, const std::vector<vtkPolyData*>& surfaces,
    const VisibilitySettings& settings, int passes, std::function<bool(double)> report);

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
  VisibilitySettings Settings;
  std::function<bool(double)> Report;
  vtkIdType All = 1;
  vtkIdType Done = 0;
  vtkIdType Chunk = 64; // points until it is asked whether to go on: they take some 50 ms
};
} // namespace measuredbrdf

#endif
