// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// An environment at every resolution: levels of an equal-area octahedral map below each other, each
// with a border of one texel. C++ twin: Module/Lighting/EnvironmentPyramid.h.

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
  float scale = exp2(-level);
  vec2 texel = uv * (size * scale) + vec2(1.0, 2.0 * (size * (1.0 - scale) + level) + 1.0);
  return textureLod(atlas, texel / vec2(textureSize(atlas, 0)), 0.0).rgb;
}

// Mean radiance about unit d on level lod (0: finest; fractions in between; clamped).
vec3 brdfPyramid(sampler2D atlas, vec3 d, float lod)
{
  float size = float(textureSize(atlas, 0).x - 2);
  vec2 uv = clamp(brdfToSquare(d), 0.0, 0.999999);
  float last = floor(log2(size) + 0.5);
  lod = clamp(lod, 0.0, last);
  float level = min(floor(lod), max(last - 1.0, 0.0));
  vec3 fine = brdfPyramidLevel(atlas, uv, size, level);
  return lod > level
    ? mix(fine, brdfPyramidLevel(atlas, uv, size, level + 1.0), lod - level)
    : fine;
}
