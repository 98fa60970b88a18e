// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What sub-frames of samples added up before (SampleSums.h): the front-most surface's at each pixel.
uniform sampler2D brdfSum;        // radiance, all sub-frames together; their number
uniform sampler2D brdfSumDepth;   // depth, likewise
uniform ivec2 brdfSumOrigin;      // of the viewport
uniform int brdfSubframes;        // in the whole
ivec2 brdfPart = ivec2(0, 1);     // what is evaluated here: sub-frame x of y

// The mean radiance and 1 where the sum is of this fragment. Elsewhere 0: all samples are evaluated
// here, but one sub-frame's where the surface lies behind the sum's in all pixels around, so that
// nothing shows of it.
vec4 brdfFindSum()
{
  ivec2 at = ivec2(gl_FragCoord.xy) - brdfSumOrigin;
  ivec2 last = textureSize(brdfSum, 0) - 1;
  float near = 1e-6 + 0.01 * fwidth(gl_FragCoord.z);
  vec4 sum = texelFetch(brdfSum, clamp(at, ivec2(0), last), 0);
  float depth = texelFetch(brdfSumDepth, clamp(at, ivec2(0), last), 0).r;
  if (sum.a > 0.0 && abs(gl_FragCoord.z * sum.a - depth) <= near * sum.a)
  {
    return vec4(sum.rgb / sum.a, 1.0);
  }
  bool hidden = true;
  for (int k = 0; k < 9; ++k)
  {
    ivec2 beside = clamp(at + ivec2(k % 3, k / 3) - 1, ivec2(0), last);
    float count = texelFetch(brdfSum, beside, 0).a;
    hidden = hidden && count > 0.0 &&
      gl_FragCoord.z * count > texelFetch(brdfSumDepth, beside, 0).r + near * count;
  }
  brdfPart = ivec2(0, hidden ? brdfSubframes : 1);
  return vec4(0.0);
}
