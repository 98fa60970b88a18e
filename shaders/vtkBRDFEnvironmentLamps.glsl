// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What vtkBRDFEnvironmentTable.glsl, which comes behind it, lacks near lamps: sum over j of
// w(d, i_j) (f(i_j, o) - lambert) cos(theta_j) E_j, d the lobe's axis. C++ twins: TableLamps,
// LampWindow.
// Two texels for each lamp, then for each part of one: direction, irradiance. A lamp's fourth component:
// COUNT_BASE times its first part, which may be itself, and how many it has.
uniform sampler2D brdfLightsINSTANCE;
uniform float brdfLampReachINSTANCE; // the window ends where reach (1 - cosine of the angle) is 1
uniform float brdfPartsNearnessINSTANCE; // of lamps that are the sum of their parts, at least
LAMP_UNIFORMS

// part: 0 or 1 of the two texels.
vec4 brdfLampTexelINSTANCE(float index, float part)
{
  float row = floor((index + 0.5) / LIGHTS_PER_ROW); // integers divide slowly
  ivec2 at = ivec2(int(2.0 * (index - LIGHTS_PER_ROW * row) + part), int(row));
  return texelFetch(brdfLightsINSTANCE, at, 0);
}

// 1 on the axis, 0 where the window ends, less beyond.
float brdfLampNearnessINSTANCE(vec3 direction, vec3 d)
{
  return 1.0 - brdfLampReachINSTANCE * (1.0 - dot(direction, d));
}

// Lamps are found once for a pixel, and by selections: software renderers (Mesa's llvmpipe) run both
// sides of a condition, and a loop's first turn always. So the material is evaluated in one place,
// once for each part of a lamp that was found, or once, by which nothing shows (and so for each 31 of
// more lamps than that).
vec3 brdfAddLampsINSTANCE(mat3 frame, vec3 o, vec3 d, vec3 lambert)
{
  vec3 sum = vec3(0.0);
  for (int first = 0; first < LAMP_COUNT; first += LAMPS_AT_ONCE)
  {
    int found = 0; // a bit for each lamp whose window holds the axis
    FIND_LAMPS
    float part = 0.0;
    do
    {
      float lamp = float(first) + floor(log2(float(max(found & -found, 1))) + 0.5); // lowest bit's
      vec4 whole = brdfLampTexelINSTANCE(lamp, 0.0);
      float nearness =
        found != 0 ? clamp(brdfLampNearnessINSTANCE(whole.rgb, d), 0.0, 1.0) : 0.0;
      vec3 direction = whole.rgb;
      float index = lamp;
      bool isLast = true;
      if (HAVE_PARTS != 0)
      {
        bool isWhole = nearness < brdfPartsNearnessINSTANCE;
        float firstPart = floor(whole.a / COUNT_BASE);
        index = isWhole ? lamp : firstPart + part;
        direction = brdfLampTexelINSTANCE(index, 0.0).rgb;
        part += 1.0;
        isLast = isWhole || part >= whole.a - COUNT_BASE * firstPart;
        part = isLast ? 0.0 : part;
      }
      vec3 i = direction * frame;
      float root = nearness * (2.0 - nearness); // 1 - x x
      vec3 f = EVALUATE_LAMP(i.z > 0.0 ? i : vec3(0.0, 0.0, 1.0), o);
      sum += BRDF_OPEN_LAMP(int(lamp)) (f - lambert) * brdfLampTexelINSTANCE(index, 1.0).rgb *
        (root * root * max(i.z, 0.0));
      found = isLast ? found & (found - 1) : found;
    } while (found != 0);
  }
  return sum;
}
