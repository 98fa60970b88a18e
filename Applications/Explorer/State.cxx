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

using nlohmann::ordered_json;

namespace explorer
{
namespace
{
const char* const FormatName = "measured-brdf explorer state";
// Version 1 counted exposure from what suits the environment.
constexpr int FormatVersion = 2;
constexpr std::uintmax_t LargestFile = 1 << 20; // bytes
constexpr std::size_t MostFiles = 10000;

//------------------------------------------------------------------------------
// Everything in a state, by its name in files and with what is allowed:
// reading, writing and the limits of what people set follow this one list.
template <typename SomeState, typename Visitor>
void Visit(SomeState& state, const Visitor& visit)
{
  visit("material_files", state.MaterialFiles);
  visit("environment_files", state.EnvironmentFiles);
  visit("material", state.Material);
  visit("compared", state.Compared);
  visit("models", state.Models);
  visit("environment", state.Environment);
  visit("light_theta", state.Light.Theta, 0.0, 180.0);
  visit("light_phi", state.Light.Phi, -180.0, 180.0);
  visit("light_irradiance", state.Light.Irradiance, 0.0, LargestIrradiance);
  visit("rotation", state.Rotation, -360.0, 360.0);
  visit("mesh", state.Mesh);
  visit("tolerance", state.Tolerance, 1e-3, 1.0);
  visit("methods", state.Methods);
  visit("lights", state.Lights, 1, MostLights);
  visit("show", state.Show);
  visit("split", state.Split, 0.0, 1.0);
  visit("exposure", state.Exposure, -MostStops, MostStops);
  visit("backdrop", state.Backdrop);
  visit("reference_height", state.ReferenceHeight, 32, 2048);
  visit("camera", state.Camera);
  visit("lobe_theta_i", state.LobeThetaI, 0.0, 89.0);
  visit("lobe_phi_i", state.LobePhiI, -360.0, 360.0);
  visit("lobe_logarithmic", state.LobeLogarithmic);
  visit("slice_theta_h", state.SliceThetaH, 0.0, 90.0);
  visit("slice_theta_d", state.SliceThetaD, 0.0, 90.0);
  visit("slice_phi_d", state.SlicePhiD, 0.0, 180.0);
  visit("slice_logarithmic", state.SliceLogarithmic);
  visit("slice_polar", state.SlicePolar);
}

//------------------------------------------------------------------------------
std::string DescribeRange(double least, double largest)
{
  return " from " + tool::FormatNumber(least) + " to " + tool::FormatNumber(largest);
}

/// Puts the state's fields into JSON.
struct Writer
{
  ordered_json& Object;

  template <typename Value, typename... Limits>
  void operator()(const char* key, const Value& value, Limits...) const
  {
    this->Object[key] = value;
  }
  void operator()(const char* key, Shown shown) const
  {
    this->Object[key] = shown == Shown::Split ? "split" : "difference";
  }
  void operator()(const char* key, const CameraState& camera) const
  {
    this->Object[key] = { { "position", camera.Position }, { "focal_point", camera.FocalPoint },
      { "view_up", camera.ViewUp }, { "view_angle", camera.ViewAngle } };
  }
};

/**
 * Takes the state's fields out of JSON. What is absent keeps its value; what is wrong throws
 * tool::Error, which names the file, the field and what was expected.
 */
struct Reader
{
  const ordered_json& Object;
  std::string Name; // of the file and, of an object in it, its field

  [[noreturn]] void Fail(const std::string& key, const std::string& expected) const
  {
    throw tool::Error(this->Name + ": \"" + key + "\": expected " + expected);
  }

  // A value of another type, or that is not right, is what was not expected.
  template <typename Value, typename Test>
  void Take(const std::string& key, Value& value, const std::string& expected, Test isRight) const
  {
    const auto found = this->Object.find(key);
    if (found == this->Object.end())
    {
      return;
    }
    try
    {
      value = found->template get<Value>();
    }
    catch (const ordered_json::exception&)
    {
      this->Fail(key, expected);
    }
    if (!isRight(value))
    {
      this->Fail(key, expected);
    }
  }

  // An object in it; an empty one where it is absent.
  Reader Open(const std::string& key) const
  {
    static const ordered_json nothing = ordered_json::object();
    const auto found = this->Object.find(key);
    const ordered_json& object = found == this->Object.end() ? nothing : *found;
    if (!object.is_object())
    {
      this->Fail(key, "an object");
    }
    return { object, this->Name + ": \"" + key + "\"" };
  }

