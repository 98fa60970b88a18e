// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// VTK's and ParaView's physically based shading.
#include "ExportFiles.h"

#include <nlohmann/json.hpp>

using nlohmann::ordered_json;

namespace tool
{
namespace
{
//------------------------------------------------------------------------------
// All of vtkProperty's values that its physically based shading takes, by the setters' names.
ordered_json GetPropertyValues(const ModelFit& fit)
{
  constexpr int pbr = 3; // VTK_PBR
  ordered_json values = { { "Interpolation", pbr } };
  for (const ModelParameter& parameter : fit.Model->GetParameters())
  {
    if (parameter.Size == 3)
    {
      values[parameter.Name] = fit.Model->GetColor(parameter.Name);
    }
    else
    {
      values[parameter.Name] = fit.Model->GetNumber(parameter.Name);
    }
  }
  values["Ambient"] = 0.0;
  values["Diffuse"] = 1.0;
  values["CoatColor"] = { 1.0, 1.0, 1.0 };
  return values;
}
}

//------------------------------------------------------------------------------
std::string MakeVtkJson(const ModelFit& fit, const std::string& name)
{
  const ordered_json file = { { "format", "measured-brdf vtkProperty" }, { "version", 1 },
    { "material", name }, { "color_space", "linear Rec. 709" },
    { "property", GetPropertyValues(fit) } };
  return file.dump(1, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

//------------------------------------------------------------------------------
std::string MakeParaViewScript(const ModelFit& fit, const std::string& name)
{
  ordered_json values = GetPropertyValues(fit);
  values["Interpolation"] = "PBR";
  values["DiffuseColor"] = values["AmbientColor"] = values["Color"];
  values.erase("Color");
  std::string lines;
  for (const auto& value : values.items())
  {
    lines += "    " + ordered_json(value.key()).dump() + ": " + value.value().dump() + ",\n";
  }
  // Python takes JSON's strings, but for its pairs of escapes for one character.
  const std::string quoted =
    ordered_json(name).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  return R"(# A sphere with VTK's physically based shading, fitted to a material by measured-brdf.
# Load it in ParaView (File, Load State) or run it with pvpython. Colors are linear.
from paraview.simple import GetActiveViewOrCreate, RenameSource, Render, Show, Sphere

VALUES = {
)" + lines +
         R"(}

view = GetActiveViewOrCreate("RenderView")
sphere = Sphere(Radius=1.0, ThetaResolution=128, PhiResolution=128)
RenameSource()" +
         quoted + R"(, sphere)
display = Show(sphere, view)
display.ColorArrayName = ["POINTS", ""]
for name, value in VALUES.items():
    setattr(display, name, value)
view.ResetCamera()
Render(view)
)";
}
} // namespace tool
