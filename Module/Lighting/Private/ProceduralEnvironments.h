// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Built-in environments as formulas: radiance by direction, +y up.
 */

#ifndef ProceduralEnvironments_h
#define ProceduralEnvironments_h

#include <glm/glm.hpp>

namespace measuredbrdf
{
/// A clear sky with a sun over brown ground.
glm::dvec3 GetSkyRadiance(const glm::dvec3& d);

/// A dark stone hall with bright arched windows, a rose window and lamps: the kind of light that
/// Debevec's Grace Cathedral map made common.
glm::dvec3 GetHallRadiance(const glm::dvec3& d);
} // namespace measuredbrdf

#endif
