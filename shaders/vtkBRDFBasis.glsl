// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The thesis's pair of 3D textures: sum_k C_k(o) B_k(i), one slice per k. C++ twin: vtkBasisBRDF.
uniform sampler3D brdfCoefficientsINSTANCE; // phi_o, theta_o, k
uniform sampler3D brdfBasisINSTANCE;        // phi_i, acos(x), k
uniform float brdfScaleINSTANCE;
uniform float brdfIsotropicINSTANCE;  // 1: phi_i counts from phi_o
uniform vec3 brdfIncidentZoneINSTANCE; // near and far cosine, turns of acos(x) in the table
uniform vec3 brdfOutgoingZoneINSTANCE; // begin, 1 / width in right angles
uniform vec3 brdfIncidentCosineINSTANCE; // limits of the cosine to divide by; 1, 1: none
uniform vec3 brdfOutgoingCosineINSTANCE;

// The coefficients of a view serve all lights: fetched once.
vec3 brdfCoefficientINSTANCE[BRDF_BASIS_FUNCTIONS];
vec3 brdfCoefficientViewINSTANCE = vec3(0.0);

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  const int n = BRDF_BASIS_FUNCTIONS;
  if (o != brdfCoefficientViewINSTANCE)
  {
    brdfCoefficientViewINSTANCE = o;
    vec2 size = vec2(textureSize(brdfCoefficientsINSTANCE, 0).xy);
    float t = clamp((brdfQuadrant(length(o.xy), o.z) - brdfOutgoingZoneINSTANCE.x) *
      brdfOutgoingZoneINSTANCE.y, 0.0, 1.0);
    vec2 u = vec2(brdfTurn(o.xy) + 0.5 / size.x, (t * (size.y - 1.0) + 0.5) / size.y);
    float divisor = clamp(o.z, brdfOutgoingCosineINSTANCE.x, brdfOutgoingCosineINSTANCE.y);
    for (int k = 0; k < n; ++k)
    {
      brdfCoefficientINSTANCE[k] =
        texture(brdfCoefficientsINSTANCE, vec3(u, (float(k) + 0.5) / float(n))).rgb *
        (brdfScaleINSTANCE / divisor);
    }
  }
  vec2 azimuth = brdfIsotropicINSTANCE > 0.5
    ? vec2(dot(i.xy, o.xy), o.x * i.y - o.y * i.x) : i.xy;
  float x = clamp(2.0 * (i.z - brdfIncidentZoneINSTANCE.y) /
    (brdfIncidentZoneINSTANCE.x - brdfIncidentZoneINSTANCE.y) - 1.0, -1.0, 1.0);
  vec2 size = vec2(textureSize(brdfBasisINSTANCE, 0).xy);
  float g = brdfTurn(vec2(x, sqrt(1.0 - x * x))) / brdfIncidentZoneINSTANCE.z;
  vec2 u = vec2(brdfTurn(azimuth) + 0.5 / size.x,
    (clamp(g, 0.0, 1.0) * (size.y - 1.0) + 0.5) / size.y);
  vec3 sum = vec3(0.0);
  for (int k = 0; k < n; ++k)
  {
    sum += brdfCoefficientINSTANCE[k] *
      texture(brdfBasisINSTANCE, vec3(u, (float(k) + 0.5) / float(n))).r;
  }
  return max(sum, vec3(0.0)) /
    clamp(i.z, brdfIncidentCosineINSTANCE.x, brdfIncidentCosineINSTANCE.y);
}
