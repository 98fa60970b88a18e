// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Assembly of the fragment shader from the files in shaders. Private to the rendering room.
 */

#ifndef BRDFShader_h
#define BRDFShader_h

#include "vtkBRDFShaderInputs.h"

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
  const vtkBRDFShaderInputs* material, const vtkBRDFShaderInputs& environment);

/// What the body of a shader depends on.
struct ShaderBody
{
  int Complexity = 0; // VTK's for the scene's lights: 0 none, 1 headlight, 2 directional, 3 any
  int LightCount = 0;
  TangentSource Tangents = TangentSource::None;
  bool HasEdges = false;       // VTK's edgeColor and emix are there
  bool HasEdgeOpacity = false; // and edgeOpacity (VTK 9.3)
  bool EdgesAreTubes = false;  // lit as such
  bool HasBlockColors = false; // VTK's OverridesColor is there (composite data)
};

/// For //VTK::Light::Impl.
std::string GetShaderBody(const ShaderBody& body);
} // namespace measuredbrdf

#endif
