// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// D-BRDF (Ashikhmin and Premoze 2007) with tabulated p(h) and F. C++ twin: vtkDistributionBRDF.
uniform sampler2D brdfDistributionINSTANCE; // sqrt(theta_h 2/pi), phi_h / 2 pi
uniform sampler2D brdfFresnelINSTANCE;      // theta_d 2/pi
uniform float brdfOwnVarianceINSTANCE;      // of p's lobe; 0: p is anisotropic

vec3 brdfStretchedINSTANCE(vec3 i, vec3 o, vec3 h, float stretch)
{
  float theta = sqrt(brdfQuadrant(length(h.xy), h.z) * stretch);
  vec3 p = texture(brdfDistributionINSTANCE, vec2(theta, brdfTurn(h.xy))).rgb;
  vec3 fresnel =
    texture(brdfFresnelINSTANCE, vec2(brdfQuadrant(length(i - o), length(i + o)), 0.5)).rgb;
  return p * fresnel / (4.0 * (i.z + o.z - i.z * o.z));
}

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  return brdfStretchedINSTANCE(i, o, brdfHalfVector(i, o), 1.0);
}

vec3 brdfTermSoftINSTANCE(vec3 i, vec3 o, float spread)
{
  float own = brdfOwnVarianceINSTANCE;
  if (own == 0.0)
  {
    return brdfTermINSTANCE(i, o);
  }
  vec3 h = brdfHalfVector(i, o);
  float share = own / (own + brdfHalfVectorSpread(spread, dot(h, o)));
  return brdfStretchedINSTANCE(i, o, h, sqrt(share)) * (share + 2.0 * own) / (1.0 + 2.0 * own);
}
