// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  // Scalars are display colours, as VTK's own PBR takes them.
  if (brdfModulate != 0)
  {
    brdfRadiance *= pow(max(diffuseColor, vec3(0.0)), vec3(2.2));
  }
  // Nothing negative, infinite or NaN reaches a pixel (comparisons with NaN are false).
  brdfRadiance.r = brdfRadiance.r > 0.0 ? min(brdfRadiance.r, 1e9) : 0.0;
  brdfRadiance.g = brdfRadiance.g > 0.0 ? min(brdfRadiance.g, 1e9) : 0.0;
  brdfRadiance.b = brdfRadiance.b > 0.0 ? min(brdfRadiance.b, 1e9) : 0.0;
  // VTK's PBR encodes here too, and its tone mapping pass expects that.
  vec3 color = pow(brdfRadiance, vec3(1.0 / 2.2));
  //VTK::MeasuredBRDF::Edges
  gl_FragData[0] = vec4(color, opacity);
  //VTK::Light::Impl
