// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotographSetReader.h"

#include "BoundedJson.h"
#include "FileBytes.h"
#include "ImageFile.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPhotographSet.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkPhotographSetReader);

using namespace measuredbrdf;

namespace
{
using nlohmann::json;

constexpr std::size_t MostListBytes = std::size_t(1) << 28;
constexpr std::size_t MostFolderEntries = std::size_t(1) << 21;
constexpr int DeepestFolder = 8;

const std::map<std::string, int> Transfers = { { "automatic", vtkPhotographSet::AUTOMATIC },
  { "linear", vtkPhotographSet::LINEAR }, { "srgb", vtkPhotographSet::SRGB },
  { "power", vtkPhotographSet::POWER } };

void SetAngles(const std::string& where, double theta, double phi, double direction[3])
{
  Require(theta >= 0.0 && theta < 90.0 && std::isfinite(phi), where, ": found a polar angle of ",
    theta, " and an azimuth of ", phi,
    " degrees, expected a direction above the horizon, 0 to less than 90");
  vtkPhotographSet::GetDirection(theta, phi, direction);
}

//------------------------------------------------------------------------------
// An object of the JSON text; where: how errors call it.
class ListObject
{
public:
  ListObject(std::string where, const json& object, const std::vector<std::string>& allowed)
    : Where(std::move(where))
    , Object(object)
  {
    Require(object.is_object(), this->Where, ": expected an object in braces");
    for (const auto& item : object.items())
    {
      if (std::find(allowed.begin(), allowed.end(), item.key()) == allowed.end())
      {
        throw FileError(this->Where, ": found the key ", Quote(item.key()), ", expected one of ",
          json(allowed).dump());
      }
    }
  }

  /// absent: where there is none of that name.
  json Get(const char* key, const json& absent = json()) const
  {
    return this->Object.value(key, absent);
  }

  void GetNumber(const char* key, double& number) const
  {
    if (this->Object.contains(key))
    {
      const json value = this->Get(key);
      number = value.is_number() ? value.get<double>() : NAN;
      Require(std::isfinite(number), this->Where, ": ", key, ": expected a finite number");
    }
  }

  void GetDirection(const char* key, double direction[3]) const
  {
    const std::string place = this->Where + ": " + key;
    const json value = this->Get(key);
    if (value.is_object())
    {
      const ListObject angles(place, value, { "theta", "phi" });
      double theta = NAN;
      double phi = 0.0;
      angles.GetNumber("theta", theta);
      angles.GetNumber("phi", phi);
      SetAngles(place, theta, phi, direction);
      return;
    }
    const bool isTriple = value.is_array() && value.size() == 3 &&
                          std::all_of(value.begin(), value.end(),
                            [](const json& number) { return number.is_number(); });
    Require(
      isTriple, place, R"(: expected three numbers, or {"theta": ..., "phi": ...} in degrees)");
    const auto triple = value.get<std::array<double, 3>>();
    std::copy(triple.begin(), triple.end(), direction);
    const std::string problem = vtkPhotographSet::FindDirectionProblem(direction, key);
    Require(problem.empty(), this->Where, ": ", problem);
  }

private:
  std::string Where;
  const json& Object;
};

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

//------------------------------------------------------------------------------
// Photographs in files, each read when it is asked for.
class FilePhotographSet : public vtkPhotographSet
{
public:
  static FilePhotographSet* New();
  vtkTypeMacro(FilePhotographSet, vtkPhotographSet);

  // From a list in JSON. Throws FileError, as ReadFolder does.
  void ReadList(const std::string& path)
  {
    Require(CheckFile(path) <= MostListBytes, path, ": expected a list of at most ", MostListBytes,
      " bytes");
    json root;
    try
    {
      root = ParseJson<json>(FileBytes(path).GetView());
    }
    catch (const std::exception& e)
    {
      throw FileError(path, ": JSON: ", e.what());
    }
    const ListObject object(path, root,
      { "photographs", "irradiance", "transfer", "gamma", "saturation", "black",
        "levels_for_floats", "comment" });
    this->TakeSettings(path, object);
    const auto found = root.find("photographs");
    Require(
      found != root.end() && found->is_array(), path, ": expected an array named 'photographs'");
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::vector<Photograph> photographs;
    for (const json& entry : *found)
    {
      const std::string where = Concat(path, ": photograph ", photographs.size());
      const ListObject listed(where, entry, { "file", "light", "view", "exposure", "comment" });
      Photograph photograph;
      const json file = listed.Get("file");
      const std::string name = file.is_string() ? file.get<std::string>() : "";
      listed.GetDirection("light", photograph.Light);
      listed.GetDirection("view", photograph.View);
      listed.GetNumber("exposure", photograph.Exposure);
      const std::string problem = FindExposureProblem(photograph.Exposure);
      Require(problem.empty(), where, ": ", problem);
      Require(!name.empty() && name.find('\0') == std::string::npos, where, ": file: found ",
        Quote(name), ", expected a file's name");
      photograph.Name = (folder / name).string();
      photographs.push_back(photograph);
    }
    this->Take(path, photographs, "photographs");
  }

