// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// USD as text: a ball with a UsdPreviewSurface.
#include "ExportFiles.h"

#include <algorithm>

namespace tool
{
//------------------------------------------------------------------------------
std::string MakeUsd(const ModelFit& fit, const std::string& name)
{
  std::string inputs;
  for (const ModelParameter& parameter : fit.Model->GetParameters())
  {
    const bool taken =
      parameter.Part == Feature::Core ||
      std::find(fit.Features.begin(), fit.Features.end(), parameter.Part) != fit.Features.end();
    if (!taken)
    {
      continue;
    }
    if (parameter.Size == 3)
    {
      const std::array<double, 3> color = fit.Model->GetColor(parameter.Name);
      inputs += "                color3f inputs:" + parameter.Name + " = (" +
                FormatValue(color[0]) + ", " + FormatValue(color[1]) + ", " +
                FormatValue(color[2]) + ")\n";
    }
    else
    {
      inputs += "                float inputs:" + parameter.Name + " = " +
                FormatValue(fit.Model->GetNumber(parameter.Name)) + "\n";
    }
  }
  const std::string material = MakeIdentifier(name);
  const std::string path = "/World/Materials/" + material;
  return R"(#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Y"
)

def Xform "World"
{
    def Sphere "Ball" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    )
    {
        float3[] extent = [(-1, -1, -1), (1, 1, 1)]
        double radius = 1
        rel material:binding = <)" +
         path + R"(>
    }

    def Scope "Materials"
    {
        def Material ")" +
         material + R"("
        {
            token outputs:surface.connect = <)" +
         path + R"(/Surface.outputs:surface>

            def Shader "Surface"
            {
                uniform token info:id = "UsdPreviewSurface"
                int inputs:useSpecularWorkflow = 0
)" + inputs +
         R"(                token outputs:surface
            }
        }
    }
}
)";
}
} // namespace tool
