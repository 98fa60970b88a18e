// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Integrals of f over the projected hemisphere.
 */

#ifndef HemisphereIntegral_h
#define HemisphereIntegral_h

#include "LowDiscrepancy.h"

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace measuredbrdf
{
constexpr double AlbedoTolerance = 5e-4;

/**
 * The integral of f cos(theta), RGB: an adaptive cubature (as Genz, Malik 1980, "An adaptive
 * algorithm for numerical integration over an n-dimensional rectangular region") over the square
 * that the projected hemisphere fills by area (Shirley, Chiu 1997, "A low distortion map between
 * disk and square"). It begins with 128 x 128 points, and more about the given direction, its
 * mirror direction and the draws, and goes on where squares and their quarters differ most until
 * the estimated error of each channel is below the tolerance times it, or at 2^16 squares; at as
 * many fewer as the tolerance is above AlbedoTolerance.
 */
glm::dvec3 IntegrateHemisphere(const std::function<glm::dvec3(const glm::dvec3&)>& f,
  const glm::dvec3& given, const std::vector<glm::dvec3>& draws, double tolerance);

/// The same of a prepared BRDF over the light, or over the view. given: the other direction, unit
/// and above the horizon.
template <typename BRDF>
glm::dvec3 IntegrateBRDF(
  BRDF* brdf, const glm::dvec3& given, bool overView, double tolerance = AlbedoTolerance)
{
  glm::dvec3 d = given;
  if (brdf->IsIsotropic()) // any azimuth will do: the one where a tensor tree's cells are squares
  {
    d = glm::dvec3(-std::hypot(d.x, d.y), 0.0, d.z);
  }
  constexpr std::uint32_t count = 256;
  std::vector<glm::dvec3> draws;
  for (std::uint32_t k = 0; k < count; ++k)
  {
    glm::dvec3 i;
    if (brdf->Sample(&d.x, (k + 0.5) / count, RadicalInverse(k, 2), &i.x))
    {
      draws.push_back(i);
    }
  }
  const auto evaluate = [brdf, &d, overView](const glm::dvec3& other)
  {
    glm::dvec3 f;
    brdf->Evaluate(overView ? &d.x : &other.x, overView ? &other.x : &d.x, &f.x);
    return f;
  };
  return IntegrateHemisphere(evaluate, d, draws, tolerance);
}
} // namespace measuredbrdf

#endif
