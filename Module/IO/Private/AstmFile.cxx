// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Text of goniometers after ASTM E1392, "Angle resolved optical scatter measurements on specular or
 * diffuse surfaces", in the form of Cornell's Light Measurement Laboratory (.astm): lines of a key
 * and its value, NUM_POINTS among them, up to the line VARS, which names the columns; then a row of
 * numbers, with commas between, for each reading.
 *
 * Columns, in any order: theta_i, phi_i of the light and theta_s, phi_s of the view in one frame
 * (phi_i may be absent: 0), in radians, or in degrees where a polar angle exceeds pi/2; and f in
 * 1/sr as R,G,B (linear Rec. 709), as X,Y,Z (CIE 1931 under D65), at wavelengths (550nm,
 * SpectralColor.cxx; FILE#550nm picks one), or in one column of any name (gray). A negative polar
 * angle is on the other side of the normal. Where phi_i is the same in all rows the material is
 * isotropic (GonioTable.cxx).
 *
 * Not read: E1392's other sections and codes, transmission, polarization, readings without phi_s.
 */

#include "HalfVector.h"
#include "MaterialFormat.h"
#include "SRGB.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr const char* AstmFormatName = "ASTM E1392 text";
constexpr std::size_t MostColumns = 4096 + 4;
constexpr std::size_t LongestHeader = 65536; // bytes
constexpr std::string_view Blanks = " \t\r";
constexpr double RightAngle = 90.0;
constexpr double AngleRounding = 1e-3; // degrees
constexpr double MostTurns = 2.0;      // of azimuths
constexpr std::size_t NoColumn = static_cast<std::size_t>(-1);
const char* const AngleNames[4] = { "theta_i", "phi_i", "theta_s", "phi_s" };

std::string_view TrimBlanks(std::string_view text)
{
  const std::size_t first = std::min(text.find_first_not_of(Blanks), text.size());
  return text.substr(first, text.find_last_not_of(Blanks) + 1 - first);
}

// Up to the separator, which is stepped over with it.
std::string_view TakeUntil(std::string_view& text, char separator)
{
  const std::size_t length = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return TrimBlanks(part);
}

// Whether a line is "KEY value" or the key alone.
bool HasKey(std::string_view line, std::string_view key, std::string_view& value)
{
  const bool has = line.substr(0, key.size()) == key &&
                   (line.size() == key.size() || Blanks.find(line[key.size()]) < Blanks.size());
  value = has ? TrimBlanks(line.substr(key.size())) : std::string_view();
  return has;
}

// Whether a line of the text's beginning is VARS.
bool HasAstmColumns(std::string_view text)
{
  std::string_view rest = SkipByteOrderMark(text.substr(0, LongestHeader));
  std::string_view value;
  bool has = false;
  while (!has && !rest.empty())
  {
    has = HasKey(TakeUntil(rest, '\n'), "VARS", value) &&
          value.find("theta_") != std::string_view::npos;
  }
  return has;
}

// 550 of "550nm"; 0: it is no such name.
double ToWavelength(std::string_view name)
{
  double wavelength = 0.0;
  const bool hasUnit = name.size() > 2 && name.substr(name.size() - 2) == "nm";
  return hasUnit && ParseNumber(name.substr(0, name.size() - 2), wavelength)
           ? std::max(wavelength, 0.0)
           : 0.0;
}

//------------------------------------------------------------------------------
class AstmFile
{
public:
  /// Reads the lines up to VARS. Throws FileError, as Read does.
  explicit AstmFile(const FileBytes& file)
    : File(file)
    , Rest(SkipByteOrderMark(file.GetView()))
  {
    this->ReadHeader();
    this->FindColumns();
  }

  /// Of the values, nm, ascending; empty: they have none.
  const std::vector<double>& GetWavelengths() const { return this->Wavelengths; }

  MaterialFile Read(const std::string& material)
  {
    this->ReadRows();
    const SpectralChannels channels = this->FindChannels(material);
    MaterialFile result;
    for (const std::string& line : this->Header)
    {
      result.AddNote("File header: " + line);
    }
    if (!channels.Note.empty())
    {
      result.AddNote(channels.Note);
    }
    std::vector<GonioReading> readings = this->GetReadings(channels, result);
    NoteCount(result.NumberOfNegativeValues,
      " values are negative: kept, clamped at 0 after interpolation.", result);
    MakeGonioTable(
      std::move(readings), this->File.GetPath() + ": " + AstmFormatName + ", rows", result);
    NameAfterFile(result, this->File, AstmFormatName);
    if (!material.empty())
    {
      result.BRDF->SetName(result.BRDF->GetName() + " " + material);
    }
    return result;
  }

private:
  // line: 0 where the field alone says the place.
  template <typename... Pieces>
  void Require(
    bool condition, std::size_t line, const std::string& field, const Pieces&... what) const
  {
    if (!condition)
    {
      FailIn(this->File, AstmFormatName, line > 0 ? Concat("line ", line, field) : field, what...);
    }
  }

  std::string_view TakeLine()
  {
    ++this->Line;
    return TakeUntil(this->Rest, '\n');
  }

  void ReadHeader()
  {
    const std::size_t whole = this->Rest.size();
    while (!this->Rest.empty() && whole - this->Rest.size() < LongestHeader)
    {
      const std::string_view line = this->TakeLine();
      std::string_view value;
      if (HasKey(line, "VARS", value))
      {
        this->Require(!value.empty(), this->Line, ", VARS", "names no column");
        while (!value.empty())
        {
          this->Columns.emplace_back(TakeUntil(value, ','));
          this->Require(!this->Columns.back().empty() && this->Columns.size() <= MostColumns,
            this->Line, ", VARS", "expected 1 to ", MostColumns, " names with commas between");
        }
        return;
      }
      if (HasKey(line, "NUM_POINTS", value))
      {
        this->Require(ParseNumber(value, this->Points) && this->Points >= 1.0 &&
                        this->Points == std::floor(this->Points),
          this->Line, ", NUM_POINTS", "found ", Quote(value), ", expected a whole number from 1");
      }
      else if (!line.empty())
      {
        this->Header.emplace_back(line);
      }
    }
    this->Require(false, this->Line, ", VARS", "no such line in the first ", LongestHeader,
      " bytes, expected the names of the columns");
  }

  void FindColumns()
  {
    const auto require = [this](bool condition, const auto&... what)
    { this->Require(condition, 0, "VARS", what...); };
    std::map<std::string, std::size_t> places;
    for (const std::string& name : this->Columns)
    {
      require(places.emplace(name, places.size()).second, "names ", Quote(name), " twice");
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      const auto found = places.find(AngleNames[k]);
      require(found != places.end() || k == 1, "names no ", AngleNames[k],
        ", expected theta_i, phi_i, theta_s, phi_s and values");
      this->Angles[k] = found == places.end() ? NoColumn : found->second;
    }
    std::map<double, std::size_t> byWavelength;
    for (std::size_t k = 0; k < this->Columns.size(); ++k)
    {
      if (std::find(this->Angles.begin(), this->Angles.end(), k) == this->Angles.end())
      {
        this->Values.push_back(k);
        const double wavelength = ToWavelength(this->Columns[k]);
        require(wavelength == 0.0 || byWavelength.emplace(wavelength, k).second, "names ",
          GetWavelengthName(wavelength), " twice");
      }
    }
    require(!this->Values.empty(), "names no column of values");
    if (byWavelength.size() == this->Values.size())
    {
      this->Values.clear();
      for (const auto& [wavelength, column] : byWavelength)
      {
        this->Wavelengths.push_back(wavelength);
        this->Values.push_back(column);
      }
    }
  }

  void ReadRows()
  {
    while (!this->Rest.empty())
    {
      std::string_view line = this->TakeLine();
      // What editors and transfers add at the end.
      if (line.find_first_not_of(std::string_view("\0\x1a", 2)) == std::string_view::npos)
      {
        continue;
      }
      std::size_t count = 0;
      while (!line.empty())
      {
        const std::string_view word = TakeUntil(line, ',');
        double number = 0.0;
        ++count;
        if (!ParseNumber(word, number))
        {
          this->Require(false, this->Line, Concat(", number ", count), "found ", Quote(word),
            ", expected a finite number");
        }
        this->Numbers.push_back(number);
      }
      this->Lines.push_back(this->Line);
      this->Require(count == this->Columns.size(), this->Line, ", row", "found ", count,
        " numbers, expected the ", this->Columns.size(), " that VARS names");
    }
    const std::size_t rows = this->Lines.size();
    const bool isWrong =
      rows == 0 || (this->Points > 0.0 && this->Points != static_cast<double>(rows));
    this->Require(!isWrong, this->Line, ", end", "found ", rows, " rows, expected ",
      this->Points > 0.0 ? NumberText(this->Points, 15) + " (NUM_POINTS)" : "at least 1");
  }

  double GetNumber(std::size_t row, std::size_t column) const
  {
    return column == NoColumn ? 0.0 : this->Numbers[row * this->Columns.size() + column];
  }

  // What the values are: the chosen ones, and their weights.
  SpectralChannels FindChannels(const std::string& material) const
  {
    const std::string where = this->File.GetPath() + ": " + AstmFormatName;
    if (!this->Wavelengths.empty())
    {
      return ChooseChannels(this->Wavelengths, material, where);
    }
    measuredbrdf::Require(material.empty(), where, ", name: found ", Quote("#" + material),
      ", but the columns are no wavelengths");
    SpectralChannels channels;
    std::string together;
    for (const std::size_t k : this->Values)
    {
      channels.Chosen.push_back(channels.Chosen.size());
      together += (together.empty() ? "" : ",") + this->Columns[k];
    }
    if (this->Values.size() == 1)
    {
      channels.Weights = { glm::dvec3(1.0) };
      channels.Note = "Gray, of the column " + Quote(together) + ".";
      return channels;
    }
    const bool isXyz = together == "X,Y,Z";
    measuredbrdf::Require(isXyz || together == "R,G,B", where, ", VARS: found the values ",
      Quote(together), ", expected R,G,B or X,Y,Z or wavelengths such as 550nm, or one column");
    // The matrix is a list of rows, glm's of columns.
    const glm::dmat3 toRgb =
      isXyz ? glm::transpose(glm::make_mat3(&XYZToRGB[0][0])) : glm::dmat3(1.0);
    channels.Weights = { toRgb[0], toRgb[1], toRgb[2] };
    channels.Note = isXyz ? "X, Y, Z were taken to be under D65." : "";
    return channels;
  }

  // A row's angles in degrees, polar ones that are not negative.
  std::array<double, 4> GetAngles(std::size_t row, bool degrees) const
  {
    std::array<double, 4> angles;
    for (std::size_t k = 0; k < 4; ++k)
    {
      const double angle = this->GetNumber(row, this->Angles[k]);
      angles[k] = degrees ? angle : ToDegrees(angle);
      const double most = k % 2 == 0 ? RightAngle : MostTurns * 360.0;
      this->Require(std::abs(angles[k]) <= most + AngleRounding, this->Lines[row], "",
        AngleNames[k], " is ", angles[k], " degrees, expected ", -most, " to ", most);
    }
    for (const std::size_t k : { 0, 2 })
    {
      angles[k + 1] += angles[k] < 0.0 ? 180.0 : 0.0;
      angles[k] = std::min(std::abs(angles[k]), RightAngle);
    }
    return angles;
  }

  std::vector<GonioReading> GetReadings(
    const SpectralChannels& channels, MaterialFile& result) const
  {
    bool degrees = false; // polar angles of radians are at most pi/2
    for (std::size_t row = 0; row < this->Lines.size(); ++row)
    {
      degrees |=
        std::max(std::abs(this->GetNumber(row, this->Angles[0])),
          std::abs(this->GetNumber(row, this->Angles[2]))) > ToRadians(RightAngle + AngleRounding);
    }
    result.AddNote(std::string("Angles were taken as ") + (degrees ? "degrees." : "radians."));
    std::vector<GonioReading> readings;
    for (std::size_t row = 0; row < this->Lines.size(); ++row)
    {
      const glm::vec4 angles(glm::make_vec4(this->GetAngles(row, degrees).data()));
      glm::dvec3 color(0.0);
      for (std::size_t k = 0; k < channels.Chosen.size(); ++k)
      {
        const double value = this->GetNumber(row, this->Values[channels.Chosen[k]]);
        this->Require(std::isfinite(static_cast<float>(value)), this->Lines[row], "", "found ",
          value, ", expected a number that 32 bits can hold");
        result.NumberOfNegativeValues += value < 0.0;
        color += channels.Weights[k] * value;
      }
      readings.push_back({ angles[0], angles[1], angles[2], angles[3], color });
    }
    return readings;
  }

  const FileBytes& File;
  std::string_view Rest; // what was not read yet
  std::size_t Line = 0;
  double Points = 0.0;               // 0: not said
  std::vector<std::string> Header;   // lines before VARS
  std::vector<std::string> Columns;  // that VARS names
  std::array<std::size_t, 4> Angles; // columns, as AngleNames
  std::vector<std::size_t> Values;   // columns
  std::vector<double> Wavelengths;   // of the values
  std::vector<double> Numbers;       // row by row
  std::vector<std::size_t> Lines;    // of the rows in the file, from 1
};
}

const MaterialFormat AstmFormat = { AstmFormatName, "ASTM E1392 .astm (as Cornell's)", ".astm",
  [](const vtkBRDFFormat::File& file)
  { return HasExtension(file.Path, ".astm") || HasAstmColumns(file.Bytes); },
  [](const FileBytes& file, const std::string& material) { return AstmFile(file).Read(material); },
  [](const FileBytes& file) { return GetWavelengthNames(AstmFile(file).GetWavelengths()); } };
} // namespace measuredbrdf
