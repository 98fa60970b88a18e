// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "State.h"

#include "BoundedJson.h"
#include "Files.h"
#include "Materials.h"
#include "Methods.h"
#include "Tool.h"

#include "vtkRadianceMethods.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <type_traits>

using nlohmann::ordered_json;

namespace explorer
{
namespace
{
const char* const FormatName = "measured-brdf explorer state";
// Version 1 counted exposure from what suits the environment.
constexpr int FormatVersion = 2;
constexpr std::uintmax_t LargestFile = 1 << 20; // bytes

//------------------------------------------------------------------------------
[[noreturn]] void Fail(const std::string& name, const std::string& key, const std::string& expected)
{
  throw tool::Error(name + ": \"" + key + "\": expected " + expected);
}

//------------------------------------------------------------------------------
std::string DescribeRange(double least, double largest)
{
  return " from " + tool::FormatNumber(least) + " to " + tool::FormatNumber(largest);
}

//------------------------------------------------------------------------------
std::string ListMethods()
{
  std::string known;
  for (const MethodName& name : GetMethodNames())
  {
    known += (known.empty() ? "" : ", ") + name.Key;
  }
  return known;
}

//------------------------------------------------------------------------------
// Everything in a state by its place in files: numbers with the range that they are in, others with
// what is expected and a test of that. Reading, writing and the limits of what people set follow
// this one list.
template <typename SomeState, typename Visitor>
void Visit(SomeState& state, const Visitor& visit)
{
  const auto isText = [](const std::string& text) { return !text.empty(); };
  const auto isAny = [](const auto&) { return true; };
  const auto isPoint = [](const auto& v)
  { return std::all_of(v.begin(), v.end(), [](double x) { return std::abs(x) <= 1e30; }); };
  const auto isDirection = [=](const auto& v) {
    return isPoint(v) && v != std::array<double, 3>{ 0.0, 0.0, 0.0 };
  };
  const auto areMethods = [](const auto& keys) { return IsMethod(keys[0]) && IsMethod(keys[1]); };
  const auto areDifferent = [](const std::vector<std::string>& files)
  {
    const std::set<std::string> different(files.begin(), files.end());
    return files.size() <= MostCompared && different.size() == files.size() && !different.count("");
  };
  visit("material_files", state.MaterialFiles, "a list of texts", isAny);
  visit("environment_files", state.EnvironmentFiles, "a list of texts", isAny);
  visit("material", state.Material, "a text", isText);
  visit("compared", state.Compared,
    "at most " + std::to_string(MostCompared) + " different materials", areDifferent);
  visit("environment", state.Environment, "a text", isText);
  visit("light_theta", state.Light.Theta, 0.0, 180.0);
  visit("light_phi", state.Light.Phi, -180.0, 180.0);
  visit("light_irradiance", state.Light.Irradiance, 0.0, LargestIrradiance);
  visit("rotation", state.Rotation, -360.0, 360.0);
  visit("mesh", state.Mesh, "a text", isText);
  visit("tolerance", state.Tolerance, 1e-3, 1.0);
  visit("methods", state.Methods, "two of " + ListMethods(), areMethods);
  visit("lights", state.Lights, 1, MostLights);
  visit("show", state.Show, "\"split\" or \"difference\"", isAny);
  visit("split", state.Split, 0.0, 1.0);
  visit("exposure", state.Exposure, -MostStops, MostStops);
  visit("backdrop", state.Backdrop, "true or false", isAny);
  visit("reference_height", state.ReferenceHeight, 32, 2048);
  visit("camera/position", state.Camera.Position, "three numbers up to 1e30", isPoint);
  visit("camera/focal_point", state.Camera.FocalPoint, "three numbers up to 1e30", isPoint);
  visit("camera/view_up", state.Camera.ViewUp, "three numbers, not all of them 0", isDirection);
  visit("camera/view_angle", state.Camera.ViewAngle, 1.0, 120.0);
  visit("lobe_theta_i", state.LobeThetaI, 0.0, 89.0);
  visit("lobe_phi_i", state.LobePhiI, -360.0, 360.0);
  visit("lobe_logarithmic", state.LobeLogarithmic, "true or false", isAny);
  visit("slice_theta_h", state.SliceThetaH, 0.0, 90.0);
  visit("slice_theta_d", state.SliceThetaD, 0.0, 90.0);
  visit("slice_phi_d", state.SlicePhiD, 0.0, 180.0);
  visit("slice_logarithmic", state.SliceLogarithmic, "true or false", isAny);
  visit("slice_polar", state.SlicePolar, "true or false", isAny);
}

//------------------------------------------------------------------------------
ordered_json::json_pointer MakePointer(const std::string& key)
{
  return ordered_json::json_pointer("/" + key);
}

/// Takes the state's fields out of JSON. What is absent keeps its value.
struct Reader
{
  const ordered_json& Object;
  const std::string& Name; // of the file

