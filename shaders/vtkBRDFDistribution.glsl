// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// D-BRDF (Ashikhmin and Premoze 2007) with tabulated p(h) and F. C++ twin: vtkDistributionBRDF.
uniform sampler2D brdfDistributionINSTANCE; // sqrt(theta_h 2/pi), phi_h / 2 pi or level
uniform sampler2D brdfFresnelINSTANCE;      // theta_d 2/pi
uniform float brdfNumberOfLevelsINSTANCE;   // widths of p; 0: p is anisotropic
uniform float brdfOwnVarianceINSTANCE;      // of p: the levels' unit

vec3 brdfRowINSTANCE(vec3 i, vec3 o, vec3 h, float row)
{
  vec3 p =
    texture(brdfDistributionINSTANCE, vec2(sqrt(brdfQuadrant(length(h.xy), h.z)), row)).rgb;
  vec3 fresnel =
    texture(brdfFresnelINSTANCE, vec2(brdfQuadrant(length(i - o), length(i + o)), 0.5)).rgb;
  return p * fresnel / (4.0 * (i.z + o.z - i.z * o.z));
}

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  vec3 h = brdfHalfVector(i, o);
  bool levels = brdfNumberOfLevelsINSTANCE > 0.0;
  return brdfRowINSTANCE(i, o, h, levels ? 0.5 / brdfNumberOfLevelsINSTANCE : brdfTurn(h.xy));
}

vec3 brdfTermSoftINSTANCE(vec3 i, vec3 o, float spread)
{
  if (brdfNumberOfLevelsINSTANCE == 0.0)
  {
    return brdfTermINSTANCE(i, o);
  }
  vec3 h = brdfHalfVector(i, o);
  float unit = brdfOwnVarianceINSTANCE;
  float level = min(
    log2(1.0 + brdfHalfVectorSpread(spread, dot(h, o)) / unit) / log2(1.0 + 1.0 / unit), 1.0);
  return brdfRowINSTANCE(
    i, o, h, (0.5 + level * (brdfNumberOfLevelsINSTANCE - 1.0)) / brdfNumberOfLevelsINSTANCE);
}
