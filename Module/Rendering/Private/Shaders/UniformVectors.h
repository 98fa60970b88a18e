// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Arrays of vec3 as uniforms.
 */

#ifndef UniformVectors_h
#define UniformVectors_h

#include "vtkShaderProgram.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace measuredbrdf
{
/// Of no vectors: nothing, as GLSL has no empty arrays.
inline void SetVectors(
  vtkShaderProgram* program, const std::string& name, const std::vector<glm::dvec3>& vectors)
{
  std::vector<float> values;
  for (const glm::dvec3& vector : vectors)
  {
    for (int c = 0; c < 3; ++c)
    {
      values.push_back(static_cast<float>(vector[c]));
    }
  }
  if (!values.empty())
  {
    program->SetUniform3fv(name.c_str(), static_cast<int>(vectors.size()), values.data());
  }
}
} // namespace measuredbrdf

#endif
