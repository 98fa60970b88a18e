// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  radiance = lightColorLIGHT;
  brdfLight = -lightDirectionVCLIGHT;
  if (lightPositionalLIGHT != 0)
  {
    // Attenuation and cone as the stock mapper has them.
    brdfLight = lightPositionVCLIGHT - vertexVC.xyz;
    float brdfDistanceLIGHT = length(brdfLight);
    brdfLight /= brdfDistanceLIGHT;
    float brdfAttenuationLIGHT = 1.0 /
      (lightAttenuationLIGHT.x + lightAttenuationLIGHT.y * brdfDistanceLIGHT +
        lightAttenuationLIGHT.z * brdfDistanceLIGHT * brdfDistanceLIGHT);
    if (lightConeAngleLIGHT < 90.0)
    {
      float brdfConeLIGHT = dot(-brdfLight, lightDirectionVCLIGHT);
      brdfAttenuationLIGHT *= brdfConeLIGHT >= cos(radians(lightConeAngleLIGHT))
        ? pow(brdfConeLIGHT, lightExponentLIGHT)
        : 0.0;
    }
    radiance *= brdfAttenuationLIGHT;
  }
  brdfLight = normalize(brdfLight) * brdfFrame;
  if (brdfLight.z > 0.0)
  {
    brdfRadiance += brdfEvaluate(brdfLight, brdfView) * radiance * brdfLight.z;
    //VTK::MeasuredBRDF::TubeLight
  }
