// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the explorer shows, as a file keeps it. Without Qt.
 */

#ifndef State_h
#define State_h

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace explorer
{
/// What one side of the picture is drawn by: one of these, or the name of a
/// method of vtkRadianceMethods.
namespace method
{
constexpr const char* Planned = "planned";
constexpr const char* Reference = "reference";
constexpr const char* Thesis = "thesis";
constexpr const char* LightSet = "light-set";
constexpr const char* SoftLights = "soft-lights";
constexpr const char* PBR = "pbr";
} // namespace method

/// All that a side can be drawn by, with a name and a line for people.
struct MethodName
{
  std::string Key;
  std::string Name;
  std::string Description;
};
const std::vector<MethodName>& GetMethodNames();

/// For people; of a key that is not known, the key.
std::string GetMethodName(const std::string& key);
bool IsMethod(const std::string& key);

/// The name, in State::Environment, of one directional light in an
/// environment's place.
constexpr const char* DirectionalLightName = "directional-light";

/// That light.
struct LightState
{
  double Theta = 40.0;     // degrees from +y, [0, 180]
  double Phi = -20.0;      // degrees about +y from +z to +x, [-180, 180]
  double Irradiance = 1.0; // of a surface that faces it, [0, 1000]
};
constexpr double LargestIrradiance = 1000.0;

struct CameraState
{
  std::array<double, 3> Position = { 2.0, 1.7, 3.5 };
  std::array<double, 3> FocalPoint = { 0.0, 0.0, 0.0 };
  std::array<double, 3> ViewUp = { 0.0, 1.0, 0.0 };
  double ViewAngle = 30.0; // degrees
};

enum class Shown
{
  Split,
  Difference
};
NLOHMANN_JSON_SERIALIZE_ENUM(
  Shown, { { Shown::Split, "split" }, { Shown::Difference, "difference" } })

/// Of the methods that sum over lights.
constexpr int MostLights = 4096;

/// So many materials are drawn in one chart beside the one that is shown.
constexpr std::size_t MostCompared = 8;

/// Environments in any unit: 2^40 is 1e12.
constexpr double MostStops = 40.0;

struct State
{
  std::vector<std::string> MaterialFiles; // opened, beside the built-in ones
  std::vector<std::string> EnvironmentFiles;
  std::string Material = "gold-paint"; // a built-in or a model's name (Materials.h), or a file
  std::vector<std::string> Compared;   // materials in the charts beside it, at most MostCompared
  std::string Environment = "hall";    // or DirectionalLightName
  LightState Light;
  double Rotation = 0.0;       // of the environment about +y, degrees in [-180, 180)
  std::string Mesh = "sphere"; // or "ball-on-foot", or a file
  double Tolerance = 0.02;     // [1e-3, 1]
  std::array<std::string, 2> Methods = { method::Planned, method::Reference };
  int Lights = 64; // of the methods that sum over lights: a power of two up to 4096
  Shown Show = Shown::Split;
  double Split = 0.5;    // where the line is, share of the width
  double Exposure = 0.0; // stops, [-MostStops, MostStops]; at 0 as the mapper shows it
  bool Backdrop = true;
  int ReferenceHeight = 256; // largest height of exact pictures in pixels, [32, 2048]
  CameraState Camera;
  double LobeThetaI = 45.0; // degrees, [0, 89]
  double LobePhiI = 180.0;  // degrees, [-360, 360]
  bool LobeLogarithmic = true;
  double SliceThetaH = 0.0; // where the other slices cut, degrees in [0, 90]
  double SliceThetaD = 0.0;
  double SlicePhiD = 90.0; // degrees, [0, 180]
  bool SliceLogarithmic = true;
  bool SlicePolar = false; // a polar plot for the lobe's light in the slices' place
};

/// Takes numbers that are not allowed as the nearest that are, and angles within a turn.
void Limit(State& state);

/// As JSON.
std::string WriteState(const State& state);

/**
 * From JSON; name: the file's, for messages. What is absent keeps its default.
 * Throws tool::Error naming the file, the field, and what was expected.
 */
State ReadState(const std::string& text, const std::string& name);

/// From a file. Relative paths in it are looked for in its folder. Throws tool::Error.
State LoadState(const std::string& path);
} // namespace explorer

#endif
