// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The thesis's light loop: sum_j f(i_j,o) cos(theta_j) E_j (2.3.2). C++ twin: vtkLightSetIntegrator.
uniform mat3 envMatrix;               // VTK's own: view -> the renderer's environment
uniform mat3 brdfEnvironmentRotation; // the environment's own rotation on top
uniform sampler2D brdfLights;         // two texels a light: direction, irradiance
uniform int brdfNumberOfLights;

vec3 brdfSumLightSet(mat3 frameVC, vec3 o)
{
  mat3 frame = brdfEnvironmentRotation * envMatrix * frameVC;
  vec3 sum = vec3(0.0);
  int lightsPerRow = textureSize(brdfLights, 0).x / 2;
  for (int k = 0; k < brdfNumberOfLights; ++k)
  {
    ivec2 texel = ivec2(2 * (k % lightsPerRow), k / lightsPerRow);
    vec3 i = texelFetch(brdfLights, texel, 0).xyz * frame;
    if (i.z > 0.0)
    {
      sum += brdfEvaluate(i, o) * texelFetch(brdfLights, texel + ivec2(1, 0), 0).rgb * i.z;
    }
  }
  return sum;
}
