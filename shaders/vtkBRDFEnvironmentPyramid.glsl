// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// An environment at every resolution: an equal-area octahedral map and on its right its halvings
// below each other, each with a border of one texel. C++ twin: EnvironmentPyramid.h.

// Unit direction -> [0,1]^2 (Clarberg 2008).
vec2 brdfToSquare(vec3 d)
{
  float r = sqrt(max(1.0 - abs(d.z), 0.0));
  float v = r * brdfQuadrant(abs(d.y), abs(d.x));
  vec2 uv = vec2(r - v, v);
  uv = d.z < 0.0 ? 1.0 - uv.yx : uv;
  return 0.5 * vec2(d.x < 0.0 ? -uv.x : uv.x, d.y < 0.0 ? -uv.y : uv.y) + 0.5;
}

vec3 brdfPyramidLevel(sampler2D atlas, vec2 uv, float size, float level)
{
  vec2 origin = level > 0.0
    ? vec2(size + 2.0, size * (1.0 - exp2(1.0 - level)) + 2.0 * (level - 1.0))
    : vec2(0.0);
  vec2 texel = uv * floor(size * exp2(-level)) + origin + 1.0;
  return textureLod(atlas, texel / vec2(textureSize(atlas, 0)), 0.0).rgb;
}

// Mean radiance about unit d on level lod (0: finest; fractions in between; clamped).
vec3 brdfPyramid(sampler2D atlas, vec3 d, float lod)
{
  float size = floor(float(textureSize(atlas, 0).x - 4) / 1.5 + 0.5);
  vec2 uv = clamp(brdfToSquare(d), 0.0, 0.999999);
  float last = floor(log2(size) + 0.1);
  lod = clamp(lod, 0.0, last);
  float level = min(floor(lod), max(last - 1.0, 0.0));
  vec3 fine = brdfPyramidLevel(atlas, uv, size, level);
  return lod > level
    ? mix(fine, brdfPyramidLevel(atlas, uv, size, level + 1.0), lod - level)
    : fine;
}
