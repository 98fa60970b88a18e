// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Filtered importance sampling of the material's sharp part, lights for its broad part. C++ twin:
// vtkFilteredRadianceIntegrator.
uniform sampler2D brdfPyramidMapINSTANCE;
uniform sampler2D brdfDirectionsINSTANCE; // a column per sample, rows by view: direction, level
uniform sampler2D brdfWeightsINSTANCE;    // likewise: weight, the view's f cos that is half broad
uniform sampler2D brdfLightsINSTANCE;     // likewise: direction, irradiance below
uniform float brdfLevelINSTANCE;          // of the whole sphere

vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)
{
  // The samples' frame: the view's azimuth is 0.
  float s = length(o.xy);
  vec2 a = s > 1e-6 ? o.xy / s : vec2(1.0, 0.0);
  mat3 turned = mat3(frame * vec3(a, 0.0), frame * vec3(-a.y, a.x, 0.0), frame[2]);
  ivec2 size = textureSize(brdfDirectionsINSTANCE, 0);
  float first = 1.0 - sqrt(max(1.0 - brdfQuadrant(s, o.z), 0.0));
  float last = 0.887158; // the same at the lowest view, cosine 0.02
  float row = (first / last * float(size.y - 1) + 0.5) / float(size.y);
  vec3 sum = vec3(0.0);
  ivec2 part = BRDF_SAMPLES(size.x); // all, or those of a sub-frame
  for (int k = part.x; k < part.y; ++k)
  {
    vec2 uv = vec2((float(k) + 0.5) / float(size.x), row);
    vec4 i = textureLod(brdfDirectionsINSTANCE, uv, 0.0);
    vec4 weight = textureLod(brdfWeightsINSTANCE, uv, 0.0);
    sum += weight.rgb *
      brdfPyramid(brdfPyramidMapINSTANCE, turned * normalize(i.xyz), i.w + brdfLevelINSTANCE);
    vec3 light = texelFetch(brdfLightsINSTANCE, ivec2(k, 0), 0).xyz * frame;
    if (light.z > 0.0)
    {
      vec3 f = brdfEvaluate(light, o) * light.z;
      float ratio = (f.r + f.g + f.b) / max(weight.a, 1e-30);
      sum += f / (1.0 + ratio * ratio) *
        texelFetch(brdfLightsINSTANCE, ivec2(k, 1), 0).rgb;
    }
  }
  return sum * BRDF_SAMPLES_SHARE;
}
