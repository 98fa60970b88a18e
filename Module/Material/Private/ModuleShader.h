// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the shader inputs of materials share: the module's GLSL texts, from shaders/, and textures
 * whose values are scaled so that 16 bits suffice.
 */

#ifndef ModuleShader_h
#define ModuleShader_h

#include "vtkBRDFShaderInputs.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
/// Largest relative errors of textures' values of 16 and 32 bits.
constexpr double HalfRounding = 1.0 / 2048.0;
constexpr double FloatRounding = 0x1p-23;

/// The factor that gives the values (NaN: none) a peak of 2^15: 16-bit floats and shared exponents
/// then keep their bits over nine decades.
inline float GetPeakScale(const std::vector<float>& values)
{
  float peak = 0.0f;
  for (const float value : values)
  {
    peak = std::max(peak, std::isnan(value) ? 0.0f : std::abs(value));
  }
  return peak > 1e-30f ? 32768.0f / peak : 1.0f;
}

/// Set the term's text to that of the file, and its name to the file's.
inline void SetModuleShader(vtkBRDFShaderInputs::Term& term, const char* name, const char* source)
{
  term.Shader = name;
  term.Source = source;
  term.IsTested = true;
}

/// A uniform of three numbers.
inline vtkBRDFShaderInputs::Uniform MakeTriple(const char* name, const glm::dvec3& values)
{
  return { name,
    { static_cast<float>(values.x), static_cast<float>(values.y), static_cast<float>(values.z) } };
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
