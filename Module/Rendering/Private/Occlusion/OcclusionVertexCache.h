// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The vertex cache: what is kept of a mapper's points while their light rests (MakeKeptShader),
 * made on the graphics card, once for each point, by transform feedback. Drawn triangles would make
 * it as often as the card's cache of vertices forgets a point, and in each frame anew.
 */

#ifndef OcclusionVertexCache_h
#define OcclusionVertexCache_h

#include "OcclusionShader.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkTransformFeedback.h"
#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLVertexBufferObjectGroup;
class vtkShaderProgram;
class vtkWindow;

namespace measuredbrdf
{
class OcclusionVertexCache
{
public:
  OcclusionVertexCache() = default;
  ~OcclusionVertexCache() { this->Release(); }
  OcclusionVertexCache(const OcclusionVertexCache&) = delete;
  void operator=(const OcclusionVertexCache&) = delete;

  ///@{
  /// Fewer points are drawn as fast without. Set: for tests.
  static constexpr std::size_t DefaultLeastPoints = 10000;
  static std::size_t GetLeastPoints();
  static void SetLeastPoints(std::size_t points);
  ///@}
  /// States of the light that are kept at a time, as of several views; each has 16 bytes a point
  /// for each vector of four floats, 176 at most.
  static constexpr std::size_t MostStates = 4;

  /// Which light, of which codes: who draws (a view and its actor), all inputs (GetKeptInputs), and
  /// when the buffers of codes were built.
  struct Question
  {
    const void* View = nullptr;
    const void* Actor = nullptr;
    std::vector<double> Inputs;
    vtkMTimeType Time = 0;
  };

  /// Whether that light is kept; the next AddTo hands it over.
  bool Find(const OcclusionLights& lights, const OcclusionLayout& layout, const Question& question);

  /// Ready the program that makes it; its uniforms are the caller's to set. Null: it can't be made.
  vtkShaderProgram* Begin(vtkOpenGLRenderWindow* window, vtkOpenGLVertexBufferObjectGroup* buffers,
    const OcclusionLights& lights, const OcclusionLayout& layout);

  /// Make it, for so many points, in place of what the same view had, or the longest unused.
  void Make(std::size_t points, const Question& question);

  /// Hand what was found or made to the program that draws.
  void AddTo(vtkOpenGLHelper& drawn) const;

  /// Let go of what is kept, as long as the context that made it is current.
  void Drop();

  /// Give all back to the window that has it; its program can be tried anew. window: the one that
  /// asks for that, with its context current. The destructor gives back, too.
  void Release(vtkWindow* window = nullptr);

  /// False where the program could not be made.
  bool IsPossible() const { return this->CanMake; }

  ///@{
  /// How often any were made, and handed to a program: for tests.
  static std::size_t GetMadeCount();
  static std::size_t GetAddedCount();
  ///@}

private:
  struct State
  {
    std::string Key;
    Question Of;
    std::vector<std::string> Names;
    vtkSmartPointer<vtkOpenGLBufferObject> Buffer;
    std::size_t Bytes = 0;
    std::size_t Used = 0;
  };
  State& FindPlace(const Question& question);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  const void* Owner = nullptr; // that window: as it goes, weak pointers know it no more
  vtkOpenGLHelper Helper;      // of the program that makes it
  std::string Key;             // of the helper's program
  std::vector<std::string> Names;
  vtkSmartPointer<vtkTransformFeedback> Capture;
  std::vector<std::unique_ptr<State>> States;
  State* Current = nullptr;
  std::size_t Clock = 0; // of uses
  bool CanMake = true;
};

/// Release what no program captures with any more.
void SweepCaptures();
} // namespace measuredbrdf

#endif
