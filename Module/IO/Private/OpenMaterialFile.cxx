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
 * Several visible wavelengths become RGB (SpectralColor.h). A single one, or wavelengths of which
 * fewer than two are visible, give gray, by the first of them; `path#905nm` picks one.
 */

#include "GonioTable.h"
#include "MaterialFormat.h"
#include "NumberText.h"
#include "SpectralColor.h"
#include "vtkNew.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
using Json = nlohmann::json;

constexpr const char* OpenMaterialFormatName = "OpenMATERIAL 3D";

using Row = std::array<double, 5>;

struct OpenMaterialTexts
{
  std::map<std::string, std::string> Metadata; // its texts, and lists of texts joined by ", "
  /// Wavelength (m), zenith angle of incidence, of exit, azimuth of exit from incidence (rad), f
  /// (1/sr). Rows that hold a null are left out.
  std::vector<Row> Rows;
  std::size_t Nulls = 0; // rows left out
};

constexpr int DeepestLevel = 32;
constexpr std::size_t LongestText = 1000; // of the metadata, in bytes
constexpr const char* TableName = "lookupTable";
constexpr const char* MetadataNames[] = { "name", "sources", "authors", "copyrights", "license" };

[[noreturn]] void Fail(const FileBytes& file, const std::string& field, const std::string& what)
{
  throw FileError(file.GetPath() + ": " + OpenMaterialFormatName + ", " + field + ": " + what);
}

/// Takes what is known, wherever it stands in the right place, as the parser comes by; of the
/// document nothing but a row is kept.
class OpenMaterialParser
{
public:
  explicit OpenMaterialParser(const FileBytes& file)
    : File(file)
  {
  }

  // Throws FileError where it is no JSON, is nested deeper than 32 levels, has no "brdf" with a
  // "lookupTable" of rows of five numbers, or has one twice.
  OpenMaterialTexts Parse()
  {
    try
    {
      const char* bytes = this->File.GetData();
      const auto take = [this](int depth, Json::parse_event_t event, const Json& value)
      { return this->Take(depth, event, value); };
      std::ignore = Json::parse(bytes, bytes + this->File.GetSize(), take);
    }
    catch (const Json::exception& problem)
    {
      this->FailToParse(problem);
    }
    if (!this->HasBrdf)
    {
      Fail(this->File, "brdf",
        "is missing: expected the look-up table of a BRDF (NAME_brdf.xompt), not another property");
    }
    if (!this->HasTable)
    {
      Fail(this->File, TableName, "is missing in 'brdf'");
    }
    return std::move(this->Texts);
  }

private:
  // Whether to keep what the event is of; depth: of levels around it.
  bool Take(int depth, Json::parse_event_t event, const Json& value)
  {
    using Event = Json::parse_event_t;
    const bool begins = event == Event::object_start || event == Event::array_start;
    if (begins && depth >= DeepestLevel)
    {
      Fail(this->File, "JSON", "is nested deeper than " + std::to_string(DeepestLevel) + " levels");
    }
    if (event == Event::key && depth == 1)
    {
      this->Top = value.get<std::string>();
      this->Second.clear();
      return this->Top == "metadata" || this->Top == "brdf";
    }
    const bool isTable = this->Top == "brdf" && this->Second == TableName;
    if (event == Event::key && depth == 2)
    {
      this->Second = value.get<std::string>();
      return this->Top == "brdf" ? this->Second == TableName
                                 : std::find(std::begin(MetadataNames), std::end(MetadataNames),
                                     this->Second) != std::end(MetadataNames);
    }
    if (event == Event::value && value.is_string() && this->Top == "metadata")
    {
      std::string& text = this->Texts.Metadata[this->Second];
      const std::string more = (text.empty() ? "" : ", ") + value.get<std::string>();
      text += text.size() + more.size() <= LongestText ? more : "";
    }
    else if (isTable && depth == 3 && !begins && event != Event::key)
    {
      this->TakeRow(value);
      return false;
    }
    this->HasBrdf =
      this->HasBrdf || (event == Event::object_start && depth == 1 && this->Top == "brdf");
    if (isTable && event == Event::array_start && depth == 2)
    {
      if (this->HasTable)
      {
        Fail(this->File, TableName, "appears twice");
      }
      this->HasTable = true;
    }
    return isTable || (event == Event::object_start ? depth <= 1 : begins && depth == 2);
  }

