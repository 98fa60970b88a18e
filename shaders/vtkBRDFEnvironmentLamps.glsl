// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What vtkBRDFEnvironmentTable.glsl, which comes behind it, lacks near lamps: sum over j of
// w(d, i_j) (f(i_j, o) - lambert) cos(theta_j) E_j, d the lobe's axis. C++ twins: TableLamps,
// LampWindow.
// Two texels for each lamp, then for each part of one: direction, irradiance. Their fourth
// components: a lamp's first part, which may be itself, and how many it has.
uniform sampler2D brdfLightsINSTANCE;
uniform float brdfLampReachINSTANCE; // the window ends where reach (1 - cosine of the angle) is 1
uniform float brdfPartsNearnessINSTANCE; // of lamps that are the sum of their parts, at least
LAMP_UNIFORMS

struct brdfLampsINSTANCE
{
  float Wanted; // one of those that the window holds
  float Count; // so many there are
  float Index; // the wanted one
  float Nearness; // its: 1 on the axis, 0 where the window ends
};

// part: 0 or 1 of the two texels.
vec4 brdfLampTexelINSTANCE(float index, float part)
{
  float row = floor((index + 0.5) / LIGHTS_PER_ROW); // integers divide slowly
  ivec2 at = ivec2(int(2.0 * (index - LIGHTS_PER_ROW * row) + part), int(row));
  return texelFetch(brdfLightsINSTANCE, at, 0);
}

// Selections and no conditions: software renderers (Mesa's llvmpipe) run both sides of these.
void brdfFindLampINSTANCE(float index, vec3 direction, vec3 d, inout brdfLampsINSTANCE lamps)
{
  float nearness = 1.0 - brdfLampReachINSTANCE * (1.0 - dot(direction, d));
  bool isNear = nearness > 0.0;
  bool isWanted = isNear && lamps.Count == lamps.Wanted;
  lamps.Index = isWanted ? index : lamps.Index;
  lamps.Nearness = isWanted ? nearness : lamps.Nearness;
  lamps.Count += isNear ? 1.0 : 0.0;
}

// The material is evaluated in one place, once for each part of a lamp that the window holds, or
// once: a loop's first turn is always run, too.
vec3 brdfAddLampsINSTANCE(mat3 frame, vec3 o, vec3 d, vec3 lambert)
{
  vec3 sum = vec3(0.0);
  brdfLampsINSTANCE lamps;
  lamps.Wanted = 0.0;
  float part = 0.0;
  do
  {
    lamps.Count = 0.0;
    lamps.Index = 0.0;
    lamps.Nearness = 0.0;
    FIND_LAMPS
    bool isWhole = lamps.Nearness < brdfPartsNearnessINSTANCE;
    float index = isWhole ? lamps.Index : brdfLampTexelINSTANCE(lamps.Index, 0.0).a + part;
    vec3 i = brdfLampTexelINSTANCE(index, 0.0).rgb * frame;
    float root = lamps.Nearness * (2.0 - lamps.Nearness); // 1 - x x
    vec3 f = EVALUATE_LAMP(i.z > 0.0 ? i : vec3(0.0, 0.0, 1.0), o);
    sum += BRDF_OPEN_LAMP(int(lamps.Index)) (f - lambert) *
      brdfLampTexelINSTANCE(index, 1.0).rgb * (root * root * max(i.z, 0.0));
    part += 1.0;
    bool isLast = isWhole || part >= brdfLampTexelINSTANCE(lamps.Index, 1.0).a;
    lamps.Wanted += isLast ? 1.0 : 0.0;
    part = isLast ? 0.0 : part;
  } while (lamps.Wanted < lamps.Count);
  return sum;
}
