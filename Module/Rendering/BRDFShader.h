// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Assembly of the fragment shader from the files in shaders. Private to the rendering room.
 */

#ifndef BRDFShader_h
#define BRDFShader_h

#include "vtkBRDFGPUForm.h"

#include <string>

namespace measuredbrdf
{
/// How the tangent of an anisotropic material is found.
enum class TangentSource
{
  None, // isotropic
  Data,
  Axis
};

/// Declarations: shared functions, the material's terms and brdfEvaluate, the environment's terms
/// and brdfEnvironment. Without a material there is no brdfEvaluate.
std::string GetShaderDeclarations(
  const vtkBRDFGPUForm* material, const vtkBRDFGPUForm& environment);

/**
 * Body for //VTK::Light::Impl. complexity and count are VTK's for the scene's lights (0 none, 1
 * headlight, 2 directional, 3 positional); edges: "", or the statement that mixes the edge colour.
 */
std::string GetShaderBody(
  int complexity, int count, TangentSource tangents, const std::string& edges);
} // namespace measuredbrdf

#endif
