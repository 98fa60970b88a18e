// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// D-BRDF (Ashikhmin and Premoze 2007) with tabulated p(h) and F. C++ twin: vtkDistributionBRDF.
uniform sampler2D brdfDistributionINSTANCE; // sqrt(theta_h 2/pi), phi_h / 2 pi
uniform sampler2D brdfFresnelINSTANCE;      // theta_d 2/pi

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  vec3 h = brdfHalfVector(i, o);
  float thetaH = atan(length(h.xy), h.z);
  float thetaD = atan(length(cross(h, i)), dot(h, i));
  vec3 p = texture(brdfDistributionINSTANCE,
    vec2(sqrt(thetaH * (2.0 / brdfPi)), atan(h.y, h.x) / (2.0 * brdfPi))).rgb;
  vec3 fresnel = texture(brdfFresnelINSTANCE, vec2(thetaD * (2.0 / brdfPi), 0.5)).rgb;
  return p * fresnel / (4.0 * (i.z + o.z - i.z * o.z));
}
