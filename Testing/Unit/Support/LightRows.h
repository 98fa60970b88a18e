// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Directions of lights as they are evaluated side by side: x, y and z in single precision.

#ifndef LightRows_h
#define LightRows_h

#include <glm/glm.hpp>

#include <vector>

struct LightRows
{
  // What single precision makes of it, so that both precisions see the same.
  void Add(const glm::dvec3& light)
  {
    const glm::vec3 rounded(light);
    this->Directions.emplace_back(rounded);
    for (int c = 0; c < 3; ++c)
    {
      this->Values[c].push_back(rounded[c]);
    }
  }
  // After the last one was added.
  void SetPointers()
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Pointers[c] = this->Values[c].data();
    }
  }

  std::vector<glm::dvec3> Directions;
  std::vector<float> Values[3];
  const float* Pointers[3] = { nullptr, nullptr, nullptr };
};

#endif
