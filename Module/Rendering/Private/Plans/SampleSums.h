// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures whose samples are drawn in sub-frames that add up.
 *
 * A sub-frame has some of the n samples, n times; the sum of all over n is the light of all
 * samples, since radiance is encoded after that. Each is drawn into a framebuffer of the view's,
 * with depth, where those of the front-most surface add up beside the light that is no sample's;
 * the picture takes its radiance from there (shaders/vtkBRDFSampleSum.glsl).
 */

#ifndef SampleSums_h
#define SampleSums_h

#include "BRDFShader.h"
#include "DrawnMaterial.h"
#include "vtkType.h"

#include <array>
#include <chrono>
#include <functional>
#include <list>
#include <vector>

class vtkActor;
class vtkRenderer;
class vtkShaderProgram;
class vtkWindow;

namespace measuredbrdf
{
/// What is drawn together, of one data set.
struct SummedPart
{
  vtkRenderer* Renderer;
  vtkActor* Actor;
  const void* Who;            // the mapper
  vtkMTimeType Time;          // when the data set or its materials last changed
  vtkMTimeType OcclusionTime; // when what is hidden was traced
};

class SampleSums
{
public:
  SampleSums();
  ~SampleSums();
  SampleSums(const SampleSums&) = delete;
  void operator=(const SampleSums&) = delete;

  /// A mapper's Render begins, and with it the time that sub-frames have.
  void Begin();

  /// Whether a part with these is to be added, or was.
  bool IsConcerned(const std::vector<DrawnMaterial>& materials) const;

  /// Before a part that is concerned is drawn, and after that. draw: draws it, which throws what it
  /// likes.
  void Add(const SummedPart& part, const std::vector<DrawnMaterial>& materials,
    const std::function<void()>& draw);
  void End();

  /// What is drawn now.
  SumStage GetStage() const { return this->Stage; }
  void SetUniforms(vtkShaderProgram* program) const;

  /// Whether the last picture of a view was not yet of all samples: the next one goes on.
  bool IsPending() const;

  /// Whether a picture of all samples of a part, which was measured, takes no longer than a frame.
  bool HasTime(vtkRenderer* renderer, vtkActor* actor, const void* who) const;

  ///@{
  /// Of a mapper that draws no more; of a window's views.
  void Forget(const void* who);
  void Release(vtkWindow* window);
  ///@}

private:
  using Clock = std::chrono::steady_clock;
  struct View;

  View& FindView(const SummedPart& part);

  std::list<View> Views;
  View* Shown = nullptr;
  SumStage Stage = SumStage::None;
  std::array<float, 3> Samples = {}; // added now: from, to, of how many
  Clock::time_point Start;
  unsigned long Renders = 0;
};
} // namespace measuredbrdf

#endif
