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
#include <limits>
#include <map>
#include <numeric>
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

struct OpenMaterialTexts
{
  std::map<std::string, std::string> Metadata; // its texts, and lists of texts joined by ", "
  std::vector<double> Wavelengths;             // m; as listed
  /// Wavelength (m), zenith angle of incidence, of exit, azimuth of exit from incidence (rad), f
  /// (1/sr). Rows that hold a null are left out.
  std::vector<std::array<double, 5>> Rows;
  std::size_t Nulls = 0; // rows left out
};

constexpr std::size_t DeepestLevel = 32;
constexpr std::size_t RowSize = 5;
constexpr std::size_t LongestText = 1000; // of the metadata, in bytes

const char* const TableName = "lookupTable";

[[noreturn]] void Fail(const FileBytes& file, const std::string& field, const std::string& what)
{
  throw FileError(file.GetPath() + ": " + OpenMaterialFormatName + ", " + field + ": " + what);
}

/// Takes what is known, wherever it stands in the right place, and steps over everything else.
class Handler : public nlohmann::json_sax<Json>
{
public:
  explicit Handler(const FileBytes& file)
    : Reader(file, OpenMaterialFormatName)
  {
  }

  OpenMaterialTexts Texts;
  bool HasBrdf = false;
  bool HasReadings = false;

  [[noreturn]] void Fail(const std::string& field, const std::string& what) const
  {
    measuredbrdf::Fail(this->Reader.GetFile(), field, what);
  }

  bool null() override
  {
    this->Add(0.0, true);
    return true;
  }
  bool boolean(bool) override { return this->Refuse("a truth value"); }
  bool number_integer(std::int64_t value) override { return this->Add(double(value), false); }
  bool number_unsigned(std::uint64_t value) override { return this->Add(double(value), false); }
  bool number_float(double value, const std::string&) override { return this->Add(value, false); }
  bool binary(Json::binary_t&) override { return this->Refuse("bytes"); }

  bool string(std::string& value) override
  {
    const bool isListed = this->Levels.size() == 3 && this->Levels[2] == Array;
    if (this->Top == "metadata" && (this->Levels.size() == 2 || isListed))
    {
      std::string& text = this->Texts.Metadata[this->Second];
      if (text.size() + value.size() < LongestText)
      {
        text += (text.empty() ? "" : ", ") + value;
      }
    }
    return this->Refuse("a text");
  }

  bool key(std::string& name) override
  {
    if (this->Levels.size() == 1)
    {
      this->Top = name;
    }
    else if (this->Levels.size() == 2)
    {
      this->Second = name;
      if (this->Top == "metadata" && this->Texts.Metadata.size() >= DeepestLevel)
      {
        this->Second.clear(); // more names than the format has: left out together
      }
    }
    return true;
  }

  bool start_object(std::size_t) override
  {
    this->Refuse("an object");
    if (this->Levels.size() == 1 && this->Top == "brdf")
    {
      this->HasBrdf = true;
    }
    return this->Enter(Object);
  }
  bool end_object() override { return this->Leave(); }

  bool start_array(std::size_t) override
  {
    if (this->Levels.size() == 2 && this->IsIn(TableName))
    {
      if (this->HasReadings)
      {
        this->Fail(TableName, "appears twice");
      }
      this->HasReadings = true;
    }
    else if (this->IsInRow())
    {
      this->Refuse("a list");
    }
    else if (this->IsInTable())
    {
      this->Count = 0;
      this->HasNull = false;
    }
    return this->Enter(Array);
  }

  bool end_array() override
  {
    if (this->IsInRow())
    {
      if (this->Count != RowSize)
      {
        this->Fail(this->GetRow(), "found " + std::to_string(this->Count) +
                                     " numbers, expected 5: wavelength, three angles, value");
      }
      if (this->HasNull)
      {
        ++this->Texts.Nulls;
      }
      else
      {
        this->Texts.Rows.push_back(this->Row);
      }
    }
    return this->Leave();
  }

  bool parse_error(
    std::size_t position, const std::string&, const nlohmann::detail::exception& problem) override
  {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..."
    const std::string text = problem.what();
    const std::size_t bracket = text.find("] ");
    this->Reader.FailAt(
      position, "JSON", bracket == std::string::npos ? text : text.substr(bracket + 2));
  }

private:
  enum Level : char
  {
    Object,
    Array
  };

