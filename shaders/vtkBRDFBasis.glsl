// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The thesis's pair of 3D textures: sum_k C_k(o) B_k(i), one slice per k. C++ twin: vtkBasisBRDF.
uniform sampler3D brdfCoefficientsINSTANCE; // phi_o, theta_o, k
uniform sampler3D brdfBasisINSTANCE;        // phi_i, acos(x), k
uniform float brdfScaleINSTANCE;
uniform float brdfIsotropicINSTANCE;  // 1: phi_i counts from phi_o
uniform vec3 brdfIncidentZoneINSTANCE; // near cosine, its squared sine, near minus far cosine
uniform float brdfGammaRangeINSTANCE; // half of acos(x) at the table's end, in right angles
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
  // How far i.z lies below the near cosine, next to the normal by squared sines: cosines near 1
  // have too few digits to tell directions apart. acos(x) = 2 atan(sqrt(below), sqrt(above)).
  vec3 zone = brdfIncidentZoneINSTANCE;
  float below = zone.y < 0.5 ? (dot(i.xy, i.xy) - zone.y) / (i.z + zone.x) : zone.x - i.z;
  below = clamp(below, 0.0, zone.z);
  float g = brdfQuadrant(sqrt(below), sqrt(zone.z - below)) / brdfGammaRangeINSTANCE;
  vec2 size = vec2(textureSize(brdfBasisINSTANCE, 0).xy);
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
