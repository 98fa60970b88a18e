// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Table over half and difference angles. C++ twin: vtkTabulatedBRDF, HALF_DIFFERENCE.
uniform sampler3D brdfVolumeINSTANCE; // phi_d, theta_d 2/pi, sqrt(theta_h 2/pi)
uniform float brdfScaleINSTANCE;
uniform float brdfTurnsINSTANCE; // periods of phi_d in 2 pi: 2 where f(i,o) = f(o,i) is built in
uniform float brdfCosineWeightedINSTANCE; // 1: the table holds f cos(theta_o)

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  vec3 a = brdfHalfDifference(i, brdfHalfVector(i, o));
  vec3 u = vec3(a.x * brdfTurnsINSTANCE / (2.0 * brdfPi), a.y * (2.0 / brdfPi),
    sqrt(a.z * (2.0 / brdfPi)));
  return brdfUnpremultiply(texture(brdfVolumeINSTANCE, u)) *
    (brdfScaleINSTANCE / mix(1.0, o.z, brdfCosineWeightedINSTANCE));
}
