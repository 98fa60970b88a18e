// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightTexture.h"

#include "vtkLightSet.h"

#include <algorithm>
#include <cstddef>

namespace measuredbrdf
{
double GetSpread(vtkLightSet* lights, int index)
{
  const double concentration = lights->GetConcentration(index);
  return concentration > 0.0 ? 1.0 / concentration : 0.0;
}

vtkBRDFShaderInputs::Texture MakeLightTexture(vtkLightSet* lights)
{
  const int count = lights->GetNumberOfLights();
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfLights";
  texture.Components = 4;
  texture.Dimensions = { 2 * std::clamp(count, 1, LightsPerRow),
    std::max((count + LightsPerRow - 1) / LightsPerRow, 1), 1 };
  texture.Data.resize(4 * static_cast<std::size_t>(texture.Dimensions[0]) *
                      static_cast<std::size_t>(texture.Dimensions[1]));
  for (int k = 0; k < count; ++k)
  {
    double direction[3], irradiance[3];
    lights->GetDirection(k, direction);
    lights->GetIrradiance(k, irradiance);
    float* texel = &texture.Data[8 * static_cast<std::size_t>(k)];
    for (int c = 0; c < 3; ++c)
    {
      texel[c] = static_cast<float>(direction[c]);
      texel[4 + c] = static_cast<float>(irradiance[c]);
    }
    texel[3] = static_cast<float>(GetSpread(lights, k));
  }
  return texture;
}
} // namespace measuredbrdf
