// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  // Measured material: everything below is linear until the end.
  mat3 brdfFrame = brdfFrameAbout(normalVCVSOutput);
  //VTK::MeasuredBRDF::Tangent
  vec3 brdfView = cameraParallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);
  brdfView = brdfLiftView(brdfView * brdfFrame);
  //VTK::MeasuredBRDF::Weights
  vec3 brdfRadiance = brdfEnvironment(brdfFrame, brdfView);
  vec3 radiance, brdfLight;
  vec3 brdfTube = vec3(0.0); // light on edges that are drawn as tubes
