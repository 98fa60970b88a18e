// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkSurfaceVisibilityFilter's arrays as vertex attributes.
 */

#ifndef OcclusionArrays_h
#define OcclusionArrays_h

#include "RecentlyUsed.h"
#include "SurfaceBlocks.h"
#include "vtkDataObject.h"
#include "vtkFloatArray.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <memory>
#include <string>
#include <unordered_map>

namespace measuredbrdf
{
class SharedTrace;

/// Codes of all points, three bytes in each float.
struct OcclusionArrays
{
  static constexpr std::size_t Attributes = 5; // of four floats
  using Side = std::array<vtkSmartPointer<vtkFloatArray>, Attributes>;
  Side Front;
  Side Back;
  ///@{
  /// What comes back from what is hidden, likewise: one attribute of three floats.
  vtkSmartPointer<vtkFloatArray> BounceFront;
  vtkSmartPointer<vtkFloatArray> BounceBack;
  bool HasBounce = false;
  ///@}
  bool HasBack = false;
  bool IsOtherClosed = false; // no back: the side that Front is not about sees nothing of the sky
  double LeastCosine = -1.0;  // of the view and normals of points whose code triangles may show

  /// Points that see all of their sky.
  static std::shared_ptr<OcclusionArrays> MakeOpen(vtkIdType points);

  /// Whether the surface brings some, whatever they are.
  static bool HasAny(vtkPolyData* surface);

  /// What the surface's arrays say. Null where there are none, or a reason why not is in problem.
  /// isPart: the surface is a part of another one, whose key it has. withBounce: whether it is to
  /// have what comes back; where that is not there, problem says so, and the rest counts.
  static std::shared_ptr<OcclusionArrays> Read(
    vtkPolyData* surface, bool isPart, bool withBounce, std::string& problem);

private:
  void ReadBounce(vtkPolyData* surface, std::string& problem);
  void LeaveOutClosedSide(vtkPolyData* surface);
};

/// Those of the surfaces that a mapper draws, kept while these stay as they are.
class OcclusionCache
{
public:
  OcclusionCache();
  ~OcclusionCache();

  /// input: the mapper's, of which the surface is a block, or itself. Where the surface has no
  /// arrays, those of traced, which stands for the input, or, with make, of the input traced now.
  struct Question
  {
    vtkPolyData* Surface = nullptr;
    vtkDataObject* Input = nullptr;
    vtkDataObject* Traced = nullptr;
    bool Make = false;
    bool IsPart = false;
    bool WithBounce = false;
  };
  std::shared_ptr<OcclusionArrays> Find(const Question& question, std::string& problem);

  /// Before all blocks ask for what is drawn next: a change of one may show on the others.
  void Begin() { this->IsTracedChecked = false; }

  /// The surface with arrays; itself where it cannot be traced.
  vtkSmartPointer<vtkPolyData> FindWhole(
    vtkPolyData* surface, vtkDataObject* input, bool withBounce);

private:
  struct Entry
  {
    vtkMTimeType Time = 0;
    bool WithBounce = false;
    vtkSmartPointer<vtkDataObject> Traced; // what stood for the input
    std::shared_ptr<OcclusionArrays> Arrays;
    std::string Problem;
  };

  static constexpr std::size_t Least = 1024; // surfaces are remembered, and all blocks of an input

  void Expect(vtkDataObject* input);
  vtkDataObject* Trace(vtkPolyData* surface, vtkDataObject* input, bool withBounce);

  RecentlyUsed<vtkPolyData*, Entry> Entries{ Least };
  ///@{
  /// The input, traced as it was last asked for.
  using Times = std::unordered_map<vtkDataObject*, vtkMTimeType>; // only compared
  std::shared_ptr<SharedTrace> Shared;
  vtkSmartPointer<vtkDataObject> Traced;
  vtkDataObject* TracedInput = nullptr;
  Times TracedTimes; // of the input and its blocks
  bool TracedBounce = false;
  bool IsTracedChecked = false; // whether all times were compared
  ///@}
  vtkDataObject* Expected = nullptr; // only compared
  vtkMTimeType ExpectedTime = 0;
  std::size_t Most = Least;
  BlockPairs Pairs; // of what is drawn
};
} // namespace measuredbrdf

#endif
