// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Radiance integrated ahead of time: c E(n) + s T(axis, view angle, azimuth), and what
// vtkBRDFEnvironmentCore.glsl and vtkBRDFEnvironmentLamps.glsl add. C++ twin: vtkTableRadianceIntegrator.
uniform sampler2D brdfTableProfileINSTANCE; // over theta_o: s, sin delta - sin theta_o; below it c
uniform sampler3D brdfTableRadianceINSTANCE; // azimuth and polar angle of axis; psi within view angles
uniform sampler2D brdfTableIrradianceINSTANCE; // octahedral, over the normal
uniform float brdfTableIrradianceScaleINSTANCE; // of its values
uniform float brdfTableRowsINSTANCE; // of the map that is everywhere; tiles lie below it
uniform float brdfTableAnglesINSTANCE;
uniform float brdfTableLastViewINSTANCE; // the profile's last theta_o, in quarter turns

vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)
{
  float sine = length(o.xy);
  float rest = max(1.0 - brdfQuadrant(sine, o.z) / brdfTableLastViewINSTANCE, 0.0);
  int view = int((1.0 - sqrt(rest)) * float(textureSize(brdfTableProfileINSTANCE, 0).x - 1) + 0.5);
  vec4 profile = texelFetch(brdfTableProfileINSTANCE, ivec2(view, 0), 0);
  vec3 lambert = HAS_FLOOR != 0 ? texelFetch(brdfTableProfileINSTANCE, ivec2(view, 1), 0).rgb : vec3(0.0);
  float sinDelta = sine + profile.w;
  vec2 axis = vec2(sqrt(max(1.0 - sinDelta * sinDelta, 0.0)), sinDelta);
  vec2 azimuth = sine > 1e-6 ? o.xy / sine : vec2(1.0, 0.0);
  vec3 across = frame[0] * azimuth.x + frame[1] * azimuth.y;
  vec3 d = axis.x * frame[2] - axis.y * across;
  vec3 along = axis.x * across + axis.y * frame[2];

  vec3 meridian, parallel;
  vec2 position = brdfMapPosition(d, meridian, parallel);
  vec2 turn = vec2(dot(along, meridian), dot(along, parallel));
  float psi = brdfTurn(turn);
  vec3 core = SHARP_PART;
  vec3 size = vec3(textureSize(brdfTableRadianceINSTANCE, 0));
  float slices = size.z / brdfTableAnglesINSTANCE; // the first azimuth comes again after the last
  float w = (brdfTableAnglesINSTANCE - 1.0) * (1.0 - pow(rest, 2.0 / 3.0)); // among view angles
  float angle = min(floor(w), brdfTableAnglesINSTANCE - 2.0);
  vec2 tile = TILE_PART; // texels
  vec2 inMap = position * vec2(size.x, brdfTableRowsINSTANCE - 1.0);
  vec3 at = vec3(((tile.y < 0.0 ? inMap : tile) + 0.5) / size.xy,
    (angle * slices + fract(psi) * (slices - 1.0) + 0.5) / size.z);
  vec3 low = texture(brdfTableRadianceINSTANCE, at).rgb;
  at.z += slices / size.z;
  vec3 high = texture(brdfTableRadianceINSTANCE, at).rgb;
  vec3 sum = BRDF_OPEN_LOBE(mix(low, high, w - angle) * profile.rgb);
  if (HAS_FLOOR != 0)
  {
    float side = float(textureSize(brdfTableIrradianceINSTANCE, 0).x);
    vec2 normalAt = (brdfOctahedralPosition(frame[2]) * (side - 1.0) + 0.5) / side;
    vec3 irradiance = brdfTableIrradianceScaleINSTANCE *
      texture(brdfTableIrradianceINSTANCE, normalAt).rgb;
    sum += BRDF_OPEN_IRRADIANCE(irradiance) * lambert;
  }
  sum += LAMPS_PART;
  return max(max(sum, vec3(0.0)) + BRDF_OPEN_LOBE(core), vec3(0.0));
}
