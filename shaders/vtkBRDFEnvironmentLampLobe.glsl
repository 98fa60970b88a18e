// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// f averaged over a lamp, a table of f cos(theta_o) over half and difference angles. C++ twin:
// LampBRDF.
uniform sampler3D brdfLampLobeINSTANCE; // coordinates of brdfHalfDifference, half a turn of phi_d
uniform float brdfLampLobeScaleINSTANCE;

vec3 brdfLampINSTANCE(vec3 i, vec3 o)
{
  vec3 u = brdfHalfDifference(i, o);
  u.x = 2.0 * abs(u.x - floor(u.x + 0.5)); // both sides are alike
  return texture(brdfLampLobeINSTANCE, u).rgb * (brdfLampLobeScaleINSTANCE / o.z);
}
