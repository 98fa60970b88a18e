// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  // A light at the camera. Other passes look for the next line's text.
  radiance = lightColor0;
  brdfLight = vec3(0.0, 0.0, 1.0) * brdfFrame;
  if (brdfLight.z > 0.0)
  {
    brdfRadiance += brdfEvaluate(brdfLight, brdfView) * radiance * brdfLight.z;
    //VTK::MeasuredBRDF::TubeLight
  }
