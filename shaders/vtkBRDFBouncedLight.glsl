// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What comes back to a point from what hides the sky from it, for the vertex shader. C++ twin
// (tests): Testing/Render/OcclusionReference.h.

// Irradiance: nine bytes of a code, three in each float, times the light's harmonics, whose factors
// hold the steps of the bytes and the albedo of what is hidden.
vec3 brdfBouncedIrradiance(vec3 code, vec3 light[9])
{
  vec3 a = brdfSkyBytes(code.x);
  vec3 b = brdfSkyBytes(code.y) - 127.0;
  vec3 c = brdfSkyBytes(code.z) - 127.0;
  vec3 sum = light[0] + (a.y - 127.0) * light[1] + (a.z - 127.0) * light[2] + b.x * light[3] +
    b.y * light[4] + b.z * light[5] + c.x * light[6] + c.y * light[7] + c.z * light[8];
  return max(a.x * a.x * sum, vec3(0.0));
}

// Radiance that a point reflects of it: its Lambert part of the irradiance, its lobe where that is
// hidden of the mean radiance there. cosine: hidden share under a uniform sky.
vec3 brdfBouncedRadiance(vec3 irradiance, vec3 lambert, vec3 lobe, float share, float cosine)
{
  return irradiance * (lambert + lobe * (share / (3.141592653589793 * max(cosine, 1e-3))));
}
