// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  // Where a vertex has no normal the facet's, towards the viewer (comparisons with NaN are false).
  vec3 brdfFacet = normalize(cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz)));
  brdfFacet *= dot(brdfFacet, cameraParallel == 1 ? vec3(0.0, 0.0, 1.0) : -vertexVC.xyz) < 0.0 ? -1.0 : 1.0;
  normalVCVSOutput = dot(normalVCVSOutput, normalVCVSOutput) > 0.25 ? normalVCVSOutput : brdfFacet;
