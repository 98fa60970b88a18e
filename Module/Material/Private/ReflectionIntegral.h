// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Integrals of f over the projected hemisphere: albedos, reflectances, transmittances. Private to
 * the module.
 */

#ifndef ReflectionIntegral_h
#define ReflectionIntegral_h

#include <glm/glm.hpp>

class vtkBRDF;

namespace measuredbrdf
{
enum class IntegralOver
{
  Lights, // of a given view: the directional albedo
  Views   // of a given light: the reflectance
};

/**
 * The integral of f cos(theta) over the direction that is not given, RGB. Of a prepared BRDF and a
 * unit direction above the horizon.
 *
 * Exact for vtkAngleBasisBRDF. Else it is an adaptive cubature (as Genz, Malik 1980, "An adaptive
 * algorithm for numerical integration over an n-dimensional rectangular region") over the square
 * that the projected hemisphere fills by area (Shirley, Chiu 1997, "A low distortion map between
 * disk and square"). It begins with 128 x 128 points, and more about the mirror direction, the
 * given direction and those that the material samples, and goes on where squares and their quarters
 * differ most until the estimated error of each channel is below 5e-4 of it, or at 2^16 squares.
 */
glm::dvec3 IntegrateReflection(vtkBRDF* brdf, const glm::dvec3& given, IntegralOver over);
} // namespace measuredbrdf

#endif
