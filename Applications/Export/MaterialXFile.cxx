// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// MaterialX documents (specification 1.38; 1.39 where it holds an open_pbr_surface).
#include "ExportFiles.h"

#include <algorithm>

namespace tool
{
namespace
{
//------------------------------------------------------------------------------
std::string MakeInput(
  const std::string& name, const std::string& type, const std::string& attribute)
{
  return "    <input name=\"" + name + "\" type=\"" + type + "\" " + attribute + " />\n";
}

//------------------------------------------------------------------------------
std::string MakeValue(SurfaceModel* model, const ModelParameter& parameter)
{
  std::string text;
  if (parameter.Size == 3)
  {
    for (const double value : model->GetColor(parameter.Name))
    {
      text += (text.empty() ? "" : ", ") + FormatValue(value);
    }
  }
  else
  {
    text = FormatValue(model->GetNumber(parameter.Name));
  }
  return "value=\"" + text + "\"";
}

//------------------------------------------------------------------------------
// Nodes that turn the tangent for open_pbr_surface, which has no input for an angle.
std::string MakeTurnedTangent(const std::string& prefix, double turns)
{
  const std::string space = MakeInput("space", "string", "value=\"world\"");
  return "  <normal name=\"" + prefix + "normal\" type=\"vector3\">\n" + space + "  </normal>\n" +
         "  <tangent name=\"" + prefix + "tangent\" type=\"vector3\">\n" + space +
         "  </tangent>\n" + "  <rotate3d name=\"" + prefix + "turned\" type=\"vector3\">\n" +
         MakeInput("in", "vector3", "nodename=\"" + prefix + "tangent\"") +
         MakeInput("amount", "float", "value=\"" + FormatValue(360.0 * turns) + "\"") +
         MakeInput("axis", "vector3", "nodename=\"" + prefix + "normal\"") + "  </rotate3d>\n";
}

//------------------------------------------------------------------------------
std::string MakeMaterial(const ModelFit& fit, const std::string& name)
{
  SurfaceModel* model = fit.Model;
  const std::string node = model->GetTitle();
  const std::string prefix = name + "_" + node + "_";
  const bool turned = node == "open_pbr_surface" && model->HasFeature(Feature::Anisotropy);
  std::string text =
    turned ? MakeTurnedTangent(prefix, model->GetNumber("tangent_rotation")) : std::string();
  text += "  <" + node + " name=\"" + prefix + "shader\" type=\"surfaceshader\">\n";
  text += MakeInput(node == "standard_surface" ? "base" : "base_weight", "float", "value=\"1\"");
  for (const ModelParameter& parameter : model->GetParameters())
  {
    const bool taken =
      parameter.Part == Feature::Core ||
      std::find(fit.Features.begin(), fit.Features.end(), parameter.Part) != fit.Features.end();
    if (taken && parameter.Name != "tangent_rotation")
    {
      text += MakeInput(
        parameter.Name, parameter.Size == 3 ? "color3" : "float", MakeValue(model, parameter));
    }
  }
  if (turned)
  {
    text += MakeInput("geometry_tangent", "vector3", "nodename=\"" + prefix + "turned\"");
  }
  text += "  </" + node + ">\n";
  return text + "  <surfacematerial name=\"" + prefix + "material\" type=\"material\">\n" +
         MakeInput("surfaceshader", "surfaceshader", "nodename=\"" + prefix + "shader\"") +
         "  </surfacematerial>\n";
}
}

//------------------------------------------------------------------------------
std::string MakeMaterialX(const std::vector<ModelFit>& fits, const std::string& name)
{
  const bool openPbr = std::any_of(fits.begin(), fits.end(),
    [](const ModelFit& fit) { return fit.Model->GetTitle() == "open_pbr_surface"; });
  std::string text = "<?xml version=\"1.0\"?>\n<materialx version=\"";
  text += openPbr ? "1.39" : "1.38";
  text += "\" colorspace=\"lin_rec709\">\n";
  for (const ModelFit& fit : fits)
  {
    text += MakeMaterial(fit, MakeIdentifier(name));
  }
  return text + "</materialx>\n";
}
} // namespace tool
