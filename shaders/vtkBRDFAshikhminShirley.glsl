// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Ashikhmin and Shirley 2000; constants folded into the uniforms. C++ twin: vtkAshikhminShirleyBRDF.
uniform vec3 brdfScaleINSTANCE;
uniform vec3 brdfReflectanceINSTANCE;
uniform vec3 brdfDiffuseINSTANCE;
uniform vec3 brdfExponentsINSTANCE; // nu, nv
uniform float brdfIndexINSTANCE;    // 0: Schlick's Fresnel term

// A lobe of other exponents and, with them, another scale.
vec3 brdfLobeINSTANCE(vec3 i, vec3 o, vec3 h, vec2 exponents, float scale)
{
  float hd = dot(h, o);
  float s = dot(h.xy, h.xy);
  float lobe = exp(0.5 * dot(exponents, h.xy * h.xy) * brdfLogCosineRatio(s));
  vec3 fresnel = brdfIndexINSTANCE > 0.0
    ? vec3(brdfDielectricFresnel(brdfIndexINSTANCE, hd))
    : mix(brdfReflectanceINSTANCE, vec3(1.0), brdfSchlickFifth(hd));
  vec3 specular = brdfScaleINSTANCE * fresnel * (scale * lobe / (hd * max(i.z, o.z)));
  float di = 1.0 - brdfSchlickFifth(0.5 * i.z);
  float dv = 1.0 - brdfSchlickFifth(0.5 * o.z);
  return max(specular + brdfDiffuseINSTANCE * (di * dv), vec3(0.0));
}

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  return brdfLobeINSTANCE(i, o, brdfHalfVector(i, o), brdfExponentsINSTANCE.xy, 1.0);
}

vec3 brdfTermSoftINSTANCE(vec3 i, vec3 o, float spread)
{
  vec3 h = brdfHalfVector(i, o);
  float variance = brdfHalfVectorSpread(spread, dot(h, o));
  vec2 n = vec2(brdfWidenedExponent(brdfExponentsINSTANCE.x, variance),
    brdfWidenedExponent(brdfExponentsINSTANCE.y, variance));
  vec2 ratio = (n + 1.0) / (brdfExponentsINSTANCE.xy + 1.0);
  return brdfLobeINSTANCE(i, o, h, n, sqrt(ratio.x * ratio.y));
}
