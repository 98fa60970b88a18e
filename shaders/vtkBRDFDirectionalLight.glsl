// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  radiance = lightColorLIGHT;
  brdfLight = normalize(-lightDirectionVCLIGHT) * brdfFrame;
  if (brdfLight.z > 0.0)
  {
    brdfRadiance += brdfEvaluate(brdfLight, brdfView) * radiance * brdfLight.z;
    //VTK::MeasuredBRDF::TubeLight
  }
