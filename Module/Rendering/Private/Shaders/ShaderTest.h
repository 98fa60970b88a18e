// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Whether GLSL text from outside the module compiles: tried on its own, since VTK prints a shader
 * that does not compile in full and goes on without one. Private to the module.
 */

#ifndef ShaderTest_h
#define ShaderTest_h

#include "vtkBRDFShaderInputs.h"

#include <string>

namespace measuredbrdf
{
/// What a term's text defines.
enum class TermKind
{
  Material,   // brdfTermINSTANCE
  Integrator, // brdfEnvironmentINSTANCE
};

/// What is wrong with the terms' text, or "". The texts that were tested last are not
/// compiled again.
std::string TestShaders(const vtkBRDFShaderInputs& inputs, TermKind kind);
} // namespace measuredbrdf

#endif
