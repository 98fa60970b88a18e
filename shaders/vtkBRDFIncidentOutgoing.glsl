// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Table over incident and outgoing angles. C++ twin: vtkTabulatedBRDF, INCIDENT_OUTGOING.
uniform sampler3D brdfVolumeINSTANCE; // delta phi, theta_o 2/pi, theta_i 2/pi
uniform float brdfScaleINSTANCE;
uniform float brdfTurnsINSTANCE; // 2: mirror-symmetric, delta phi in [0, pi]
uniform float brdfCosineWeightedINSTANCE; // 1: the table holds f cos(theta_o)

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  float phi = brdfTurn(vec2(dot(i.xy, o.xy), i.x * o.y - i.y * o.x));
  phi = brdfTurnsINSTANCE > 1.5 ? abs(phi) : phi;
  vec3 u = vec3(phi * brdfTurnsINSTANCE, brdfQuadrant(length(o.xy), o.z),
    brdfQuadrant(length(i.xy), i.z));
  return brdfUnpremultiply(texture(brdfVolumeINSTANCE, u)) *
    (brdfScaleINSTANCE / mix(1.0, o.z, brdfCosineWeightedINSTANCE));
}