  // All files in a folder and its folders whose names say the directions, in the order of their
  // paths. Returns how many other files there are.
  vtkIdType ReadFolder(const std::string& folder)
  {
    std::vector<Photograph> photographs;
    vtkIdType ignored = 0;
    std::error_code error;
    std::size_t entries = 0;
    // It does not follow links to folders.
    auto entry = std::filesystem::recursive_directory_iterator(folder, error);
    for (; !error && entry != std::filesystem::end(entry); entry.increment(error))
    {
      Require(++entries <= MostFolderEntries, folder, ": found more than ", MostFolderEntries,
        " entries, expected a folder of photographs");
      if (entry.depth() >= DeepestFolder)
      {
        entry.disable_recursion_pending();
      }
      std::error_code ignoredError;
      if (!entry->is_regular_file(ignoredError))
      {
        continue;
      }
      Photograph photograph;
      photograph.Name = entry->path().string();
      std::array<double, 4> angles{};
      if (FindAngles(GetFileTitle(photograph.Name), angles))
      {
        SetAngles(photograph.Name + ": light (tl, pl)", angles[0], angles[1], photograph.Light);
        SetAngles(photograph.Name + ": view (tv, pv)", angles[2], angles[3], photograph.View);
        photographs.push_back(photograph);
      }
      else
      {
        ++ignored;
      }
    }
    Require(!error, folder, ": ", error.message());
    std::sort(photographs.begin(), photographs.end(),
      [](const Photograph& a, const Photograph& b) { return a.Name < b.Name; });
    this->Take(
      folder, photographs, "files whose names say directions, like tl015_pl030_tv045_pv060.jpg");
    return ignored;
  }

  vtkImageData* NewPicture(int index) override
  {
    const Photograph& photograph = this->Get(index);
    if (photograph.Picture || photograph.Name.empty()) // added by hand, or not there
    {
      return this->Superclass::NewPicture(index);
    }
    vtkImageData* picture = nullptr;
    std::string error;
    if (!CatchFileError(
          photograph.Name, error, [&]() { picture = this->ReadPicture(photograph.Name); }))
    {
      vtkErrorMacro("NewPicture: " << error);
    }
    return picture;
  }

private:
  void TakeSettings(const std::string& path, const ListObject& root)
  {
    root.GetNumber("irradiance", this->Irradiance);
    root.GetNumber("gamma", this->Gamma);
    root.GetNumber("saturation", this->SaturationLevel);
    root.GetNumber("black", this->BlackLevel);
    Require(this->Irradiance > 0.0 && this->Gamma >= 0.1 && this->Gamma <= 10.0, path,
      ": expected an irradiance > 0 and a gamma from 0.1 to 10");
    const json levels = root.Get("levels_for_floats", false);
    Require(levels.is_boolean(), path, ": levels_for_floats: expected true or false");
    this->LevelsForFloats = levels.get<bool>();
    const json transfer = root.Get("transfer", "automatic");
    const auto known =
      Transfers.find(transfer.is_string() ? transfer.get<std::string>() : std::string());
    Require(
      known != Transfers.end(), path, ": transfer: expected automatic, linear, srgb or power");
    this->Transfer = known->second;
  }

  void Take(const std::string& path, const std::vector<Photograph>& photographs, const char* what)
  {
    constexpr std::size_t most = MaximumNumberOfPhotographs;
    const std::size_t found = photographs.size();
    Require(
      found >= 1 && found <= most, path, ": found ", found, " ", what, ", expected 1 to ", most);
    for (const Photograph& photograph : photographs)
    {
      CheckFile(photograph.Name);
      Require(this->Insert(photograph) >= 0, photograph.Name, ": the photograph was refused");
    }
  }

  vtkImageData* ReadPicture(const std::string& path)
  {
    const ImageFile file = ReadImageFile(path);
    Require(!file.IsInteger || file.IsEncoded || this->Transfer != AUTOMATIC, path,
      ": the file says that its integers are linear, while 'automatic' takes integers by sRGB's "
      "curve: set the transfer to linear or srgb");
    const auto picture = MakeImageData(file, file.IsInteger);
    picture->Register(nullptr); // the caller's
    return picture;
  }
};
vtkStandardNewMacro(FilePhotographSet);
}

//------------------------------------------------------------------------------
vtkPhotographSetReader::vtkPhotographSetReader() = default;
vtkPhotographSetReader::~vtkPhotographSetReader() = default;

//------------------------------------------------------------------------------
vtkPhotographSet* vtkPhotographSetReader::GetPhotographs() { return this->Photographs; }

//------------------------------------------------------------------------------
bool vtkPhotographSetReader::Read()
{
  this->ErrorMessage.clear();
  const bool done = measuredbrdf::CatchFileError(this->FileName, this->ErrorMessage,
    [&]()
    {
      const auto read = vtkSmartPointer<FilePhotographSet>::New();
      vtkIdType ignored = 0;
      std::error_code error;
      if (std::filesystem::is_directory(this->FileName, error))
      {
        ignored = read->ReadFolder(this->FileName);
      }
      else
      {
        read->ReadList(this->FileName);
      }
      this->Photographs = read;
      this->NumberOfIgnoredFiles = ignored;
    });
  if (!done)
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  return done;
}

//------------------------------------------------------------------------------
void vtkPhotographSetReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << ToPrintable(this->FileName) << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "NumberOfIgnoredFiles: " << this->NumberOfIgnoredFiles << "\n";
  os << indent << "Photographs: " << this->Photographs.Get() << "\n";
}
