// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * ASAM OpenMATERIAL 3D's BRDF look-up tables (.xompt; schema material_brdf_schema.json of versions
 * 1.0 and 1.1): JSON with "metadata" and "brdf". "brdf" holds rows of wavelength (m), zenith angles
 * of incidence and exit, azimuth of exit from incidence (rad), and f (1/sr). The material is
 * isotropic. An azimuth of 0 is on the side from which the light comes; azimuths run
 * counterclockwise, seen from above the surface (the standard does not say).
 *
 * Several visible wavelengths become RGB (SpectralColor.cxx). A single one, or wavelengths of which
 * fewer than two are visible, give gray, by the first of them; `path#905nm` picks one.
 */

#include "BoundedJson.h"
#include "HalfVector.h"
#include "MaterialFormat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
using Json = nlohmann::json;

constexpr const char* OpenMaterialFormatName = "OpenMATERIAL 3D";
constexpr const char* TableName = "lookupTable";
constexpr const char* MetadataNames[] = { "name", "sources", "authors", "copyrights", "license" };
constexpr std::size_t LongestText = 1000; // of the metadata, in bytes
constexpr std::size_t MostWavelengths = 4096;
constexpr double Nanometer = 1e-9;
constexpr double SameWavelength = 1e-6;   // relative
constexpr double RoundingOfAngles = 1e-5; // rad, of six decimals

// Wavelength (m), zenith angle of incidence, of exit, azimuth of exit from incidence (rad), f
// (1/sr).
using OpenMaterialRow = std::array<double, 5>;

template <typename... Pieces>
void RequireOf(
  const FileBytes& file, bool condition, const std::string& field, const Pieces&... what)
{
  if (!condition)
  {
    FailIn(file, OpenMaterialFormatName, field, what...);
  }
}

//------------------------------------------------------------------------------
// The text, or the texts of a list, with ", " between.
std::string JoinTexts(const Json& value)
{
  std::string joined;
  for (const Json& text : value.is_array() ? value : Json::array({ value }))
  {
    const std::string more =
      text.is_string() ? (joined.empty() ? "" : ", ") + text.get<std::string>() : std::string();
    joined += joined.size() + more.size() <= LongestText ? more : "";
  }
  return joined;
}

Json ParseOpenMaterial(const FileBytes& file)
{
  try
  {
    return ParseJson<Json>(file.GetView());
  }
  catch (const Json::exception& problem)
  {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..."; or of a
    // number that is too large, in quotes, without its place.
    const std::string text = problem.what();
    const auto* parse = dynamic_cast<const Json::parse_error*>(&problem);
    const std::size_t quote = text.find('\'');
    const std::string number =
      quote == std::string::npos ? "" : text.substr(quote + 1, text.rfind('\'') - quote - 1);
    const std::size_t at = parse ? parse->byte : file.GetView().find(number);
    ByteReader(file, OpenMaterialFormatName).FailAt(at, "JSON", text.substr(text.find("] ") + 2));
  }
  catch (const std::runtime_error& problem)
  {
    FailIn(file, OpenMaterialFormatName, "JSON", problem.what());
  }
}

// What a row holds, with the schema's bounds; azimuths may be counted the other way round.
struct OpenMaterialNumber
{
  const char* Name;
  double Least;
  double Most;
};
constexpr double LargestValue = std::numeric_limits<float>::max();
constexpr OpenMaterialNumber Numbers[] = { { "wavelength", 1e-9, 17.16e-3 },
  { "incident zenith angle", 0.0, 0.5 * Pi }, { "exit zenith angle", 0.0, 0.5 * Pi },
  { "exit azimuth angle", -2.0 * Pi, 2.0 * Pi }, { "value", -LargestValue, LargestValue } };

