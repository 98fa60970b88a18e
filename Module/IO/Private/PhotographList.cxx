// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PhotographList.h"

#include "BoundedJson.h"
#include "NumberText.h"
#include "vtkPhotographSet.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <regex>

namespace measuredbrdf
{
namespace
{
using nlohmann::json;

constexpr std::size_t MostFolderEntries = std::size_t(1) << 21;
constexpr int DeepestFolder = 8;

const std::map<std::string, int> Transfers = { { "automatic", vtkPhotographSet::AUTOMATIC },
  { "linear", vtkPhotographSet::LINEAR }, { "srgb", vtkPhotographSet::SRGB },
  { "power", vtkPhotographSet::POWER } };

// Throws where a direction or the exposure cannot be used.
void Check(const std::string& where, const ListedPhotograph& photograph)
{
  std::string problem = vtkPhotographSet::FindDirectionProblem(photograph.Light, "light");
  problem =
    !problem.empty() ? problem : vtkPhotographSet::FindDirectionProblem(photograph.View, "view");
  problem = !problem.empty() ? problem : vtkPhotographSet::FindExposureProblem(photograph.Exposure);
  if (problem.empty() &&
      (photograph.File.empty() || photograph.File.find('\0') != std::string::npos))
  {
    problem = "file: found " + Quote(photograph.File) + ", expected a file's name";
  }
  if (!problem.empty())
  {
    throw FileError(where + ": " + problem);
  }
}

void CheckNumber(const std::string& path, const PhotographList& list, const std::string& what)
{
  constexpr std::size_t most = vtkPhotographSet::MaximumNumberOfPhotographs;
  if (list.Photographs.empty() || list.Photographs.size() > most)
  {
    throw FileError(path + ": found " + std::to_string(list.Photographs.size()) + " " + what +
                    ", expected 1 to " + std::to_string(most));
  }
}

void SetAngles(const std::string& where, double theta, double phi, double direction[3])
{
  if (!(theta >= 0.0 && theta < 90.0) || !std::isfinite(phi))
  {
    TextStream found;
    found << where << ": found a polar angle of " << theta << " and an azimuth of " << phi
          << " degrees, expected a direction above the horizon, 0 to less than 90";
    throw FileError(found.str());
  }
  vtkPhotographSet::GetDirection(theta, phi, direction);
}

void CheckKeys(
  const std::string& where, const json& object, std::initializer_list<const char*> allowed)
{
  if (!object.is_object())
  {
    throw FileError(where + ": expected an object in braces");
  }
  for (const auto& item : object.items())
  {
    if (std::find(allowed.begin(), allowed.end(), item.key()) == allowed.end())
    {
      std::string names;
      for (const char* name : allowed)
      {
        names += (names.empty() ? "" : ", ") + std::string(name);
      }
      throw FileError(where + ": found the key " + Quote(item.key()) + ", expected " + names);
    }
  }
}

double GetNumber(const std::string& where, const json& object, const char* key, double otherwise)
{
  const auto found = object.find(key);
  if (found == object.end())
  {
    return otherwise;
  }
  const double value = found->is_number() ? found->get<double>() : NAN;
  if (!std::isfinite(value))
  {
    throw FileError(where + ": " + key + ": expected a finite number");
  }
  return value;
}

void ParseDirection(
  const std::string& where, const json& entry, const char* key, double direction[3])
{
  const auto found = entry.find(key);
  const std::string place = where + ": " + key;
  if (found != entry.end() && found->is_object())
  {
    CheckKeys(place, *found, { "theta", "phi" });
    SetAngles(place, GetNumber(place, *found, "theta", NAN), GetNumber(place, *found, "phi", 0.0),
      direction);
    return;
  }
  const bool isTriple = found != entry.end() && found->is_array() && found->size() == 3;
  for (std::size_t c = 0; c < 3; ++c)
  {
    if (!isTriple || !(*found)[c].is_number())
    {
      throw FileError(
        place + R"(: expected three numbers, or {"theta": ..., "phi": ...} in degrees)");
    }
    direction[c] = (*found)[c].get<double>();
  }
}

ListedPhotograph ParsePhotograph(const std::string& where, const json& entry)
{
  CheckKeys(where, entry, { "file", "light", "view", "exposure", "comment" });
  ListedPhotograph photograph;
  const auto file = entry.find("file");
  photograph.File = file != entry.end() && file->is_string() ? file->get<std::string>() : "";
  ParseDirection(where, entry, "light", photograph.Light);
  ParseDirection(where, entry, "view", photograph.View);
  photograph.Exposure = GetNumber(where, entry, "exposure", 1.0);
  Check(where, photograph);
  return photograph;
}

void ParseSettings(const std::string& path, const json& root, PhotographList& list)
{
  list.Irradiance = GetNumber(path, root, "irradiance", list.Irradiance);
  list.Gamma = GetNumber(path, root, "gamma", list.Gamma);
  list.SaturationLevel = GetNumber(path, root, "saturation", list.SaturationLevel);
  list.BlackLevel = GetNumber(path, root, "black", list.BlackLevel);
  if (!(list.Irradiance > 0.0) || !(list.Gamma >= 0.1 && list.Gamma <= 10.0))
  {
    throw FileError(path + ": expected an irradiance > 0 and a gamma from 0.1 to 10");
  }
  const auto levels = root.find("levels_for_floats");
  if (levels != root.end() && !levels->is_boolean())
  {
    throw FileError(path + ": levels_for_floats: expected true or false");
  }
  list.LevelsForFloats = levels != root.end() && levels->get<bool>();
  const auto transfer = root.find("transfer");
  if (transfer != root.end())
  {
    const auto known =
      Transfers.find(transfer->is_string() ? transfer->get<std::string>() : std::string());
    if (known == Transfers.end())
    {
      throw FileError(path + ": transfer: expected automatic, linear, srgb or power");
    }
    list.Transfer = known->second;
  }
}

//------------------------------------------------------------------------------
// The numbers behind tl, pl, tv and pv that begin words; false unless each of these is there once.
bool FindAngles(const std::string& name, std::array<double, 4>& angles)
{
  static const std::regex pattern(
    "(?:^|[^A-Za-z0-9])([tp])([lv])(-?[0-9]{1,9})(?![0-9])", std::regex::icase);
  std::array<int, 4> counts{};
  for (std::sregex_iterator found(name.begin(), name.end(), pattern), end; found != end; ++found)
  {
    const bool isAzimuth = std::tolower(*(*found)[1].first) == 'p';
    const bool isView = std::tolower(*(*found)[2].first) == 'v';
    const std::size_t k = (isAzimuth ? 1 : 0) + (isView ? 2 : 0);
    counts[k] += ParseNumber((*found)[3].str(), angles[k]) ? 1 : 0;
  }
  return counts == std::array<int, 4>{ 1, 1, 1, 1 };
}
}

PhotographList ParsePhotographList(const FileBytes& file)
{
  const std::string& path = file.GetPath();
  json root;
  try
  {
    root = ParseJson<json>(file.GetView());
  }
  catch (const std::exception& e)
  {
    throw FileError(path + ": JSON: " + e.what());
  }
  CheckKeys(path, root,
    { "photographs", "irradiance", "transfer", "gamma", "saturation", "black", "levels_for_floats",
      "comment" });
  PhotographList list;
  ParseSettings(path, root, list);
  const auto found = root.find("photographs");
  if (found == root.end() || !found->is_array())
  {
    throw FileError(path + ": expected an array named 'photographs'");
  }
  for (std::size_t k = 0; k < found->size(); ++k)
  {
    list.Photographs.push_back(
      ParsePhotograph(path + ": photograph " + std::to_string(k), (*found)[k]));
  }
  CheckNumber(path, list, "photographs");
  return list;
}

bool ParsePhotographName(const std::string& path, ListedPhotograph& photograph)
{
  const std::string name = GetFileTitle(path);
  std::array<double, 4> angles{};
  if (!FindAngles(name, angles))
  {
    return false;
  }
  photograph.File = path;
  photograph.Exposure = 1.0;
  SetAngles(path + ": light (tl, pl)", angles[0], angles[1], photograph.Light);
  SetAngles(path + ": view (tv, pv)", angles[2], angles[3], photograph.View);
  return true;
}

PhotographList ListPhotographFolder(const std::string& folder, std::size_t& ignored)
{
  PhotographList list;
  ignored = 0;
  std::error_code error;
  std::size_t entries = 0;
  // It does not follow links to folders.
  auto entry = std::filesystem::recursive_directory_iterator(folder, error);
  for (; !error && entry != std::filesystem::end(entry); entry.increment(error))
  {
    if (++entries > MostFolderEntries)
    {
      throw FileError(folder + ": found more than " + std::to_string(MostFolderEntries) +
                      " entries, expected a folder of photographs");
    }
    if (entry.depth() >= DeepestFolder)
    {
      entry.disable_recursion_pending();
    }
    std::error_code ignoredError;
    if (!entry->is_regular_file(ignoredError))
    {
      continue;
    }
    ListedPhotograph photograph;
    if (ParsePhotographName(entry->path().string(), photograph))
    {
      list.Photographs.push_back(photograph);
    }
    else
    {
      ++ignored;
    }
  }
  if (error)
  {
    throw FileError(folder + ": " + error.message());
  }
  CheckNumber(folder, list, "files whose names say directions, like tl015_pl030_tv045_pv060.jpg");
  std::sort(list.Photographs.begin(), list.Photographs.end(),
    [](const ListedPhotograph& a, const ListedPhotograph& b) { return a.File < b.File; });
  return list;
}
} // namespace measuredbrdf
