// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// D-BRDF (Ashikhmin and Premoze 2007) with tabulated p(h) and F. C++ twin: vtkDistributionBRDF.
uniform sampler2D brdfDistributionINSTANCE; // sqrt(theta_h 2/pi), phi_h / 2 pi
uniform sampler2D brdfFresnelINSTANCE;      // theta_d 2/pi

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  vec3 h = brdfHalfVector(i, o);
  vec3 p = texture(brdfDistributionINSTANCE,
    vec2(sqrt(brdfQuadrant(length(h.xy), h.z)), brdfTurn(h.xy))).rgb;
  vec3 fresnel =
    texture(brdfFresnelINSTANCE, vec2(brdfQuadrant(length(i - o), length(i + o)), 0.5)).rgb;
  return p * fresnel / (4.0 * (i.z + o.z - i.z * o.z));
}
