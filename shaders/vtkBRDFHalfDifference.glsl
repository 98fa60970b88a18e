// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Table over half and difference angles. C++ twin: vtkTabulatedBRDF, HALF_DIFFERENCE.
uniform sampler3D brdfVolumeINSTANCE; // coordinates of brdfHalfDifference
uniform float brdfScaleINSTANCE;
uniform float brdfTurnsINSTANCE; // periods of phi_d in 2 pi: 2 where f(i,o) = f(o,i) is built in
uniform float brdfCosineWeightedINSTANCE; // 1: the table holds f cos(theta_o)

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  vec3 u = brdfHalfDifference(i, o);
  u.x *= brdfTurnsINSTANCE;
  return brdfUnpremultiply(texture(brdfVolumeINSTANCE, u)) *
    (brdfScaleINSTANCE / mix(1.0, o.z, brdfCosineWeightedINSTANCE));
}
