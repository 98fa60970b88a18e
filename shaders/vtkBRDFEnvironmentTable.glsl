// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Radiance integrated ahead of time: c E(n) + s T(axis, view angle, azimuth), and what
// vtkBRDFEnvironmentCore.glsl adds. C++ twin: vtkTableRadianceIntegrator.
uniform sampler2D brdfTableProfileINSTANCE; // over theta_o: (view angle, cos, sin delta); s; c
uniform sampler3D brdfTableRadianceINSTANCE; // azimuth and polar angle of axis; psi within view angles
uniform sampler2D brdfTableIrradianceINSTANCE; // octahedral, over the normal
uniform float brdfTableAnglesINSTANCE;
uniform float brdfTableLastViewINSTANCE; // the profile's last theta_o, in quarter turns

vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)
{
  float sine = length(o.xy);
  float u = 1.0 - sqrt(max(1.0 - brdfQuadrant(sine, o.z) / brdfTableLastViewINSTANCE, 0.0));
  u *= float(textureSize(brdfTableProfileINSTANCE, 0).x - 1);
  vec3 axis = brdfProfile(brdfTableProfileINSTANCE, u, 0);
  vec2 azimuth = sine > 1e-6 ? o.xy / sine : vec2(1.0, 0.0);
  vec3 across = frame[0] * azimuth.x + frame[1] * azimuth.y;
  vec3 d = normalize(axis.y * frame[2] - axis.z * across);
  vec3 along = axis.y * across + axis.z * frame[2];

  vec3 meridian, parallel;
  vec2 position = brdfMapPosition(d, meridian, parallel);
  vec2 turn = vec2(dot(along, meridian), dot(along, parallel));
  float psi = brdfTurn(turn);
  vec3 core = SHARP_PART;
  vec3 size = vec3(textureSize(brdfTableRadianceINSTANCE, 0));
  float slices = size.z / brdfTableAnglesINSTANCE; // the first azimuth comes again after the last
  float w = clamp(axis.x, 0.0, brdfTableAnglesINSTANCE - 1.0);
  float angle = min(floor(w), brdfTableAnglesINSTANCE - 2.0);
  vec3 at = vec3(position.x + 0.5 / size.x, (position.y * (size.y - 1.0) + 0.5) / size.y,
    (angle * slices + fract(psi) * (slices - 1.0) + 0.5) / size.z);
  vec3 low = texture(brdfTableRadianceINSTANCE, at).rgb;
  at.z += slices / size.z;
  vec3 high = texture(brdfTableRadianceINSTANCE, at).rgb;
  vec3 sum = BRDF_OPEN_LOBE(mix(low, high, w - angle) *
    brdfProfile(brdfTableProfileINSTANCE, u, 1));
  if (HAS_FLOOR != 0)
  {
    float side = float(textureSize(brdfTableIrradianceINSTANCE, 0).x);
    vec2 normalAt = (brdfOctahedralPosition(frame[2]) * (side - 1.0) + 0.5) / side;
    sum += BRDF_OPEN_IRRADIANCE(texture(brdfTableIrradianceINSTANCE, normalAt).rgb) *
      brdfProfile(brdfTableProfileINSTANCE, u, 2);
  }
  return max(max(sum, vec3(0.0)) + BRDF_OPEN_LOBE(core), vec3(0.0));
}
