// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// f = ks (n+2)/(2 pi) (n.h)^n, the constant in brdfScale. C++ twin: vtkBlinnPhongBRDF.
uniform vec3 brdfScaleINSTANCE;
uniform float brdfExponentINSTANCE;

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  vec3 h = brdfHalfVector(i, o);
  float s = dot(h.xy, h.xy);
  return max(brdfScaleINSTANCE, vec3(0.0)) *
    exp(0.5 * brdfExponentINSTANCE * s * brdfLogCosineRatio(s));
}

vec3 brdfTermSoftINSTANCE(vec3 i, vec3 o, float spread)
{
  vec3 h = brdfHalfVector(i, o);
  float s = dot(h.xy, h.xy);
  float n = brdfWidenedExponent(brdfExponentINSTANCE, brdfHalfVectorSpread(spread, dot(h, o)));
  return max(brdfScaleINSTANCE, vec3(0.0)) * ((n + 2.0) / (brdfExponentINSTANCE + 2.0)) *
    exp(0.5 * n * s * brdfLogCosineRatio(s));
}
