// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The thesis's light loop: sum_j f(i_j,o) cos(theta_j) E_j (2.3.2). C++ twin: vtkLightSetRadianceIntegrator.
LIGHT_UNIFORMS

vec3 brdfLightINSTANCE(vec4 light, vec3 irradiance, mat3 frame, vec3 o)
{
  vec3 i = light.xyz * frame;
  if (i.z > 0.0)
  {
    return EVALUATE_LIGHT * irradiance * i.z;
  }
  return vec3(0.0);
}

vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)
{
  vec3 sum = vec3(0.0);
  ADD_LIGHTS
  return BRDF_OPEN_LIGHTS(sum);
}
