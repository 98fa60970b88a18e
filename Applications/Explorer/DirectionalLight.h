// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One directional light in an environment's place: where it comes from, and what a material
 * reflects of it. Without Qt.
 */

#ifndef DirectionalLight_h
#define DirectionalLight_h

#include "State.h"
#include "Surface.h"

#include <array>
#include <vector>

class vtkBRDF;
class vtkLight;

namespace explorer
{
/// The unit vector towards the light: theta from +y, phi about it from +z to +x.
std::array<double, 3> GetDirection(const LightState& light);

/// Sets the angles of a light that comes from there; any length but 0.
void SetDirection(LightState& light, const double direction[3]);

/// Lets a light of a scene be that light: vtkMeasuredBRDFMapper and VTK's physically based shading
/// take its intensity as irradiance.
void PlaceLight(vtkLight* light, const LightState& state);

/**
 * The exact radiance of a surface's pixels, 3 doubles each: f(light, view) E cos(theta), without
 * what the surface hides from itself. Anisotropic materials are turned about the up axis, as the
 * mapper does without tangents.
 */
std::vector<double> DrawDirectional(
  vtkBRDF* brdf, const tool::Surface& surface, const LightState& light);
} // namespace explorer

#endif
