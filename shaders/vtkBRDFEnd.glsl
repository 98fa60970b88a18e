// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  // Colors of scalars and blocks are display colors; VTK's "diffuse intensity" is set to 1 here.
  if (BRDF_TAKES_COLOR)
  {
    brdfRadiance *= pow(max(diffuseColor, vec3(0.0)), vec3(2.2));
  }
  // Nothing negative, infinite or NaN reaches a pixel (comparisons with NaN are false). The largest
  // radiance is what framebuffers of half floats hold once it is encoded (65504^2.2 = 3.9e10): more
  // than the sun's 1.6e9 cd/m2, for maps in that unit.
  brdfRadiance.r = brdfRadiance.r > 0.0 ? min(brdfRadiance.r, 3e10) : 0.0;
  brdfRadiance.g = brdfRadiance.g > 0.0 ? min(brdfRadiance.g, 3e10) : 0.0;
  brdfRadiance.b = brdfRadiance.b > 0.0 ? min(brdfRadiance.b, 3e10) : 0.0;
  // VTK's PBR encodes here too, and its tone mapping pass expects that.
  vec3 color = pow(brdfRadiance, vec3(1.0 / 2.2));
  //VTK::MeasuredBRDF::Edges
  // What a user's replacement of the next tag may read of VTK's own shading.
  vec3 diffuse = color;
  vec3 specular = vec3(0.0);
  gl_FragData[0] = vec4(color, opacity);
  //VTK::Light::Impl
