// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkSurfaceVisibilityFilter's arrays as vertex attributes.
 */

#ifndef OcclusionArrays_h
#define OcclusionArrays_h

#include "vtkFloatArray.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <memory>
#include <string>

namespace measuredbrdf
{
/// Codes of all points, three bytes in each float.
struct OcclusionArrays
{
  static constexpr std::size_t Attributes = 5; // of four floats

  /// Of one side of the surface; null arrays: it has none.
  struct Side
  {
    std::array<vtkSmartPointer<vtkFloatArray>, Attributes> Codes;
    vtkSmartPointer<vtkFloatArray> Bounce; // what comes back from what is hidden: three floats
  };
  Side Front;
  Side Back;
  bool IsOtherClosed = false; // no back: the side that Front is not about sees nothing of the sky

  double LeastCosine = -1.0; // of the view and normals of points whose code triangles may show

  bool HasBack() const { return this->Back.Codes[0] != nullptr; }
  bool HasBounce() const { return this->Front.Bounce != nullptr; }

  /// Those of a surface (null: it has none) with a back, or with what comes back, where others in
  /// the same buffers have that. What is missing is of points that see all of their sky.
  static OcclusionArrays Complete(
    const OcclusionArrays* given, vtkIdType points, bool both, bool bounced);

  /// Calls visit(name, array) for all vertex attributes that there may be; null: there is none.
  template <typename Visit>
  void ForEachAttribute(const Visit& visit) const
  {
    for (const bool isBack : { false, true })
    {
      const Side& side = isBack ? this->Back : this->Front;
      const std::string suffix = isBack ? "Back" : "";
      for (std::size_t k = 0; k < Attributes; ++k)
      {
        visit("brdfSky" + suffix + std::to_string(k), side.Codes[k].Get());
      }
      visit("brdfBounce" + suffix, side.Bounce.Get());
    }
  }

  /// Whether the surface brings some, whatever they are.
  static bool HasAny(vtkPolyData* surface);

  /// What the surface's arrays say. Null where there are none, or a reason why not is in problem.
  /// isPart: the surface is a part of another one, whose key it has. withBounce: whether it is to
  /// have what comes back; where that is not there, problem says so, and the rest counts.
  static std::shared_ptr<OcclusionArrays> Read(
    vtkPolyData* surface, bool isPart, bool withBounce, std::string& problem);
};
} // namespace measuredbrdf

#endif
