// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "State.h"

#include "Files.h"
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

namespace
{
const char* const FormatName = "measured-brdf explorer state";
constexpr int FormatVersion = 1;
constexpr std::uintmax_t LargestFile = 1 << 20; // bytes
constexpr std::size_t MostFiles = 10000;

//------------------------------------------------------------------------------
/// Takes fields of an object and says which one is wrong.
class Fields
{
public:
  Fields(const ordered_json& object, std::string name)
    : Object(object)
    , Name(std::move(name))
  {
  }

  [[noreturn]] void Fail(const std::string& key, const std::string& expected) const
  {
    throw tool::Error(this->Name + ": \"" + key + "\": expected " + expected);
  }

  void Take(const char* key, double& value, double least, double largest) const
  {
    const auto found = this->Object.find(key);
    if (found == this->Object.end())
    {
      return;
    }
    const double given = found->is_number() ? found->get<double>() : NAN;
    if (!(given >= least && given <= largest))
    {
      this->Fail(
        key, "a number from " + tool::FormatNumber(least) + " to " + tool::FormatNumber(largest));
    }
    value = given;
  }

  void Take(const char* key, int& value, int least, int largest) const
  {
    double given = value;
    this->Take(key, given, least, largest);
    if (given != std::floor(given))
    {
      this->Fail(key, "a whole number");
    }
    value = static_cast<int>(given);
  }

  void Take(const char* key, bool& value) const
  {
    const auto found = this->Object.find(key);
    if (found != this->Object.end() && !found->is_boolean())
    {
      this->Fail(key, "true or false");
    }
    value = found != this->Object.end() ? found->get<bool>() : value;
  }

  void Take(const char* key, std::string& value) const
  {
    const auto found = this->Object.find(key);
    if (found == this->Object.end())
    {
      return;
    }
    if (!found->is_string() || found->get<std::string>().empty())
    {
      this->Fail(key, "a text");
    }
    value = found->get<std::string>();
  }

  void Take(const char* key, std::vector<std::string>& values) const
  {
    const auto found = this->Object.find(key);
    if (found == this->Object.end())
    {
      return;
    }
    const bool good = found->is_array() && found->size() <= MostFiles &&
                      std::all_of(found->begin(), found->end(),
                        [](const ordered_json& item) { return item.is_string(); });
    if (!good)
    {
      this->Fail(key, "a list of texts");
    }
    values = found->get<std::vector<std::string>>();
  }

  void Take(const char* key, std::array<double, 3>& values) const
  {
    const auto found = this->Object.find(key);
    if (found == this->Object.end())
    {
      return;
    }
    const bool good = found->is_array() && found->size() == 3 &&
                      std::all_of(found->begin(), found->end(),
                        [](const ordered_json& item)
                        { return item.is_number() && std::abs(item.get<double>()) < 1e30; });
    if (!good)
    {
      this->Fail(key, "three numbers");
    }
    values = found->get<std::array<double, 3>>();
  }

private:
  const ordered_json& Object;
  std::string Name;
};

//------------------------------------------------------------------------------
void TakeCamera(const ordered_json& object, const std::string& name, explorer::CameraState& camera)
{
  const Fields fields(object, name + ": \"camera\"");
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
void TakeMethods(const Fields& fields, explorer::State& state)
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
void TakeCompared(const Fields& fields, std::vector<std::string>& compared)
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
    std::vector<MethodName> list = { { method::Planned, "Planned",
                                       "the cheapest method that meets the tolerance" },
      { method::Reference, "Reference", "exact, on the CPU, progressively" },
      { method::Thesis, "Thesis (basis or fit)",
        "a basis or, where that rings, a fit, summed over lights (O'Toole 2007)" },
      { method::LightSet, "Light set", "the measured BRDF, summed over median-cut lights" },
      { method::SoftLights, "Soft lights", "the same with lights as wide as their regions" },
      { method::PBR, "Nearest PBR", "VTK's physically based shading with fitted properties" } };
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
    { "material", state.Material }, { "compared", state.Compared },
    { "environment", state.Environment }, { "rotation", state.Rotation }, { "mesh", state.Mesh },
    { "tolerance", state.Tolerance }, { "methods", state.Methods }, { "lights", state.Lights },
    { "show", state.Show == Shown::Split ? "split" : "difference" }, { "split", state.Split },
    { "exposure", state.Exposure }, { "backdrop", state.Backdrop },
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
  const ordered_json json = ordered_json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object())
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
  if (version != FormatVersion)
  {
    fields.Fail("version", std::to_string(FormatVersion) + ", not " + std::to_string(version));
  }
  State state;
  fields.Take("material_files", state.MaterialFiles);
  fields.Take("environment_files", state.EnvironmentFiles);
  fields.Take("material", state.Material);
  TakeCompared(fields, state.Compared);
  fields.Take("environment", state.Environment);
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
  fields.Take("exposure", state.Exposure, -10.0, 10.0);
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
  tool::WriteText(path, WriteState(state));
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
