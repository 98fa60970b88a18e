// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * GLSL text of the module itself, from shaders/, and its textures.
 */

#ifndef ModuleShader_h
#define ModuleShader_h

#include "vtkBRDFShaderInputs.h"

namespace measuredbrdf
{
/// Set the term's text to that of the file, and its name to the file's.
inline void SetModuleShader(vtkBRDFShaderInputs::Term& term, const char* name, const char* source)
{
  term.Shader = name;
  term.Source = source;
  term.IsTested = true;
}

/// A new texture of the term, of three dimensions where depth > 1.
inline vtkBRDFShaderInputs::Texture& AddTexture(
  vtkBRDFShaderInputs::Term& term, const char* name, int width, int height, int depth = 1)
{
  term.Textures.emplace_back();
  term.Textures.back().Name = name;
  term.Textures.back().Dimensions = { width, height, depth };
  term.Textures.back().ThreeD = depth > 1;
  return term.Textures.back();
}
} // namespace measuredbrdf

#endif
