// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What sub-frames of samples added up before (SampleSums.h): the front-most surface's at each pixel.
uniform sampler2D brdfSum;    // radiance of samples, all sub-frames together; their number
uniform sampler2D brdfOthers; // radiance of all else; depth, 0 where nothing is
uniform ivec2 brdfSumOrigin;  // of the viewport

// The radiance and 1 where the sum is of this fragment's surface, or where that lies behind the
// sum's in all pixels around, so that it does not show. Elsewhere 0: it is evaluated here.
vec4 brdfFindSum()
{
  ivec2 at = ivec2(gl_FragCoord.xy) - brdfSumOrigin;
  ivec2 last = textureSize(brdfSum, 0) - 1;
  float near = 1e-6 + fwidth(gl_FragCoord.z); // between a pixel's samples
  vec4 sum = texelFetch(brdfSum, clamp(at, ivec2(0), last), 0);
  vec4 others = texelFetch(brdfOthers, clamp(at, ivec2(0), last), 0);
  bool hidden = true;
  for (int k = 0; k < 9; ++k)
  {
    ivec2 beside = clamp(at + ivec2(k % 3, k / 3) - 1, ivec2(0), last);
    float depth = texelFetch(brdfOthers, beside, 0).a;
    hidden = hidden && depth > 0.0 && gl_FragCoord.z > depth + near;
  }
  bool own = others.a > 0.0 && abs(gl_FragCoord.z - others.a) <= near;
  return own || hidden ? vec4(others.rgb + sum.rgb / max(sum.a, 1.0), 1.0) : vec4(0.0);
}
