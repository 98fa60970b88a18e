// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ExportFiles.h"

#include "NumberText.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tool
{
//------------------------------------------------------------------------------
const std::vector<ExportTarget>& GetExportTargets()
{
  static const std::vector<ExportTarget> targets = {
    { "gltf", { ".gltf", ".glb" }, { "gltf" },
      "glTF 2.0, metallic-roughness with the extensions that the fit needs, on a ball" },
    { "mtlx", { ".mtlx" }, { "standard_surface", "open_pbr" },
      "MaterialX, standard_surface and open_pbr_surface" },
    { "usda", { ".usda" }, { "preview_surface" }, "USD, UsdPreviewSurface on a ball" },
    { "vtk-json", { ".json" }, { "vtk_pbr" }, "JSON, the values that vtkProperty's setters take" },
    { "paraview-state", { ".py" }, { "vtk_pbr" }, "a Python script that shows it in ParaView" }
  };
  return targets;
}

//------------------------------------------------------------------------------
std::string MakeIdentifier(const std::string& name)
{
  std::string result;
  for (const char c : name)
  {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    if (result.empty() && !letter)
    {
      result = "material_";
    }
    result += letter || digit ? c : '_';
  }
  return result.empty() ? "material" : result;
}

//------------------------------------------------------------------------------
std::string FormatValue(double value)
{
  std::string result = measuredbrdf::FixedText(value, 4);
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.')
  {
    result.pop_back();
  }
  return result == "-0" ? "0" : result;
}

//------------------------------------------------------------------------------
void RoundValues(SurfaceModel* model)
{
  std::vector<double> values = model->GetValues();
  std::size_t at = 0;
  for (const ModelParameter& parameter : model->GetParameters())
  {
    for (std::size_t c = 0; c < parameter.Size; ++c, ++at)
    {
      if (values[at] != parameter.Neutral)
      {
        // Down where a bound has more decimals.
        const double rounded = std::round(1e4 * values[at]) / 1e4;
        values[at] = rounded <= parameter.Most ? rounded : std::floor(1e4 * values[at]) / 1e4;
      }
    }
  }
  model->SetValues(values);
}
} // namespace tool
