// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Triangles that face away, taken from a mapper's buffer of indices and put back. Private to the
 * rendering room.
 */

#ifndef FacingDrawing_h
#define FacingDrawing_h

#include "FacingTriangles.h"

#include <glm/glm.hpp>

#include <vector>

class vtkActor;
class vtkOpenGLIndexBufferObject;
class vtkPolyData;
class vtkRenderer;
class vtkRenderWindow;

namespace measuredbrdf
{
struct OcclusionArrays;

class FacingDrawing
{
public:
  /// Smaller surfaces draw all of their triangles.
  static constexpr vtkIdType LeastTriangles = 10000;

  /// Whether what is drawn of the actor leaves triangles that face away no other use: opaque, lit
  /// and uncut surfaces, on a renderer that takes the processor's time.
  bool IsWorth(vtkRenderer* renderer, vtkActor* actor);

  /// Keep triangles that face the viewer. arrays: of a surface that is closed.
  void LeaveOut(vtkRenderer* renderer, vtkActor* actor, vtkPolyData* surface,
    const OcclusionArrays& arrays, vtkOpenGLIndexBufferObject* indices);

  /// All triangles are there again, before the buffer may be kept or made anew.
  void PutBack(vtkOpenGLIndexBufferObject* indices);

  /// The buffer is another one, or none.
  void Forget();

private:
  FacingTriangles Triangles;
  const OcclusionArrays* Arrays = nullptr; // those of the triangles; only compared
  std::vector<unsigned int> Corners;       // in the buffer
  glm::dvec4 Eye = glm::dvec4(0.0);
  bool IsPartial = false;
  vtkRenderWindow* Window = nullptr; // only compared
  bool IsSoftware = false;           // the window's renderer
};
} // namespace measuredbrdf

#endif
