// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What vtkBRDFEnvironmentTable.glsl, which comes behind it, lacks of sharp lobes: sum over k of
// W_k(theta_o) A_k(axis), A_k turned by the azimuth of the plane of incidence. C++ twin:
// RadianceCore.
uniform sampler2D brdfCoreProfileINSTANCE; // over theta_o: W_0, W_1, ..., four numbers a row
uniform sampler2D brdfCoreFieldsINSTANCE; // A_k, two where turned, one above the other

struct brdfCorePlaceINSTANCE
{
  vec2 Field; // where the next field is read
  vec2 Once; // cosine and sine of the azimuth
  vec2 Turn; // and of so many times the azimuth
};

vec3 brdfCoreFieldINSTANCE(inout brdfCorePlaceINSTANCE at)
{
  vec3 field = texture(brdfCoreFieldsINSTANCE, at.Field).rgb;
  at.Field.y += 1.0 / float(CORE_FIELDS);
  return field;
}

// To the next order.
void brdfCoreTurnINSTANCE(inout brdfCorePlaceINSTANCE at)
{
  at.Turn = vec2(at.Turn.x * at.Once.x - at.Turn.y * at.Once.y,
    at.Turn.x * at.Once.y + at.Turn.y * at.Once.x);
}

vec3 brdfCoreTurnedINSTANCE(inout brdfCorePlaceINSTANCE at)
{
  vec3 cosine = brdfCoreFieldINSTANCE(at);
  vec3 sine = brdfCoreFieldINSTANCE(at);
  return at.Turn.x * cosine + at.Turn.y * sine;
}

// view: where profiles are read; position: of the axis in maps; once: cosine and sine of the azimuth,
// of any length.
vec3 brdfCoreINSTANCE(int view, vec2 position, vec2 once)
{
  float next = 1.0 / float(CORE_FIELDS); // texels' centers; no field reaches into the next
  float margin = 0.5 / float(textureSize(brdfCoreFieldsINSTANCE, 0).y);
  brdfCorePlaceINSTANCE at;
  at.Field = vec2(position.x, clamp(position.y * next, margin, next - margin));
  at.Once = once / max(length(once), 1e-12);
  at.Turn = vec2(1.0, 0.0);
  vec3 sum = vec3(0.0);
  CORE_STEPS // one after the other: loops are slow in software
  return sum;
}