  void TakeRow(const Json& value)
  {
    const auto fail = [this](const std::string& what)
    {
      Fail(this->File,
        std::string(TableName) + ", row " +
          std::to_string(this->Texts.Rows.size() + this->Texts.Nulls + 1),
        "found " + what);
    };
    const auto expectNumbers = [&fail](const Json& found)
    {
      const char* const what = found.is_object()    ? "an object"
                               : found.is_array()   ? "a list"
                               : found.is_string()  ? "a text"
                               : found.is_boolean() ? "a truth value"
                                                    : "a number alone";
      fail(std::string(what) + ", expected five numbers");
    };
    if (!value.is_array())
    {
      expectNumbers(value);
    }
    for (const Json& number : value)
    {
      if (!number.is_number() && !number.is_null())
      {
        expectNumbers(number);
      }
    }
    Row row = {};
    if (value.size() != row.size())
    {
      fail(std::to_string(value.size()) + " numbers, expected 5: wavelength, three angles, value");
    }
    if (std::any_of(value.begin(), value.end(), [](const Json& one) { return one.is_null(); }))
    {
      ++this->Texts.Nulls;
      return;
    }
    std::transform(
      value.begin(), value.end(), row.begin(), [](const Json& one) { return one.get<double>(); });
    this->Texts.Rows.push_back(row);
  }

  [[noreturn]] void FailToParse(const Json::exception& problem) const
  {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..."; or of a
    // number that is too large, in quotes, without its place.
    const std::string text = problem.what();
    const auto* parse = dynamic_cast<const Json::parse_error*>(&problem);
    const std::size_t quote = text.find('\'');
    const std::string number =
      quote == std::string::npos ? "" : text.substr(quote + 1, text.rfind('\'') - quote - 1);
    const std::size_t at = parse ? parse->byte : this->File.GetView().find(number);
    const std::size_t bracket = text.find("] ");
    ByteReader(this->File, OpenMaterialFormatName)
      .FailAt(at, "JSON", bracket == std::string::npos ? text : text.substr(bracket + 2));
  }

  const FileBytes& File;
  OpenMaterialTexts Texts;
  std::string Top;    // key in the file's object
  std::string Second; // key in that
  bool HasBrdf = false;
  bool HasTable = false;
};

constexpr double Degree = 3.14159265358979323846 / 180.0;
constexpr double Nanometer = 1e-9;
constexpr double SameWavelength = 1e-6; // relative
constexpr std::size_t MostWavelengths = 4096;
// What rounding to six decimals adds to an angle, rad.
constexpr double Rounding = 1e-5;
// Cells of angles and wavelengths for each row; small tables may be emptier.
constexpr std::size_t CellsPerRow = 4;
constexpr std::size_t SmallTable = 4096;

//------------------------------------------------------------------------------
void CheckRow(const FileBytes& file, const Row& row, std::size_t number)
{
  struct Range
  {
    const char* Name;
    double Least;
    double Most;
  };
  // The schema's, and azimuths counted the other way round.
  constexpr Range ranges[] = { { "wavelength", 1e-9, 17.16e-3 },
    { "incident zenith angle", 0.0, 90.0 * Degree }, { "exit zenith angle", 0.0, 90.0 * Degree },
    { "exit azimuth angle", -360.0 * Degree, 360.0 * Degree },
    { "value", -std::numeric_limits<float>::max(), std::numeric_limits<float>::max() } };
  for (std::size_t k = 0; k < row.size(); ++k)
  {
    const double margin = k == 0 ? 0.0 : Rounding;
    if (!(row[k] >= ranges[k].Least - margin && row[k] <= ranges[k].Most + margin) ||
        !std::isfinite(static_cast<float>(row[k])))
    {
      Fail(file, "lookupTable, row " + std::to_string(number),
        std::string(ranges[k].Name) + " is " + NumberText(row[k]) + ", expected " +
          NumberText(ranges[k].Least) + " to " + NumberText(ranges[k].Most));
    }
  }
}

// Ascending, those that rounding explains once.
std::vector<double> FindWavelengths(const FileBytes& file, const std::vector<Row>& rows)
{
  std::vector<double> all;
  for (const Row& row : rows)
  {
    all.push_back(row[0]);
  }
  std::sort(all.begin(), all.end());
  std::vector<double> different;
  for (const double wavelength : all)
  {
    if (different.empty() || wavelength > different.back() * (1.0 + SameWavelength))
    {
      different.push_back(wavelength);
    }
  }
  if (different.size() > MostWavelengths)
  {
    Fail(file, "lookupTable",
      "found " + std::to_string(different.size()) + " wavelengths, expected at most " +
        std::to_string(MostWavelengths));
  }
  return different;
}

std::vector<double> ToNanometers(std::vector<double> wavelengths)
{
  for (double& wavelength : wavelengths)
  {
    wavelength /= Nanometer;
  }
  return wavelengths;
}

std::size_t FindWavelength(const std::vector<double>& wavelengths, double wavelength)
{
  const auto next = std::upper_bound(wavelengths.begin(), wavelengths.end(), wavelength);
  return static_cast<std::size_t>(next - wavelengths.begin()) - 1;
}

