// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "State.h"

#include "BoundedJson.h"
#include "Files.h"
#include "Methods.h"
#include "ModelMaterials.h"
#include "StateFields.h"
#include "Tool.h"

#include "vtkRadianceMethods.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

using nlohmann::ordered_json;

namespace
{
const char* const FormatName = "measured-brdf explorer state";
// Version 1 counted exposure from what suits the environment.
constexpr int FormatVersion = 2;
constexpr std::uintmax_t LargestFile = 1 << 20; // bytes

//------------------------------------------------------------------------------
void TakeCamera(const ordered_json& object, const std::string& name, explorer::CameraState& camera)
{
  const explorer::Fields fields(object, name + ": \"camera\"");
  explorer::CameraState read = camera;
  fields.Take("position", read.Position);
  fields.Take("focal_point", read.FocalPoint);
  fields.Take("view_up", read.ViewUp);
  fields.Take("view_angle", read.ViewAngle, 1.0, 120.0);
  double distance = 0.0;
  double up = 0.0;
  for (std::size_t c = 0; c < 3; ++c)
  {
    distance += std::abs(read.Position[c] - read.FocalPoint[c]);
    up += std::abs(read.ViewUp[c]);
  }
  if (!(distance > 0.0))
  {
    fields.Fail("position", "another point than \"focal_point\"");
  }
  if (!(up > 0.0))
  {
    fields.Fail("view_up", "a direction");
  }
  camera = read;
}

//------------------------------------------------------------------------------
void TakeMethods(const explorer::Fields& fields, explorer::State& state)
{
  std::vector<std::string> methods = { state.Methods[0], state.Methods[1] };
  fields.Take("methods", methods);
  std::string known;
  for (const auto& name : explorer::GetMethodNames())
  {
    known += (known.empty() ? "" : ", ") + name.Key;
  }
  for (const std::string& method : methods)
  {
    if (methods.size() != 2 || known.find(method) == std::string::npos ||
        explorer::GetMethodName(method) == method)
    {
      fields.Fail("methods", "two of " + known);
    }
  }
  std::copy(methods.begin(), methods.end(), state.Methods.begin());
}

//------------------------------------------------------------------------------
void TakeCompared(const explorer::Fields& fields, std::vector<std::string>& compared)
{
  fields.Take("compared", compared);
  const std::set<std::string> different(compared.begin(), compared.end());
  if (compared.size() > explorer::MostCompared || different.size() != compared.size() ||
      different.count("") != 0)
  {
    fields.Fail(
      "compared", "at most " + std::to_string(explorer::MostCompared) + " different materials");
  }
}

//------------------------------------------------------------------------------
void TakeModels(const explorer::Fields& fields, explorer::ModelStates& states)
{
  const ordered_json* object = fields.FindObject("models");
  if (!object)
  {
    return;
  }
  const explorer::Fields models(*object, fields.GetName() + ": \"models\"");
  for (const auto& [key, values] : object->items())
  {
    const explorer::ParametricModel* model = explorer::FindModel("model:" + key);
    const ordered_json* given = models.FindObject(key);
    if (!model)
    {
      models.Fail(key, "the name of a model, such as \"Lambert\"");
    }
    const explorer::Fields parameters(*given, models.GetName() + ": \"" + key + "\"");
    for (const auto& [name, value] : values.items())
    {
      const auto parameter = std::find_if(model->Parameters.begin(), model->Parameters.end(),
        [&name = name](const explorer::ModelParameter& one) { return one.Key == name; });
      if (parameter == model->Parameters.end())
      {
        parameters.Fail(name, "a parameter of this model");
      }
      std::vector<double> numbers = parameter->Default;
      parameters.Take(name, numbers, parameter->Least, parameter->Largest);
      if (!parameter->Choices.empty() && numbers[0] != std::floor(numbers[0]))
      {
        parameters.Fail(name, "a whole number");
      }
      states[key][name] = numbers;
    }
  }
}

//------------------------------------------------------------------------------
bool IsEdit(const ordered_json& edit)
{
  return edit.is_array() && edit.size() == 4 && edit[0].is_number_integer() &&
         edit[0].get<double>() >= 0.0 && edit[0].get<double>() < 2147483647.0 &&
         std::all_of(edit.begin() + 1, edit.end(),
           [](const ordered_json& value)
           {
             // Beside the one that was entered stand those of the file, whatever they are.
             return value.is_number() &&
                    std::abs(value.get<double>()) <= std::numeric_limits<float>::max();
           });
}

//------------------------------------------------------------------------------
// {"a.binary": [[row, red, green, blue], ...]}
void TakeEdits(const explorer::Fields& fields, std::map<std::string, explorer::SampleEdits>& edits)
{
  const ordered_json* object = fields.FindObject("edits");
  if (!object)
  {
    return;
  }
  const explorer::Fields materials(*object, fields.GetName() + ": \"edits\"");
  std::size_t count = 0;
  for (const auto& [file, list] : object->items())
  {
    count += list.size();
    if (!list.is_array() || count > explorer::MostEdits ||
        !std::all_of(list.begin(), list.end(), IsEdit))
    {
      materials.Fail(file, "a list of [row, red, green, blue] with finite numbers, at most " +
                             std::to_string(explorer::MostEdits) + " of all materials");
    }
    for (const ordered_json& edit : list)
    {
      edits[file][edit[0].get<int>()] = { edit[1].get<float>(), edit[2].get<float>(),
        edit[3].get<float>() };
    }
  }
}

//------------------------------------------------------------------------------
ordered_json WriteEdits(const std::map<std::string, explorer::SampleEdits>& edits)
{
  ordered_json object = ordered_json::object();
  for (const auto& [file, list] : edits)
  {
    for (const auto& [row, rgb] : list)
    {
      object[file].push_back({ row, rgb[0], rgb[1], rgb[2] });
    }
  }
  return object;
}

//------------------------------------------------------------------------------
// A built-in name, or a path as it is; a relative one that is not here but beside the state file.
std::string Resolve(const std::string& file, const std::filesystem::path& folder)
{
  const std::string path = file.substr(0, file.find('#'));
  std::error_code ignored;
  const std::filesystem::path beside = folder / std::filesystem::path(path);
  const bool isPath = path.find_first_of("/.") != std::string::npos;
  return isPath && !std::filesystem::exists(path, ignored) &&
             std::filesystem::exists(beside, ignored)
           ? beside.string() + file.substr(path.size())
           : file;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
const std::vector<MethodName>& GetMethodNames()
{
  static const std::vector<MethodName> names = []()
  {
    std::vector<MethodName> list = {
      { method::Planned, "Planned",
        "what the planner finds for the tolerance, from cheap to costly" },
      { method::Reference, "Reference", "exact, on the CPU, progressively" },
      { method::Thesis, "Thesis (basis or fit)",
        "a basis or, where that rings, a fit, summed over lights (O'Toole 2007)" },
      { method::LightSet, "Light set", "the measured BRDF, summed over median-cut lights" },
      { method::SoftLights, "Soft lights", "the same with lights as wide as their regions" },
      { method::PBR, "Nearest PBR", "VTK's physically based shading with fitted properties" }
    };
    for (const auto& integrator : vtkRadianceMethods::GetMethods())
    {
      const std::string key = integrator->GetMethodName();
      const bool listed = std::any_of(
        list.begin(), list.end(), [&](const MethodName& name) { return name.Key == key; });
      if (!listed && !tool::IsOnCpuOnly(key))
      {
        list.push_back({ key, "Method: " + key, integrator->GetMethodDescription() });
      }
    }
    return list;
  }();
  return names;
}

//------------------------------------------------------------------------------
std::string GetMethodName(const std::string& key)
{
  for (const MethodName& name : GetMethodNames())
  {
    if (name.Key == key)
    {
      return name.Name;
    }
  }
  return key;
}

//------------------------------------------------------------------------------
std::string WriteState(const State& state)
{
  const ordered_json camera = { { "position", state.Camera.Position },
    { "focal_point", state.Camera.FocalPoint }, { "view_up", state.Camera.ViewUp },
    { "view_angle", state.Camera.ViewAngle } };
  const ordered_json json = { { "format", FormatName }, { "version", FormatVersion },
    { "material_files", state.MaterialFiles }, { "environment_files", state.EnvironmentFiles },
    { "material", state.Material }, { "compared", state.Compared }, { "models", state.Models },
    { "edits", WriteEdits(state.Edits) }, { "environment", state.Environment },
    { "light_theta", state.Light.Theta }, { "light_phi", state.Light.Phi },
    { "light_irradiance", state.Light.Irradiance }, { "rotation", state.Rotation },
    { "mesh", state.Mesh }, { "tolerance", state.Tolerance }, { "methods", state.Methods },
    { "lights", state.Lights }, { "show", state.Show == Shown::Split ? "split" : "difference" },
    { "split", state.Split }, { "exposure", state.Exposure }, { "backdrop", state.Backdrop },
    { "reference_height", state.ReferenceHeight }, { "camera", camera },
    { "lobe_theta_i", state.LobeThetaI }, { "lobe_phi_i", state.LobePhiI },
    { "lobe_logarithmic", state.LobeLogarithmic }, { "slice_theta_h", state.SliceThetaH },
    { "slice_theta_d", state.SliceThetaD }, { "slice_phi_d", state.SlicePhiD },
    { "slice_logarithmic", state.SliceLogarithmic }, { "slice_polar", state.SlicePolar } };
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

//------------------------------------------------------------------------------
State ReadState(const std::string& text, const std::string& name)
{
  ordered_json json;
  try
  {
    json = measuredbrdf::ParseJson<ordered_json>(text);
  }
  catch (const std::exception& e)
  {
    throw tool::Error(name + ": is no JSON object, as the explorer's states are: " + e.what());
  }
  if (!json.is_object())
  {
    throw tool::Error(name + ": is no JSON object, as the explorer's states are");
  }
  const Fields fields(json, name);
  if (json.value("format", ordered_json()) != FormatName)
  {
    fields.Fail("format", std::string("\"") + FormatName + "\"");
  }
  int version = 0;
  fields.Take("version", version, 0, 1000000);
  if (version != FormatVersion && version != 1)
  {
    fields.Fail("version", std::to_string(FormatVersion) + ", not " + std::to_string(version));
  }
  State state;
  fields.Take("material_files", state.MaterialFiles);
  fields.Take("environment_files", state.EnvironmentFiles);
  fields.Take("material", state.Material);
  TakeCompared(fields, state.Compared);
  TakeModels(fields, state.Models);
  TakeEdits(fields, state.Edits);
  fields.Take("environment", state.Environment);
  fields.Take("light_theta", state.Light.Theta, 0.0, 180.0);
  fields.Take("light_phi", state.Light.Phi, -180.0, 180.0);
  fields.Take("light_irradiance", state.Light.Irradiance, 0.0, LargestIrradiance);
  fields.Take("rotation", state.Rotation, -360.0, 360.0);
  fields.Take("mesh", state.Mesh);
  fields.Take("tolerance", state.Tolerance, 1e-3, 1.0);
  TakeMethods(fields, state);
  fields.Take("lights", state.Lights, 1, 4096);
  if ((state.Lights & (state.Lights - 1)) != 0)
  {
    fields.Fail("lights", "a power of two");
  }
  std::string show = "split";
  fields.Take("show", show);
  if (show != "split" && show != "difference")
  {
    fields.Fail("show", "\"split\" or \"difference\"");
  }
  state.Show = show == "split" ? Shown::Split : Shown::Difference;
  fields.Take("split", state.Split, 0.0, 1.0);
  if (version == FormatVersion)
  {
    fields.Take("exposure", state.Exposure, -MostStops, MostStops);
  }
  fields.Take("backdrop", state.Backdrop);
  fields.Take("reference_height", state.ReferenceHeight, 32, 2048);
  if (json.contains("camera"))
  {
    if (!json["camera"].is_object())
    {
      fields.Fail("camera", "an object");
    }
    TakeCamera(json["camera"], name, state.Camera);
  }
  fields.Take("lobe_theta_i", state.LobeThetaI, 0.0, 89.0);
  fields.Take("lobe_phi_i", state.LobePhiI, -360.0, 360.0);
  fields.Take("lobe_logarithmic", state.LobeLogarithmic);
  fields.Take("slice_theta_h", state.SliceThetaH, 0.0, 90.0);
  fields.Take("slice_theta_d", state.SliceThetaD, 0.0, 90.0);
  fields.Take("slice_phi_d", state.SlicePhiD, 0.0, 180.0);
  fields.Take("slice_logarithmic", state.SliceLogarithmic);
  fields.Take("slice_polar", state.SlicePolar);
  return state;
}

//------------------------------------------------------------------------------
void SaveState(const State& state, const std::string& path)
{
  tool::WriteWhole(path, WriteState(state));
}

//------------------------------------------------------------------------------
State LoadState(const std::string& path)
{
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error)
  {
    throw tool::Error(path + ": " + error.message());
  }
  if (size > LargestFile)
  {
    throw tool::Error(path + ": has " + std::to_string(size) + " bytes; a state has at most " +
                      std::to_string(LargestFile));
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file)
  {
    throw tool::Error(path + ": could not be read");
  }
  State state = ReadState(text.str(), path);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (std::string* one : { &state.Material, &state.Environment, &state.Mesh })
  {
    *one = Resolve(*one, folder);
  }
  for (auto* list : { &state.MaterialFiles, &state.EnvironmentFiles, &state.Compared })
  {
    std::transform(list->begin(), list->end(), list->begin(),
      [&](const std::string& file) { return Resolve(file, folder); });
  }
  std::map<std::string, SampleEdits> edits;
  for (const auto& [file, list] : state.Edits)
  {
    edits[Resolve(file, folder)] = list;
  }
  state.Edits = edits;
  return state;
}
} // namespace explorer
