// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// f = albedo / pi. C++ twin: vtkLambertBRDF.
uniform vec3 brdfAlbedoINSTANCE;

vec3 brdfTermINSTANCE(vec3 i, vec3 o)
{
  return max(brdfAlbedoINSTANCE, vec3(0.0)) / brdfPi;
}
