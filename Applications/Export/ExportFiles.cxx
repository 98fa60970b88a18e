// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ExportFiles.h"

#include "Lobes.h"
#include "NumberText.h"

#include "vtkBase64Utilities.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

using nlohmann::ordered_json;

namespace tool
{
//------------------------------------------------------------------------------
ordered_json GetJson(const ModelFit& fit, const ModelParameter& parameter)
{
  return parameter.Size == 3 ? ordered_json(fit.Model->GetColor(parameter.Name))
                             : ordered_json(fit.Model->GetNumber(parameter.Name));
}

namespace
{
// The parameters of the parts that the fit took, as a file has them.
std::vector<ModelParameter> GetTakenParameters(const ModelFit& fit)
{
  std::vector<Feature> parts = fit.Features;
  parts.push_back(Feature::Core);
  std::vector<ModelParameter> taken;
  std::copy_if(fit.Model->GetParameters().begin(), fit.Model->GetParameters().end(),
    std::back_inserter(taken),
    [&](const ModelParameter& parameter)
    { return std::find(parts.begin(), parts.end(), parameter.Part) != parts.end(); });
  return taken;
}

//------------------------------------------------------------------------------
// "0.5", or "0.5, 0.25, 1".
std::string GetText(const ModelFit& fit, const ModelParameter& parameter)
{
  if (parameter.Size == 1)
  {
    return FormatValue(fit.Model->GetNumber(parameter.Name));
  }
  const std::array<double, 3> color = fit.Model->GetColor(parameter.Name);
  return FormatValue(color[0]) + ", " + FormatValue(color[1]) + ", " + FormatValue(color[2]);
}

//------------------------------------------------------------------------------
constexpr int Columns = 64; // quads about the axis
constexpr int Rows = 32;

//------------------------------------------------------------------------------
template <typename T>
void Append(std::string& bytes, T value)
{
  // The format is little-endian, as all machines are that this is built for.
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

//------------------------------------------------------------------------------
// The bytes of a unit sphere, which the file's views and accessors describe.
std::string AddBall(ordered_json& file)
{
  std::string positions, tangents, indices, bytes;
  for (int k = 0; k < (Rows + 1) * (Columns + 1); ++k)
  {
    const double theta = Pi * (k / (Columns + 1)) / Rows;
    const double phi = 2.0 * Pi * (k % (Columns + 1)) / Columns;
    // Azimuth from +z to +x about +y: the tangent (n.z, 0, -n.x) leads along it.
    for (const double value :
      { std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi) })
    {
      Append(positions, static_cast<float>(value));
    }
    for (const double value : { std::cos(phi), 0.0, -std::sin(phi), 1.0 })
    {
      Append(tangents, static_cast<float>(value));
    }
  }
  for (int k = 0; k < Rows * Columns; ++k)
  {
    const int corner = k / Columns * (Columns + 1) + k % Columns;
    const int below = corner + Columns + 1;
    for (const int index : { corner, below, below + 1, corner, below + 1, corner + 1 })
    {
      Append(indices, static_cast<std::uint16_t>(index));
    }
  }
  const auto add =
    [&](const std::string& data, int target, int type, std::size_t size, const char* kind)
  {
    file["accessors"].push_back({ { "bufferView", file["bufferViews"].size() },
      { "componentType", type }, { "count", data.size() / size }, { "type", kind } });
    file["bufferViews"].push_back({ { "buffer", 0 }, { "byteOffset", bytes.size() },
      { "byteLength", data.size() }, { "target", target } });
    bytes += data; // all lengths are multiples of 4
  };
  constexpr int arrayBuffer = 34962, elementBuffer = 34963, single = 5126, unsignedShort = 5123;
  add(positions, arrayBuffer, single, 12, "VEC3");
  file["accessors"][0]["min"] = { -1.0, -1.0, -1.0 };
  file["accessors"][0]["max"] = { 1.0, 1.0, 1.0 };
  add(positions, arrayBuffer, single, 12, "VEC3"); // a unit sphere's normals
  add(tangents, arrayBuffer, single, 16, "VEC4");
  add(indices, elementBuffer, unsignedShort, 2, "SCALAR");
  return bytes;
}

//------------------------------------------------------------------------------
std::string EncodeBase64(const std::string& bytes)
{
  std::vector<unsigned char> text(4 * (bytes.size() / 3 + 2));
  const auto size = vtkBase64Utilities::Encode(reinterpret_cast<const unsigned char*>(bytes.data()),
    static_cast<unsigned long>(bytes.size()), text.data());
  return { text.begin(), text.begin() + static_cast<std::ptrdiff_t>(size) };
}

//------------------------------------------------------------------------------
// The GLB container (specification, chapter 4).
std::string MakeContainer(std::string json, const std::string& bytes)
{
  json.append((4 - json.size() % 4) % 4, ' ');
  std::string file = "glTF";
  Append(file, std::uint32_t{ 2 });
  Append(file, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + bytes.size()));
  Append(file, static_cast<std::uint32_t>(json.size()));
  file += "JSON" + json;
  Append(file, static_cast<std::uint32_t>(bytes.size()));
  file += std::string("BIN\0", 4) + bytes;
  return file;
}

//------------------------------------------------------------------------------
std::string MakeInput(
  const std::string& name, const std::string& type, const std::string& attribute)
{
  return "    <input name=\"" + name + "\" type=\"" + type + "\" " + attribute + " />\n";
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
std::string MakeMaterialXMaterial(const ModelFit& fit, const std::string& name)
{
  const std::string node = fit.Model->GetTitle();
  const std::string prefix = name + "_" + node + "_";
  const bool turned = node == "open_pbr_surface" && fit.Model->HasFeature(Feature::Anisotropy);
  std::string text =
    turned ? MakeTurnedTangent(prefix, fit.Model->GetNumber("tangent_rotation")) : std::string();
  text += "  <" + node + " name=\"" + prefix + "shader\" type=\"surfaceshader\">\n";
  text += MakeInput(node == "standard_surface" ? "base" : "base_weight", "float", "value=\"1\"");
  for (const ModelParameter& parameter : GetTakenParameters(fit))
  {
    if (parameter.Name != "tangent_rotation")
    {
      text += MakeInput(parameter.Name, parameter.Size == 3 ? "color3" : "float",
        "value=\"" + GetText(fit, parameter) + "\"");
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

//------------------------------------------------------------------------------
// All of vtkProperty's values that its physically based shading takes, by the setters' names.
ordered_json GetPropertyValues(const ModelFit& fit)
{
  constexpr int pbr = 3; // VTK_PBR
  ordered_json values = { { "Interpolation", pbr } };
  for (const ModelParameter& parameter : fit.Model->GetParameters())
  {
    values[parameter.Name] = GetJson(fit, parameter);
  }
  values["Ambient"] = 0.0;
  values["Diffuse"] = 1.0;
  values["CoatColor"] = { 1.0, 1.0, 1.0 };
  return values;
}
}

//------------------------------------------------------------------------------
const std::vector<ExportTarget>& GetExportTargets()
{
  using Fits = const std::vector<ModelFit>&;
  using Text = const std::string&;
  static const std::vector<ExportTarget> targets = {
    { "gltf", { ".gltf", ".glb" }, { "gltf" },
      "glTF 2.0, metallic-roughness with the extensions that the fit needs, on a ball",
      [](Fits fits, Text name, bool binary) { return MakeGltf(fits[0], name, binary); } },
    { "mtlx", { ".mtlx" }, { "standard_surface", "open_pbr" },
      "MaterialX, standard_surface and open_pbr_surface",
      [](Fits fits, Text name, bool) { return MakeMaterialX(fits, name); } },
    { "usda", { ".usda" }, { "preview_surface" }, "USD, UsdPreviewSurface on a ball",
      [](Fits fits, Text name, bool) { return MakeUsd(fits[0], name); } },
    { "vtk-json", { ".json" }, { "vtk_pbr" }, "JSON, the values that vtkProperty's setters take",
      [](Fits fits, Text name, bool) { return MakeVtkJson(fits[0], name); } },
    { "paraview-state", { ".py" }, { "vtk_pbr" }, "a Python script that shows it in ParaView",
      [](Fits fits, Text name, bool) { return MakeParaViewScript(fits[0], name); } }
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
  for (std::size_t at = 0; at < values.size(); ++at)
  {
    const ModelParameter& parameter = *model->GetNumbers()[at].Parameter;
    if (values[at] != parameter.Neutral)
    {
      // Down where a bound has more decimals.
      const double rounded = std::round(1e4 * values[at]) / 1e4;
      values[at] = rounded <= parameter.Most ? rounded : std::floor(1e4 * values[at]) / 1e4;
    }
  }
  model->SetValues(values);
}

//------------------------------------------------------------------------------
std::string MakeGltf(const ModelFit& fit, const std::string& name, bool binary)
{
  ordered_json file = ordered_json::parse(R"({
    "asset": { "version": "2.0", "generator": "measured-brdf" },
    "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "name": "ball", "mesh": 0 }],
    "meshes": [{ "name": "ball", "primitives": [{ "indices": 3, "material": 0,
      "attributes": { "POSITION": 0, "NORMAL": 1, "TANGENT": 2 } }] }] })");
  const std::string bytes = AddBall(file);
  file["buffers"] = ordered_json::array({ { { "byteLength", bytes.size() } } });
  if (!binary)
  {
    file["buffers"][0]["uri"] = "data:application/octet-stream;base64," + EncodeBase64(bytes);
  }
  ordered_json material = { { "name", name } };
  ordered_json base = fit.Model->GetColor("baseColorFactor");
  base.push_back(1.0);
  material["pbrMetallicRoughness"] = { { "baseColorFactor", base },
    { "metallicFactor", fit.Model->GetNumber("metallicFactor") },
    { "roughnessFactor", fit.Model->GetNumber("roughnessFactor") } };
  for (const Feature feature : fit.Features)
  {
    const std::string extension =
      std::string("KHR_materials_") +
      (feature == Feature::Coat ? "clearcoat" : GetFeatureName(feature));
    file["extensionsUsed"].push_back(extension);
    for (const ModelParameter& parameter : fit.Model->GetParameters())
    {
      if (parameter.Part == feature)
      {
        material["extensions"][extension][parameter.Name] = GetJson(fit, parameter);
      }
    }
  }
  file["materials"] = ordered_json::array({ material });
  const std::string text =
    file.dump(binary ? -1 : 1, ' ', true, ordered_json::error_handler_t::replace);
  return binary ? MakeContainer(text, bytes) : text + "\n";
}

//------------------------------------------------------------------------------
// MaterialX documents (specification 1.38; 1.39 where it holds an open_pbr_surface).
std::string MakeMaterialX(const std::vector<ModelFit>& fits, const std::string& name)
{
  const bool openPbr = std::any_of(fits.begin(), fits.end(),
    [](const ModelFit& fit) { return fit.Model->GetTitle() == "open_pbr_surface"; });
  std::string text = "<?xml version=\"1.0\"?>\n<materialx version=\"";
  text += openPbr ? "1.39" : "1.38";
  text += "\" colorspace=\"lin_rec709\">\n";
  for (const ModelFit& fit : fits)
  {
    text += MakeMaterialXMaterial(fit, MakeIdentifier(name));
  }
  return text + "</materialx>\n";
}

//------------------------------------------------------------------------------
std::string MakeUsd(const ModelFit& fit, const std::string& name)
{
  std::string inputs;
  for (const ModelParameter& parameter : GetTakenParameters(fit))
  {
    const std::string text = GetText(fit, parameter);
    inputs += std::string("                ") + (parameter.Size == 3 ? "color3f" : "float") +
              " inputs:" + parameter.Name + " = " +
              (parameter.Size == 3 ? "(" + text + ")" : text) + "\n";
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
