// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The sharp part of radiance, factored: sum over k of W_k(theta_o) A_k(axis), A_k turned by the
// azimuth of the plane of incidence. C++ twin: RadianceCore.
uniform sampler2D brdfCoreProfileINSTANCE; // over theta_o: (0, cos, sin delta); W_k
uniform sampler3D brdfCoreFieldsINSTANCE; // azimuth and polar angle of axis; A_k, two slices where turned
uniform float brdfCoreLastViewINSTANCE; // the profile's last theta_o, in quarter turns

const int brdfCoreOrdersINSTANCE[CORE_MODES] = int[CORE_MODES](CORE_ORDERS); // ascending

vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)
{
  float sine = length(o.xy);
  float u = 1.0 - sqrt(max(1.0 - brdfQuadrant(sine, o.z) / brdfCoreLastViewINSTANCE, 0.0));
  vec2 profile = vec2(textureSize(brdfCoreProfileINSTANCE, 0));
  u = (u * (profile.x - 1.0) + 0.5) / profile.x;
  vec3 axis = texture(brdfCoreProfileINSTANCE, vec2(u, 0.5 / profile.y)).xyz;
  vec2 azimuth = sine > 1e-6 ? o.xy / sine : vec2(1.0, 0.0);
  vec3 across = frame[0] * azimuth.x + frame[1] * azimuth.y;
  vec3 along = axis.y * across + axis.z * frame[2];

  vec3 meridian, parallel;
  vec2 position =
    brdfMapPosition(normalize(axis.y * frame[2] - axis.z * across), meridian, parallel);
  vec2 once = vec2(dot(along, meridian), dot(along, parallel));
  once /= max(length(once), 1e-12);
  vec2 turn = vec2(1.0, 0.0); // cosine and sine of order times psi
  vec3 size = vec3(textureSize(brdfCoreFieldsINSTANCE, 0));
  vec3 at = vec3(position, 0.5 / size.z); // values lie at texels' centers
  vec3 sum = vec3(0.0);
  int order = 0;
  for (int k = 0; k < CORE_MODES; ++k)
  {
    for (; order < brdfCoreOrdersINSTANCE[k]; ++order)
    {
      turn = vec2(turn.x * once.x - turn.y * once.y, turn.x * once.y + turn.y * once.x);
    }
    vec3 field = texture(brdfCoreFieldsINSTANCE, at).rgb;
    at.z += 1.0 / size.z;
    if (order > 0)
    {
      field = turn.x * field + turn.y * texture(brdfCoreFieldsINSTANCE, at).rgb;
      at.z += 1.0 / size.z;
    }
    sum += field * texture(brdfCoreProfileINSTANCE, vec2(u, (float(k) + 1.5) / profile.y)).rgb;
  }
  return sum;
}