  void operator()(const std::string& key, double& value, double least, double largest) const
  {
    this->Take(key, value, "a number" + DescribeRange(least, largest),
      [=](double given) { return given >= least && given <= largest; });
  }
  void operator()(const char* key, int& value, int least, int largest) const
  {
    double given = value;
    (*this)(key, given, least, largest);
    value = static_cast<int>(given);
    if (given != value)
    {
      this->Fail(key, "a whole number");
    }
  }
  void operator()(const char* key, bool& value) const
  {
    this->Take(key, value, "true or false", [](bool) { return true; });
  }
  void operator()(const char* key, std::string& value) const
  {
    this->Take(key, value, "a text", [](const std::string& given) { return !given.empty(); });
  }
  void operator()(const char* key, std::array<double, 3>& values) const
  {
    std::vector<double> given(values.begin(), values.end());
    this->Take(key, given, "three numbers",
      [](const std::vector<double>& read)
      {
        return read.size() == 3 &&
               std::all_of(read.begin(), read.end(), [](double v) { return std::abs(v) <= 1e30; });
      });
    std::copy(given.begin(), given.end(), values.begin());
  }
  void operator()(const std::string& key, std::vector<std::string>& values) const
  {
    this->Take(key, values, "a list of texts",
      [](const std::vector<std::string>& given) { return given.size() <= MostFiles; });
    const std::set<std::string> different(values.begin(), values.end());
    if (key == "compared" &&
        (values.size() > MostCompared || different.size() != values.size() || different.count("")))
    {
      this->Fail(key, "at most " + std::to_string(MostCompared) + " different materials");
    }
  }
  void operator()(const char* key, std::array<std::string, 2>& methods) const
  {
    std::vector<std::string> given(methods.begin(), methods.end());
    std::string known;
    for (const MethodName& name : GetMethodNames())
    {
      known += (known.empty() ? "" : ", ") + name.Key;
    }
    this->Take(key, given, "two of " + known,
      [](const std::vector<std::string>& read)
      { return read.size() == 2 && IsMethod(read[0]) && IsMethod(read[1]); });
    std::copy(given.begin(), given.end(), methods.begin());
  }
  void operator()(const char* key, Shown& shown) const
  {
    std::string given = shown == Shown::Split ? "split" : "difference";
    this->Take(key, given, "\"split\" or \"difference\"",
      [](const std::string& read) { return read == "split" || read == "difference"; });
    shown = given == "split" ? Shown::Split : Shown::Difference;
  }
  void operator()(const char* key, CameraState& camera) const
  {
    const Reader fields = this->Open(key);
    fields("position", camera.Position);
    fields("focal_point", camera.FocalPoint);
    fields("view_up", camera.ViewUp);
    fields("view_angle", camera.ViewAngle, 1.0, 120.0);
    if (camera.Position == camera.FocalPoint)
    {
      fields.Fail("position", "another point than \"focal_point\"");
    }
    if (camera.ViewUp == std::array<double, 3>{ 0.0, 0.0, 0.0 })
    {
      fields.Fail("view_up", "a direction");
    }
  }

  // As many numbers as a parameter has; one of them may stand alone.
  void operator()(const char* key, ModelStates& states) const
  {
    const Reader models = this->Open(key);
    for (const auto& [name, values] : models.Object.items())
    {
      const ParametricModel* model = FindModel("model:" + name);
      if (!model)
      {
        models.Fail(name, "the name of a model, such as \"Lambert\"");
      }
      const Reader fields = models.Open(name);
      for (const auto& [field, value] : values.items())
      {
        const auto parameter = std::find_if(model->Parameters.begin(), model->Parameters.end(),
          [&, &wanted = field](const ModelParameter& one) { return one.Key == wanted; });
        if (parameter == model->Parameters.end())
        {
          fields.Fail(field, "a parameter of this model");
        }
        const std::size_t count = parameter->Default.size();
        const ordered_json numbers = { { field,
          value.is_array() ? value : ordered_json::array({ value }) } };
        Reader{ numbers, fields.Name }.Take(field, states[name][field],
          (count == 1 ? std::string("a number") : std::to_string(count) + " numbers") +
            DescribeRange(parameter->Least, parameter->Largest),
          [&](const std::vector<double>& given)
          {
            return given.size() == count &&
                   std::all_of(given.begin(), given.end(),
                     [&](double one)
                     { return one >= parameter->Least && one <= parameter->Largest; });
          });
        const double first = states[name][field][0];
        if (!parameter->Choices.empty() && first != std::floor(first))
        {
          fields.Fail(field, "a whole number");
        }
      }
    }
  }
};

/// Takes numbers that are not allowed as the nearest that are.
struct Limiter
{
  template <typename Value>
  void operator()(const char*, Value& value, Value least, Value largest) const
  {
    value = value >= least ? std::min(value, largest) : least; // NaN, too
  }
  template <typename Value>
  void operator()(const char*, const Value&) const
  {
  }
};

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
  Visit(state, Writer{ json });
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
  const Reader fields{ json, name };
  if (json.value("format", ordered_json()) != FormatName)
  {
    fields.Fail("format", std::string("\"") + FormatName + "\"");
  }
  int version = 0;
  fields("version", version, 0, 1000000);
  if (version != FormatVersion && version != 1)
  {
    fields.Fail("version", std::to_string(FormatVersion) + ", not " + std::to_string(version));
  }
  if (version == 1)
  {
    json.erase("exposure");
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
  Visit(state, fields);
  if ((state.Lights & (state.Lights - 1)) != 0)
  {
    fields.Fail("lights", "a power of two");
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
