// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Integrals of f over the projected hemisphere: albedos, reflectances, transmittances.
 */

#ifndef ReflectionIntegral_h
#define ReflectionIntegral_h

#include "HemisphereIntegral.h" // for AlbedoTolerance

#include <glm/glm.hpp>

class vtkBRDF;

namespace measuredbrdf
{
enum class IntegralOver
{
  Lights, // of a given view: the directional albedo
  Views   // of a given light: the reflectance
};

/// The integral of f cos(theta) over the direction that is not given, RGB. Of a prepared BRDF and a
/// unit direction above the horizon. Exact for vtkAngleBasisBRDF, else IntegrateHemisphere's,
/// whose time grows with 1 / tolerance: mere weights take few per cent.
glm::dvec3 IntegrateReflection(
  vtkBRDF* brdf, const glm::dvec3& given, IntegralOver over, double tolerance = AlbedoTolerance);
} // namespace measuredbrdf

#endif
