// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Table over half and difference angles and the half vector's azimuth. C++ twin:
// vtkTabulatedBRDF, ANISOTROPIC.
uniform sampler3D brdfVolumeINSTANCE; // phi_d; theta_d within phi_h; theta_h (brdfHalfDifference)
uniform float brdfScaleINSTANCE;
uniform float brdfTurnsINSTANCE; // periods of phi_h in 2 pi: 2 where half a turn changes nothing
uniform float brdfAzimuthsINSTANCE; // samples of phi_h
uniform float brdfCosineWeightedINSTANCE; // 1: the table holds f cos(theta_o)

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  vec3 u = brdfHalfDifference(i, o);
  vec3 h = brdfHalfVector(i, o);
  float phi = length(h.xy) > 1e-7 ? brdfTurn(h.xy) : 0.0;
  float at = fract(brdfTurnsINSTANCE * phi) * brdfAzimuthsINSTANCE - 0.5;
  float low = floor(at);
  float rows = float(textureSize(brdfVolumeINSTANCE, 0).y) / brdfAzimuthsINSTANCE;
  float row = clamp(u.y * rows, 0.5, rows - 0.5); // no azimuth reaches into the next
  vec2 places = vec2(low < 0.0 ? brdfAzimuthsINSTANCE - 1.0 : low,
    low + 1.5 < brdfAzimuthsINSTANCE ? low + 1.0 : 0.0);
  places = (places * rows + row) / (rows * brdfAzimuthsINSTANCE);
  vec3 value = mix(texture(brdfVolumeINSTANCE, vec3(u.x, places.x, u.z)).rgb,
    texture(brdfVolumeINSTANCE, vec3(u.x, places.y, u.z)).rgb, at - low);
  return max(value, vec3(0.0)) *
    (brdfScaleINSTANCE / mix(1.0, o.z, brdfCosineWeightedINSTANCE));
}