  // What does not come back as it was given is of another type, or one of its parts is.
  template <typename Value, typename Test>
  void operator()(
    const std::string& key, Value& value, const std::string& expected, Test isRight) const
  {
    const auto place = MakePointer(key);
    if (!this->Object.contains(place))
    {
      return;
    }
    const ordered_json& given = this->Object[place];
    try
    {
      value = given.get<Value>();
    }
    catch (const ordered_json::exception&)
    {
      Fail(this->Name, key, expected);
    }
    if (ordered_json(value) != given || !isRight(value))
    {
      Fail(this->Name, key, expected);
    }
  }
  template <typename Number>
  void operator()(const std::string& key, Number& value, Number least, Number largest) const
  {
    (*this)(key, value,
      (std::is_integral_v<Number> ? "a whole number" : "a number") + DescribeRange(least, largest),
      [=](Number given) { return given >= least && given <= largest; });
  }
};

/// Takes numbers that are not allowed as the nearest that are.
struct Limiter
{
  template <typename Value, typename Test>
  void operator()(const char*, const Value&, const std::string&, Test) const
  {
  }
  template <typename Number>
  void operator()(const char*, Number& value, Number least, Number largest) const
  {
    value = value >= least ? std::min(value, largest) : least; // NaN, too
  }
};

//------------------------------------------------------------------------------
// States of earlier versions kept the parameters of models beside their names.
void AddParameters(std::string& name, const ordered_json& models)
{
  const ParametricModel* model = FindModel(name);
  if (model && models.contains(model->Key))
  {
    ModelValues values = GetValues(name);
    const ordered_json& given = models[model->Key];
    for (auto& [key, numbers] : values)
    {
      // The index, 1.5 unless it was set, counted where Schlick's Fresnel term was not chosen.
      const bool isIndex = key == "index_of_refraction";
      numbers = isIndex && given.value("fresnel", ModelValues::mapped_type{ 0.0 }).at(0) == 0.0
                  ? numbers
                  : given.value(key, isIndex ? ModelValues::mapped_type{ 1.5 } : numbers);
    }
    name = NameModel(*model, values);
  }
}

//------------------------------------------------------------------------------
// A built-in name, or a path as it is; a relative one that is not here but
// beside the state file.
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
        "a basis or, where that rings, a fit, summed over lights (O'Toole "
        "2007)" },
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
  const auto& names = GetMethodNames();
  const auto found = std::find_if(
    names.begin(), names.end(), [&key](const MethodName& name) { return name.Key == key; });
  return found == names.end() ? key : found->Name;
}

//------------------------------------------------------------------------------
bool IsMethod(const std::string& key)
{
  return std::any_of(GetMethodNames().begin(), GetMethodNames().end(),
    [&key](const MethodName& name) { return name.Key == key; });
}

//------------------------------------------------------------------------------
void Limit(State& state)
{
  // Angles come back after a turn.
  const auto wrap = [](double& degrees, double least)
  { degrees = least + std::fmod(std::fmod(degrees - least, 360.0) + 360.0, 360.0); };
  wrap(state.Rotation, -180.0);
  wrap(state.Light.Phi, -180.0);
  wrap(state.LobePhiI, 0.0);
  Visit(state, Limiter());
  while ((state.Lights & (state.Lights - 1)) != 0) // to the largest power of two that is not more
  {
    state.Lights &= state.Lights - 1;
  }
}

//------------------------------------------------------------------------------
std::string WriteState(const State& state)
{
  ordered_json json = { { "format", FormatName }, { "version", FormatVersion } };
  Visit(state, [&json](const std::string& key, const auto& value, const auto&...)
    { json[MakePointer(key)] = value; });
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

//------------------------------------------------------------------------------
State ReadState(const std::string& text, const std::string& name)
{
  ordered_json json;
  std::string reason;
  try
  {
    json = measuredbrdf::ParseJson<ordered_json>(text);
  }
  catch (const std::exception& e)
  {
    reason = std::string(": ") + e.what();
  }
  if (!json.is_object())
  {
    throw tool::Error(name + ": is no JSON object, as the explorer's states are" + reason);
  }
  if (json.value("format", ordered_json()) != FormatName)
  {
    Fail(name, "format", std::string("\"") + FormatName + "\"");
  }
  const ordered_json version = json.value("version", ordered_json());
  if (version != FormatVersion && version != 1)
  {
    Fail(name, "version", std::to_string(FormatVersion) + ", not " + version.dump());
  }
  if (version == 1)
  {
    json.erase("exposure");
  }
  if (!json.value("camera", ordered_json::object()).is_object())
  {
    Fail(name, "camera", "an object");
  }
  // Of earlier versions: methods that are gone, and samples that were edited.
  for (const char* gone : { "basis", "factored", "anisotropic-table" })
  {
    if (json.contains("methods"))
    {
      std::replace(json["methods"].begin(), json["methods"].end(), ordered_json(gone),
        ordered_json(method::Planned));
    }
  }
  if (!json.value("edits", ordered_json()).empty())
  {
    tool::PrintNote(name + ": \"edits\" are left out: samples are edited in a material's file");
  }
  State state;
  Visit(state, Reader{ json, name });
  try
  {
    AddParameters(state.Material, json.value("models", ordered_json()));
    for (std::string& compared : state.Compared)
    {
      AddParameters(compared, json.value("models", ordered_json()));
    }
  }
  catch (const std::exception&)
  {
    Fail(name, "models", "an object of models, with a list of numbers for each parameter");
  }
  if ((state.Lights & (state.Lights - 1)) != 0)
  {
    Fail(name, "lights", "a power of two");
  }
  if (state.Camera.Position == state.Camera.FocalPoint)
  {
    Fail(name, "camera/position", "another point than \"camera/focal_point\"");
  }
  return state;
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
  return state;
}
} // namespace explorer