// Whether a row of the table was read; not where it holds a null. Throws FileError, "PLACE: ...",
// for any other that is no five numbers in their bounds.
bool ParseRow(const FileBytes& file, std::size_t index, const Json& value, OpenMaterialRow& row)
{
  const auto require = [&](bool condition, const auto&... what)
  {
    if (!condition)
    {
      FailIn(file, OpenMaterialFormatName, Concat(TableName, ", row ", index + 1), what...);
    }
  };
  require(value.is_array(), "found ", value.type_name(), " alone, expected five numbers");
  bool hasNull = false;
  for (const Json& number : value)
  {
    require(number.is_number() || number.is_null(), "found ", number.type_name(),
      ", expected five numbers");
    hasNull = hasNull || number.is_null();
  }
  require(value.size() == row.size(), "found ", value.size(),
    " numbers, expected 5: wavelength, three angles, value");
  if (hasNull)
  {
    return false;
  }
  value.get_to(row);
  for (std::size_t k = 0; k < row.size(); ++k)
  {
    const double margin = k == 0 ? 0.0 : RoundingOfAngles;
    require(row[k] >= Numbers[k].Least - margin && row[k] <= Numbers[k].Most + margin,
      Numbers[k].Name, " is ", row[k], ", expected ", Numbers[k].Least, " to ", Numbers[k].Most);
  }
  return true;
}

//------------------------------------------------------------------------------
struct OpenMaterialTable
{
  std::string Name;                  // of the metadata
  std::string Source;                // the other metadata: "; license: ..."
  std::vector<OpenMaterialRow> Rows; // but for those that hold a null
  std::size_t Nulls = 0;             // rows left out
};

// Throws FileError where it is no JSON, has no "brdf" with a "lookupTable" of rows of five numbers,
// or has one twice.
OpenMaterialTable ReadTable(const FileBytes& file)
{
  const Json document = ParseOpenMaterial(file);
  const auto brdf = document.find("brdf");
  RequireOf(file, brdf != document.end() && brdf->is_object(), "brdf",
    "is missing: expected the look-up table of a BRDF (NAME_brdf.xompt), not another property");
  const auto rows = brdf->find(TableName);
  RequireOf(file, rows != brdf->end() && rows->is_array(), TableName, "is missing in 'brdf'");
  const std::string key = Concat('"', TableName, '"');
  const bool isAlone =
    file.GetView().find(key, file.GetView().find(key) + 1) == std::string_view::npos;
  RequireOf(file, isAlone, TableName, "appears twice"); // of which JSON keeps one
  OpenMaterialTable table;
  for (std::size_t k = 0; k < rows->size(); ++k)
  {
    OpenMaterialRow row = {};
    if (ParseRow(file, k, (*rows)[k], row))
    {
      table.Rows.push_back(row);
    }
  }
  table.Nulls = rows->size() - table.Rows.size();
  const Json metadata = document.value("metadata", Json::object());
  for (const std::string name : MetadataNames)
  {
    const std::string text =
      metadata.is_object() && metadata.contains(name) ? JoinTexts(metadata[name]) : "";
    if (name == "name")
    {
      table.Name = text;
    }
    else if (!text.empty())
    {
      table.Source += "; " + name + ": " + text;
    }
  }
  return table;
}

//------------------------------------------------------------------------------
// Ascending, in nanometers, those that rounding explains once.
std::vector<double> FindWavelengths(const FileBytes& file, const OpenMaterialTable& table)
{
  std::vector<double> all;
  for (const OpenMaterialRow& row : table.Rows)
  {
    all.push_back(row[0] / Nanometer);
  }
  std::sort(all.begin(), all.end());
  const auto isSame = [](double kept, double other)
  { return other <= kept * (1.0 + SameWavelength); };
  all.erase(std::unique(all.begin(), all.end(), isSame), all.end());
  RequireOf(file, all.size() <= MostWavelengths, TableName, "found ", all.size(),
    " wavelengths, expected at most ", MostWavelengths);
  return all;
}

