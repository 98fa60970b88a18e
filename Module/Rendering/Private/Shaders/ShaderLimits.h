// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How much goes into and through the stages of a shader.
 */

#ifndef ShaderLimits_h
#define ShaderLimits_h

#include <cstddef>

class vtkOpenGLState;

namespace measuredbrdf
{
struct ShaderLimits
{
  ///@{
  /// What OpenGL 3.2 guarantees: attributes of a vertex, and components of what a stage hands to
  /// the next one.
  std::size_t Attributes = 16;
  std::size_t Varyings = 60;
  ///@}

  /// Of a graphics card.
  static ShaderLimits Read(vtkOpenGLState* state);

  /// For tests: Read gives no more than these from now on; zeros: what there is.
  static void SetMost(std::size_t attributes, std::size_t varyings);
};
} // namespace measuredbrdf

#endif
