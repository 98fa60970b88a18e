// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The thesis's light loop: sum_j f(i_j,o) cos(theta_j) E_j (2.3.2). C++ twin: vtkLightSetRadianceIntegrator.
uniform sampler2D brdfLightsINSTANCE; // two texels a light: direction and 1/kappa, irradiance
uniform float brdfNumberOfLightsINSTANCE;

vec3 brdfLightINSTANCE(int k, int lightsPerRow, mat3 frame, vec3 o)
{
  ivec2 texel = ivec2(2 * (k % lightsPerRow), k / lightsPerRow);
  vec4 light = texelFetch(brdfLightsINSTANCE, texel, 0);
  vec3 i = light.xyz * frame;
  if (i.z > 0.0)
  {
    return EVALUATE_LIGHT * texelFetch(brdfLightsINSTANCE, texel + ivec2(1, 0), 0).rgb * i.z;
  }
  return vec3(0.0);
}

vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)
{
  vec3 sum = vec3(0.0);
  int perRow = textureSize(brdfLightsINSTANCE, 0).x / 2;
  ADD_LIGHTS
  return sum;
}