//------------------------------------------------------------------------------
// A reading for each of the different directions at which all chosen wavelengths were read.
std::vector<GonioReading> GetReadings(const FileBytes& file, const OpenMaterialTable& table,
  const std::vector<double>& wavelengths, const SpectralChannels& channels, MaterialFile& result)
{
  const auto toDegrees = [](double radians, float least, float most)
  { return std::clamp(static_cast<float>(ToDegrees(radians)), least, most); };
  struct Mean
  {
    double Sum = 0.0;
    int Count = 0;
  };
  using Angles = std::array<float, 3>;                   // theta_i, theta_o, phi; degrees
  std::map<std::pair<Angles, std::size_t>, Mean> values; // by the place in channels.Chosen, too
  for (const OpenMaterialRow& row : table.Rows)
  {
    const auto next = std::upper_bound(wavelengths.begin(), wavelengths.end(), row[0] / Nanometer);
    const auto wavelength = static_cast<std::size_t>(next - wavelengths.begin()) - 1;
    const auto found = std::lower_bound(channels.Chosen.begin(), channels.Chosen.end(), wavelength);
    if (found != channels.Chosen.end() && *found == wavelength)
    {
      const Angles angles = { toDegrees(row[1], 0.0f, 90.0f), toDegrees(row[2], 0.0f, 90.0f),
        toDegrees(row[3], -360.0f, 360.0f) };
      Mean& mean = values[{ angles, std::size_t(found - channels.Chosen.begin()) }];
      mean.Sum += row[4];
      ++mean.Count;
    }
  }
  std::vector<GonioReading> readings;
  std::int64_t incomplete = 0;
  for (auto value = values.begin(); value != values.end();)
  {
    const Angles angles = value->first.first;
    glm::dvec3 color(0.0);
    std::size_t read = 0; // channels
    for (; value != values.end() && value->first.first == angles; ++value, ++read)
    {
      const Mean& mean = value->second;
      color += channels.Weights[value->first.second] * (mean.Sum / mean.Count);
    }
    if (read == channels.Chosen.size())
    {
      readings.push_back({ angles[0], 0.0f, angles[1], angles[2], color });
    }
    else
    {
      ++incomplete;
    }
  }
  RequireOf(file, !readings.empty(), TableName, "its ", channels.Chosen.size(),
    " wavelengths have no directions in common");
  NoteCount(incomplete, " directions lack some of the wavelengths: left out.", result);
  return readings;
}

//------------------------------------------------------------------------------
MaterialFile ReadOpenMaterial(const FileBytes& file, const std::string& material)
{
  const OpenMaterialTable table = ReadTable(file);
  RequireOf(file, !table.Rows.empty(), TableName, "found no row without a null");
  MaterialFile result;
  result.NumberOfNegativeValues = std::count_if(
    table.Rows.begin(), table.Rows.end(), [](const OpenMaterialRow& row) { return row[4] < 0.0; });
  const std::vector<double> wavelengths = FindWavelengths(file, table);
  const std::string place = file.GetPath() + ": " + OpenMaterialFormatName;
  const SpectralChannels channels = ChooseChannels(wavelengths, material, place);
  result.AddNote(channels.Note);
  MakeGonioTable(
    GetReadings(file, table, wavelengths, channels, result), place + ", " + TableName, result);
  NoteCount(std::int64_t(table.Nulls), " rows hold a null: left out.", result);
  NameAfterFile(result, file, OpenMaterialFormatName, table.Source);
  result.BRDF->SetName((table.Name.empty() ? result.BRDF->GetName() : table.Name) +
                       (material.empty() ? "" : " " + material));
  return result;
}

//------------------------------------------------------------------------------
// The extension, or JSON with the names that the format's files begin with.
bool CanReadOpenMaterial(const vtkBRDFFormat::File& file)
{
  const std::string_view start = file.Bytes.substr(0, 4096);
  const std::size_t first = start.find_first_not_of(std::string_view("\xef\xbb\xbf \t\r\n", 7));
  return HasExtension(file.Path, ".xompt") ||
         (first != std::string_view::npos && start[first] == '{' &&
           (start.find("OpenMATERIAL-3D") != std::string_view::npos ||
             start.find("openMaterial3dVersion") != std::string_view::npos));
}
}

const MaterialFormat OpenMaterialFormat = { OpenMaterialFormatName, "OpenMATERIAL 3D .xompt",
  ".xompt", CanReadOpenMaterial, ReadOpenMaterial, [](const FileBytes& file) {
    return GetWavelengthNames(FindWavelengths(file, ReadTable(file)));
  } };
} // namespace measuredbrdf
