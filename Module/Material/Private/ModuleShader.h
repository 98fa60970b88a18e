// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * GLSL text of the module itself, from shaders/.
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
} // namespace measuredbrdf

#endif
