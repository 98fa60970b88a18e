// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * f of many lights for one view: faster than one by one where a material can. Private to the
 * module.
 */

#ifndef ManyLights_h
#define ManyLights_h

#include "LightLanes.h"
#include "vtkBRDF.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace measuredbrdf
{
/// Of a prepared material; lights: unit vectors above the horizon, like o. In single precision
/// where the material evaluates them side by side.
inline void EvaluateManyLights(
  vtkBRDF* brdf, std::size_t count, const glm::dvec3* lights, const glm::dvec3& o, glm::dvec3* f)
{
  const LightLanes lanes(brdf);
  const bool many = lanes.AreSideBySide();
  for (std::size_t k = 0; k < count && !many; ++k)
  {
    brdf->Evaluate(&lights[k].x, &o.x, &f[k].x);
  }
  constexpr std::size_t atOnce = 256;
  std::array<std::array<float, atOnce>, 3> i, values;
  const float* const from[3] = { i[0].data(), i[1].data(), i[2].data() };
  float* const to[3] = { values[0].data(), values[1].data(), values[2].data() };
  for (std::size_t first = 0; first < count && many; first += atOnce)
  {
    const std::size_t size = std::min(atOnce, count - first);
    for (std::size_t k = 0; k < size; ++k)
    {
      for (int c = 0; c < 3; ++c)
      {
        i[c][k] = static_cast<float>(lights[first + k][c]);
      }
    }
    lanes.Evaluate(static_cast<int>(size), from, o, to);
    for (std::size_t k = 0; k < size; ++k)
    {
      f[first + k] = glm::dvec3(values[0][k], values[1][k], values[2][k]);
    }
  }
}
} // namespace measuredbrdf

#endif
