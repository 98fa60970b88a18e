// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From radiance to the screen as the mapper shows it, on the GPU and for pictures; and the one
 * directional light that may be in an environment's place, with what a material reflects of it.
 */

#ifndef Display_h
#define Display_h

#include "Picture.h"
#include "State.h"
#include "Surface.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <QImage>

#include <glm/glm.hpp>

#include <vector>

class vtkActor;
class vtkBRDF;
class vtkEnvironment;
class vtkLight;

namespace explorer
{
/// The factor of the radiance that an actor's shader writes as radiance^(1/2.2).
void SetExposure(vtkActor* actor, double factor);

/**
 * The factor of radiance: 2^stops, so that 0 stops show what the mapper shows. Without an
 * environment, 0 stops show a white diffuse surface that faces a light of irradiance 1 as 0.7.
 */
double FindExposure(vtkEnvironment* environment, double stops);

/// (radiance times a factor)^(1/2.2), RGBA of unsigned char.
vtkSmartPointer<vtkImageData> MakeImage(const tool::Picture& radiance, double factor);

/// 8-bit display values of a picture of display light, row 0 at the top.
QImage MakeQImage(const tool::Picture& display);

/// The environment, blurred and dimmed, to be seen behind the mesh: radiance, lat-long.
tool::Picture MakeBackdropPicture(vtkEnvironment* environment);

/// The unit vector towards the light: theta from +y, phi about it from +z to +x.
glm::dvec3 GetDirection(const LightState& light);

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
