// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Built-in environments as formulas: radiance by direction, +y up.
 */

#ifndef ProceduralEnvironments_h
#define ProceduralEnvironments_h

#include <glm/glm.hpp>

#include <vector>

namespace measuredbrdf
{
/// A clear sky with a sun over brown ground.
glm::dvec3 GetSkyRadiance(const glm::dvec3& d);

/// A dark stone hall with bright arched windows, a rose window and lamps: the kind of light that
/// Debevec's Grace Cathedral map made common.
glm::dvec3 GetHallRadiance(const glm::dvec3& d);

/// RGB of width x height texels of a formula, each the mean of samples x samples points.
std::vector<float> DrawEnvironment(
  int width, int height, int samples, glm::dvec3 (*radiance)(const glm::dvec3&));
} // namespace measuredbrdf

#endif