//------------------------------------------------------------------------------
// A reading for each of the different directions, a channel for each chosen wavelength.
GonioReadings Arrange(const FileBytes& file, const std::vector<Row>& rows,
  const std::vector<double>& wavelengths, const std::vector<double>& chosen)
{
  const auto toDegrees = [](double radians)
  { return std::clamp(static_cast<float>(radians / Degree), -360.0f, 360.0f); };
  std::vector<std::pair<GonioAngles, std::size_t>> listed; // directions and row
  std::vector<std::size_t> channels(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const double wavelength = wavelengths[FindWavelength(wavelengths, rows[k][0])];
    const auto found = std::lower_bound(chosen.begin(), chosen.end(), wavelength);
    if (found != chosen.end() && *found == wavelength)
    {
      channels[k] = static_cast<std::size_t>(found - chosen.begin());
      listed.push_back({ { std::clamp(toDegrees(rows[k][1]), 0.0f, 90.0f), 0.0f,
                           std::clamp(toDegrees(rows[k][2]), 0.0f, 90.0f), toDegrees(rows[k][3]) },
        k });
    }
  }
  const auto toTuple = [](const GonioAngles& angles) {
    return std::array<float, 3>{ angles.ThetaI, angles.ThetaO, angles.PhiO };
  };
  // Rows of the same directions side by side, and one behind the other where they repeat.
  std::stable_sort(listed.begin(), listed.end(),
    [&](const auto& a, const auto& b) { return toTuple(a.first) < toTuple(b.first); });

  GonioReadings readings;
  readings.Channels = chosen.size();
  const std::size_t most = CellsPerRow * rows.size() + SmallTable;
  std::vector<std::size_t> taken(readings.Channels, 0); // the last reading that has the channel
  const float unread = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [angles, row] : listed)
  {
    const std::size_t channel = channels[row];
    const std::size_t count = readings.Angles.size();
    if (count == 0 || toTuple(readings.Angles.back()) != toTuple(angles) || taken[channel] == count)
    {
      if ((count + 1) * readings.Channels > most)
      {
        Fail(file, "lookupTable",
          "its " + std::to_string(readings.Channels) +
            " wavelengths have too few directions in common");
      }
      readings.Angles.push_back(angles);
      readings.Values.resize(readings.Values.size() + readings.Channels, unread);
    }
    taken[channel] = readings.Angles.size();
    readings.Values[(taken[channel] - 1) * readings.Channels + channel] =
      static_cast<float>(rows[row][4]);
  }
  return readings;
}

//------------------------------------------------------------------------------
std::string DescribeSource(const FileBytes& file, const OpenMaterialTexts& texts)
{
  std::string source = "OpenMATERIAL 3D file " + GetFileTitle(file.GetPath());
  for (const std::string field : MetadataNames)
  {
    const auto found = texts.Metadata.find(field);
    if (field != "name" && found != texts.Metadata.end() && !found->second.empty())
    {
      source += "; " + field + ": " + found->second;
    }
  }
  return source;
}
//------------------------------------------------------------------------------
MaterialFile ReadOpenMaterial(const FileBytes& file, const std::string& material)
{
  const OpenMaterialTexts texts = OpenMaterialParser(file).Parse();
  if (texts.Rows.empty())
  {
    Fail(file, "lookupTable", "found no row without a null");
  }
  MaterialFile result;
  for (std::size_t k = 0; k < texts.Rows.size(); ++k)
  {
    CheckRow(file, texts.Rows[k], k + 1);
    result.NumberOfNegativeValues += texts.Rows[k][4] < 0.0;
  }
  const std::vector<double> wavelengths = FindWavelengths(file, texts.Rows);
  SpectralChannels channels;
  const std::string unknown = channels.Choose(ToNanometers(wavelengths), material);
  if (!unknown.empty())
  {
    Fail(file, "name", unknown);
  }
  result.AddNote(channels.Note);
  std::vector<double> chosen;
  for (const std::size_t k : channels.Chosen)
  {
    chosen.push_back(wavelengths[k]);
  }
  GonioReadings readings = Arrange(file, texts.Rows, wavelengths, chosen);
  readings.Weights = channels.Weights;
  const std::string problem = MakeGonioTable(std::move(readings), result);
  if (!problem.empty())
  {
    Fail(file, "lookupTable", problem);
  }
  if (texts.Nulls > 0)
  {
    result.AddNote(std::to_string(texts.Nulls) + " rows hold a null: left out.");
  }
  const auto name = texts.Metadata.find("name");
  const bool named = name != texts.Metadata.end() && !name->second.empty();
  result.BRDF->SetName((named ? name->second : GetFileStem(file.GetPath())) +
                       (material.empty() ? "" : " " + material));
  result.BRDF->SetSource(DescribeSource(file, texts));
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

//------------------------------------------------------------------------------
std::vector<std::string> ListOpenMaterialWavelengths(const FileBytes& file)
{
  std::vector<std::string> names;
  for (const double wavelength :
    ToNanometers(FindWavelengths(file, OpenMaterialParser(file).Parse().Rows)))
  {
    names.push_back(GetWavelengthName(wavelength));
  }
  return names;
}
}

const MaterialFormat OpenMaterialFormat = { OpenMaterialFormatName, "OpenMATERIAL 3D .xompt",
  ".xompt", CanReadOpenMaterial, ReadOpenMaterial, ListOpenMaterialWavelengths };
} // namespace measuredbrdf
