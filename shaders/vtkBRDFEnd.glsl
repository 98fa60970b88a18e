// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  // Colors of scalars and blocks are display colors; VTK's "diffuse intensity" is set to 1 here.
  if (BRDF_TAKES_COLOR)
  {
    brdfRadiance *= pow(max(diffuseColor, vec3(0.0)), vec3(2.2));
  }
  // Nothing negative, infinite or NaN reaches a pixel (comparisons with NaN are false). Maps may be
  // in any unit; tone mapping squares what it gets, which has to stay finite.
  brdfRadiance.r = brdfRadiance.r > 0.0 ? min(brdfRadiance.r, 1e18) : 0.0;
  brdfRadiance.g = brdfRadiance.g > 0.0 ? min(brdfRadiance.g, 1e18) : 0.0;
  brdfRadiance.b = brdfRadiance.b > 0.0 ? min(brdfRadiance.b, 1e18) : 0.0;
  // VTK's PBR encodes here too, and its tone mapping pass expects that.
  vec3 color = pow(brdfRadiance, vec3(1.0 / 2.2));
  //VTK::MeasuredBRDF::Edges
  // What a user's replacement of the next tag may read of VTK's own shading.
  vec3 diffuse = color;
  vec3 specular = vec3(0.0);
  gl_FragData[0] = vec4(color, opacity);
  //VTK::Light::Impl