  bool IsIn(const char* name) const { return this->Top == "brdf" && this->Second == name; }
  bool IsInTable() const
  {
    return this->Levels.size() == 3 && this->Levels[2] == Array && this->IsIn(TableName);
  }
  bool IsInRow() const
  {
    return this->Levels.size() == 4 && this->Levels[2] == Array && this->IsIn(TableName);
  }
  std::string GetRow() const
  {
    return std::string(TableName) + ", row " +
           std::to_string(this->Texts.Rows.size() + this->Texts.Nulls + 1);
  }

  // What must not be among the table's numbers.
  bool Refuse(const char* what) const
  {
    if (this->IsInRow() || this->IsInTable())
    {
      this->Fail(this->GetRow(), std::string("found ") + what + ", expected five numbers");
    }
    return true;
  }

  bool Add(double value, bool isNull)
  {
    if (this->IsInRow())
    {
      if (this->Count < RowSize)
      {
        this->Row[this->Count] = value;
      }
      ++this->Count;
      this->HasNull = this->HasNull || isNull;
    }
    else if (this->IsInTable())
    {
      this->Refuse("a number alone");
    }
    else if (this->Levels.size() == 3 && this->IsIn("wavelengths") && !isNull)
    {
      this->Texts.Wavelengths.push_back(value);
    }
    return true;
  }

  bool Enter(Level level)
  {
    if (this->Levels.size() == DeepestLevel)
    {
      this->Fail("JSON", "is nested deeper than " + std::to_string(DeepestLevel) + " levels");
    }
    this->Levels.push_back(level);
    return true;
  }

  bool Leave()
  {
    this->Levels.pop_back();
    if (this->Levels.size() < 3)
    {
      (this->Levels.size() < 2 ? this->Top : this->Second).clear();
    }
    return true;
  }

  ByteReader Reader;
  std::vector<Level> Levels; // of which the place is inside
  std::string Top;           // key in the file's object
  std::string Second;        // key in that
  std::array<double, RowSize> Row = {};
  std::size_t Count = 0; // of the row's numbers
  bool HasNull = false;
};

//------------------------------------------------------------------------------
// Without building a tree: memory is at most five times the file's size. Throws FileError where it
// is no JSON, is nested deeper than 32 levels, has no "brdf" with a "lookupTable" of rows of five
// numbers, or has one twice.
OpenMaterialTexts ParseOpenMaterial(const FileBytes& file)
{
  Handler handler(file);
  const char* bytes = file.GetData();
  Json::sax_parse(bytes, bytes + file.GetSize(), &handler);
  if (!handler.HasBrdf)
  {
    handler.Fail("brdf",
      "is missing: expected the look-up table of a BRDF (NAME_brdf.xompt), not another property");
  }
  if (!handler.HasReadings)
  {
    handler.Fail(TableName, "is missing in 'brdf'");
  }
  return std::move(handler.Texts);
}
using Row = std::array<double, 5>;

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
  for (const char* field : { "sources", "authors", "copyrights", "license" })
  {
    const auto found = texts.Metadata.find(field);
    if (found != texts.Metadata.end() && !found->second.empty())
    {
      source += std::string("; ") + field + ": " + found->second;
    }
  }
  return source;
}
//------------------------------------------------------------------------------
MaterialFile ReadOpenMaterial(const FileBytes& file, const std::string& material)
{
  const OpenMaterialTexts texts = ParseOpenMaterial(file);
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
  GonioTable table;
  const std::string problem = table.Make(std::move(readings));
  if (!problem.empty())
  {
    Fail(file, "lookupTable", problem);
  }
  for (const std::string& note : table.Notes)
  {
    result.AddNote(note);
  }
  if (texts.Nulls > 0)
  {
    result.AddNote(std::to_string(texts.Nulls) + " rows hold a null: left out.");
  }
  const auto name = texts.Metadata.find("name");
  const bool named = name != texts.Metadata.end() && !name->second.empty();
  table.BRDF->SetName((named ? name->second : GetFileStem(file.GetPath())) +
                      (material.empty() ? "" : " " + material));
  table.BRDF->SetSource(DescribeSource(file, texts));
  result.BRDF = table.BRDF;
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
  for (const double wavelength : ToNanometers(FindWavelengths(file, ParseOpenMaterial(file).Rows)))
  {
    names.push_back(GetWavelengthName(wavelength));
  }
  return names;
}
}

const MaterialFormat OpenMaterialFormat = { OpenMaterialFormatName, "OpenMATERIAL 3D .xompt",
  ".xompt", CanReadOpenMaterial, ReadOpenMaterial, ListOpenMaterialWavelengths };
} // namespace measuredbrdf
