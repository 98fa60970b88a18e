// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Radiance of anisotropic materials, integrated ahead of time: c E(n) + s T(axis, tangent's azimuth,
// view). C++ twin: AnisotropicTable.
uniform sampler3D brdfTableProfileINSTANCE; // theta_o; phi_o; (axis along and across the view, view angle), s, c
// Azimuth of the axis; polar angle of the axis within phi_o; the tangent's azimuth within theta_o.
uniform sampler3D brdfTableRadianceINSTANCE;
uniform sampler2D brdfTableIrradianceINSTANCE; // octahedral, over the normal
uniform float brdfTableIrradianceScaleINSTANCE; // of its values
uniform float brdfTableLastViewINSTANCE; // the last theta_o, in quarter turns

// Between two view angles at one of the view's azimuths. psi in turns.
vec3 brdfTurnedRadianceINSTANCE(vec2 position, float view, float psi, float angle, float between)
{
  vec3 size = vec3(textureSize(brdfTableRadianceINSTANCE, 0));
  float rows = size.y / VIEW_AZIMUTHS;
  float slices = size.z / VIEW_ANGLES; // the first psi comes again after the last
  vec3 at = vec3(position.x + 0.5 / size.x,
    (view * rows + position.y * (rows - 1.0) + 0.5) / size.y,
    (angle * slices + fract(psi) * (slices - 1.0) + 0.5) / size.z);
  vec3 low = texture(brdfTableRadianceINSTANCE, at).rgb;
  at.z += slices / size.z;
  return mix(low, texture(brdfTableRadianceINSTANCE, at).rgb, between);
}

vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)
{
  vec3 tangent = frame[0];
  vec3 bitangent = frame[1];
  if (PERIODS > 1.5 && o.y < 0.0) // the same after half a turn
  {
    tangent = -tangent;
    bitangent = -bitangent;
    o.xy = -o.xy;
  }
  float sine = length(o.xy);
  vec2 azimuth = sine > 1e-6 ? o.xy / sine : vec2(1.0, 0.0);
  float theta = brdfQuadrant(sine, o.z) / brdfTableLastViewINSTANCE;
  float phi = PERIODS * fract(brdfTurn(azimuth)); // of the period
  vec3 profileSize = vec3(textureSize(brdfTableProfileINSTANCE, 0));
  float u = 1.0 - sqrt(max(1.0 - theta, 0.0));
  vec3 place = vec3((u * (profileSize.x - 1.0) + 0.5) / profileSize.x, phi + 0.5 / profileSize.y,
    0.5 / 3.0);

  // The axis, and the tangent carried there by the smallest rotation.
  vec3 parts = texture(brdfTableProfileINSTANCE, place).xyz;
  vec2 level = vec2(parts.x * azimuth.x - parts.y * azimuth.y,
    parts.x * azimuth.y + parts.y * azimuth.x);
  float up = sqrt(max(1.0 - dot(level, level), 0.0));
  vec3 d = normalize(level.x * tangent + level.y * bitangent + up * frame[2]);
  float bend = level.x / (1.0 + up);
  vec3 along = (1.0 - level.x * bend) * tangent - level.y * bend * bitangent - level.x * frame[2];

  vec3 meridian, parallel;
  vec2 position = brdfMapPosition(d, meridian, parallel);
  float psi = brdfTurn(vec2(dot(along, meridian), dot(along, parallel)));
  float w = clamp(parts.z, 0.0, VIEW_ANGLES - 1.0);
  float angle = min(floor(w), VIEW_ANGLES - 2.0);
  float p = phi * VIEW_AZIMUTHS;
  float view = min(floor(p), VIEW_AZIMUTHS - 1.0);
  vec3 low = brdfTurnedRadianceINSTANCE(position, view, psi, angle, w - angle);
  // After the last azimuth the first one comes again, in a frame that is turned by the period.
  bool again = view > VIEW_AZIMUTHS - 1.5;
  vec3 high = brdfTurnedRadianceINSTANCE(position, again ? 0.0 : view + 1.0,
    again ? psi + 1.0 / PERIODS : psi, angle, w - angle);
  place.z = 1.5 / 3.0;
  vec3 sum = mix(low, high, p - view) * texture(brdfTableProfileINSTANCE, place).rgb;
  if (HAS_FLOOR != 0)
  {
    place.z = 2.5 / 3.0;
    float side = float(textureSize(brdfTableIrradianceINSTANCE, 0).x);
    vec2 normalAt = (brdfOctahedralPosition(frame[2]) * (side - 1.0) + 0.5) / side;
    sum += brdfTableIrradianceScaleINSTANCE * texture(brdfTableIrradianceINSTANCE, normalAt).rgb *
      texture(brdfTableProfileINSTANCE, place).rgb;
  }
  return max(sum, vec3(0.0));
}
