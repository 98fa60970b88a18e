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
 * SpectralColor.h; FILE#550nm picks one), or in one column of any name (gray). A negative polar
 * angle is on the other side of the normal. Where phi_i is the same in all rows the material is
 * isotropic (GonioTable.h).
 *
 * Not read: E1392's other sections and codes, transmission, polarization, readings without phi_s.
 */

#include "GonioTable.h"
#include "MaterialFormat.h"
#include "NumberText.h"
#include "SRGB.h"
#include "SpectralColor.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr const char* AstmFormatName = "ASTM E1392 text";

struct AstmTexts
{
  std::vector<std::string> Header;  // lines before VARS
  std::vector<std::string> Columns; // that VARS names
  std::vector<double> Numbers;      // row by row
  std::vector<std::size_t> Lines;   // of the rows in the file, from 1

  std::size_t GetNumberOfRows() const { return this->Lines.size(); }
};

constexpr std::size_t MostColumns = 4096 + 4;
constexpr std::size_t LongestHeader = 65536; // bytes
constexpr std::string_view Blanks = " \t\r";

std::string_view Trim(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(Blanks);
  return first == std::string_view::npos
           ? std::string_view()
           : text.substr(first, text.find_last_not_of(Blanks) - first + 1);
}

// The value of a line "KEY value", or null where it has another key.
bool HasKey(std::string_view line, std::string_view key, std::string_view& value)
{
  if (line.substr(0, key.size()) != key ||
      (line.size() > key.size() && Blanks.find(line[key.size()]) == std::string_view::npos))
  {
    return false;
  }
  value = Trim(line.substr(key.size()));
  return true;
}

// Up to the separator, which is stepped over with it.
std::string_view Take(std::string_view& text, char separator)
{
  const std::size_t length = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return part;
}

void SkipMark(std::string_view& text) // of byte order
{
  if (text.substr(0, 3) == "\xef\xbb\xbf")
  {
    text.remove_prefix(3);
  }
}

/// Throws FileError where VARS or NUM_POINTS is wrong or missing, or a row has another number of
/// numbers.
class AstmParser
{
public:
  explicit AstmParser(const FileBytes& file)
    : Path(file.GetPath())
    , Rest(file.GetView())
  {
    SkipMark(this->Rest);
  }

  /// onlyHeader: leave out the rows.
  AstmTexts Parse(bool onlyHeader = false)
  {
    this->ReadHeader();
    if (!onlyHeader)
    {
      this->ReadRows();
    }
    return std::move(this->Texts);
  }

private:
  [[noreturn]] void Fail(const std::string& field, const std::string& what) const
  {
    throw FileError(this->Path + ": " + AstmFormatName + ", line " + std::to_string(this->Line) +
                    ", " + field + ": " + what);
  }

  std::string_view TakeLine()
  {
    ++this->Line;
    return Trim(Take(this->Rest, '\n'));
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
        this->ReadColumns(value);
        return;
      }
      if (HasKey(line, "NUM_POINTS", value))
      {
        double points = 0.0;
        if (!ParseNumber(value, points) || points < 1.0 || points != std::floor(points))
        {
          this->Fail("NUM_POINTS", "found " + Quote(value) + ", expected a whole number from 1");
        }
        this->Points = points;
      }
      else if (!line.empty())
      {
        this->Texts.Header.emplace_back(line);
      }
    }
    this->Fail("VARS", "no such line in the first " + std::to_string(LongestHeader) +
                         " bytes, expected the names of the columns");
  }

  void ReadColumns(std::string_view names)
  {
    while (!names.empty())
    {
      const std::string_view name = Trim(Take(names, ','));
      if (name.empty() || this->Texts.Columns.size() == MostColumns)
      {
        this->Fail(
          "VARS", "expected 1 to " + std::to_string(MostColumns) + " names with commas between");
      }
      this->Texts.Columns.emplace_back(name);
    }
    if (this->Texts.Columns.empty())
    {
      this->Fail("VARS", "names no column");
    }
  }

  void ReadRows()
  {
    const std::size_t columns = this->Texts.Columns.size();
    while (!this->Rest.empty())
    {
      std::string_view line = this->TakeLine();
      // What editors and transfers add at the end.
      if (line.find_first_not_of(std::string_view("\0\x1a", 2)) == std::string_view::npos)
      {
        continue;
      }
      std::size_t count = 0;
      for (; !line.empty(); ++count)
      {
        const std::string_view word = Trim(Take(line, ','));
        double number = 0.0;
        if (!ParseNumber(word, number))
        {
          this->Fail("number " + std::to_string(count + 1),
            "found " + Quote(word) + ", expected a finite number");
        }
        if (count < columns)
        {
          this->Texts.Numbers.push_back(number);
        }
      }
      this->Texts.Lines.push_back(this->Line);
      if (count != columns)
      {
        this->Fail("row", "found " + std::to_string(count) + " numbers, expected the " +
                            std::to_string(columns) + " that VARS names");
      }
    }
    const std::size_t rows = this->Texts.GetNumberOfRows();
    if (rows == 0 || (this->Points > 0.0 && this->Points != static_cast<double>(rows)))
    {
      const std::string points = this->Points > 0.0 ? NumberText(this->Points, 15) : "at least 1";
      this->Fail("end", "found " + std::to_string(rows) + " rows, expected " + points +
                          (this->Points > 0.0 ? " (NUM_POINTS)" : ""));
    }
  }

  std::string Path;
  std::string_view Rest;
  std::size_t Line = 0;
  double Points = 0.0; // 0: not said
  AstmTexts Texts;
};

//------------------------------------------------------------------------------
// Whether a line of the text's beginning is VARS.
bool HasAstmColumns(std::string_view text)
{
  std::string_view rest = text.substr(0, LongestHeader);
  SkipMark(rest);
  while (!rest.empty())
  {
    std::string_view value;
    if (HasKey(Trim(Take(rest, '\n')), "VARS", value) &&
        value.find("theta_") != std::string_view::npos)
    {
      return true;
    }
  }
  return false;
}

constexpr double Degree = 3.14159265358979323846 / 180.0;
constexpr double RightAngle = 90.0;
constexpr double Rounding = 1e-3; // of angles, degrees
constexpr double MostTurns = 2.0; // of azimuths
constexpr std::size_t None = static_cast<std::size_t>(-1);

const char* const AngleNames[4] = { "theta_i", "phi_i", "theta_s", "phi_s" };

[[noreturn]] void Fail(const FileBytes& file, const std::string& field, const std::string& what)
{
  throw FileError(file.GetPath() + ": " + AstmFormatName + ", " + field + ": " + what);
}

// Where things stand in a row.
struct Columns
{
  std::array<std::size_t, 4> Angles = { None, None, None, None }; // as AngleNames
  std::vector<std::size_t> Values;
};

Columns FindColumns(const FileBytes& file, const std::vector<std::string>& names)
{
  Columns columns;
  for (std::size_t k = 0; k < names.size(); ++k)
  {
    const auto* const found = std::find(AngleNames, AngleNames + 4, names[k]);
    if (found == AngleNames + 4)
    {
      columns.Values.push_back(k);
      continue;
    }
    std::size_t& place = columns.Angles[static_cast<std::size_t>(found - AngleNames)];
    if (place != None)
    {
      Fail(file, "VARS", "names " + Quote(names[k]) + " twice");
    }
    place = k;
  }
  for (const std::size_t k : { 0, 2, 3 })
  {
    if (columns.Angles[k] == None)
    {
      Fail(file, "VARS",
        std::string("names no ") + AngleNames[k] +
          ", expected theta_i, phi_i, theta_s, phi_s and values");
    }
  }
  if (columns.Values.empty())
  {
    Fail(file, "VARS", "names no column of values");
  }
  return columns;
}

// 550 of "550nm"; 0: it is no such name.
double ToWavelength(const std::string& name)
{
  double wavelength = 0.0;
  const char* const end = name.data() + name.size();
  const auto read = std::from_chars(name.data(), end, wavelength);
  const bool good =
    read.ec == std::errc() && std::string(read.ptr, end) == "nm" && std::isfinite(wavelength);
  return good && wavelength > 0.0 ? wavelength : 0.0;
}

// The columns' wavelengths, ascending with the columns; empty: they have none.
std::vector<double> FindWavelengths(
  const FileBytes& file, const std::vector<std::string>& names, Columns& columns)
{
  std::vector<std::pair<double, std::size_t>> found;
  for (const std::size_t k : columns.Values)
  {
    const double wavelength = ToWavelength(names[k]);
    if (wavelength > 0.0)
    {
      found.emplace_back(wavelength, k);
    }
  }
  if (found.size() != columns.Values.size())
  {
    return {};
  }
  std::sort(found.begin(), found.end());
  std::vector<double> wavelengths;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    if (k > 0 && found[k].first == found[k - 1].first)
    {
      Fail(file, "VARS", "names " + GetWavelengthName(found[k].first) + " twice");
    }
    columns.Values[k] = found[k].second;
    wavelengths.push_back(found[k].first);
  }
  return wavelengths;
}

// What the values are: weights of the columns, of which some are left out.
SpectralChannels FindChannels(const FileBytes& file, const std::vector<std::string>& names,
  Columns& columns, const std::string& material)
{
  SpectralChannels channels;
  const std::vector<double> wavelengths = FindWavelengths(file, names, columns);
  if (!wavelengths.empty())
  {
    const std::string problem = channels.Choose(wavelengths, material);
    if (!problem.empty())
    {
      Fail(file, "name", problem);
    }
    std::vector<std::size_t> chosen;
    for (const std::size_t k : channels.Chosen)
    {
      chosen.push_back(columns.Values[k]);
    }
    columns.Values = chosen;
    return channels;
  }
  if (!material.empty())
  {
    Fail(file, "name", "found " + Quote("#" + material) + ", but the columns are no wavelengths");
  }
  std::string together;
  for (const std::size_t k : columns.Values)
  {
    together += (together.empty() ? "" : ",") + names[k];
  }
  if (columns.Values.size() == 1)
  {
    channels.Weights = { { 1.0, 1.0, 1.0 } };
    channels.Note = "Gray, of the column " + Quote(together) + ".";
  }
  else if (together == "R,G,B")
  {
    channels.Weights = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  }
  else if (together == "X,Y,Z")
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      channels.Weights.push_back({ XYZToRGB[0][j], XYZToRGB[1][j], XYZToRGB[2][j] });
    }
    channels.Note = "X, Y, Z were taken to be under D65.";
  }
  else
  {
    Fail(file, "VARS",
      "found the values " + Quote(together) +
        ", expected R,G,B or X,Y,Z or wavelengths such as 550nm, or one column");
  }
  return channels;
}

//------------------------------------------------------------------------------
// Polar angles of radians are at most pi/2.
bool AreDegrees(const AstmTexts& texts, const Columns& columns)
{
  for (std::size_t row = 0; row < texts.GetNumberOfRows(); ++row)
  {
    const double* numbers = &texts.Numbers[row * texts.Columns.size()];
    if (std::max(std::abs(numbers[columns.Angles[0]]), std::abs(numbers[columns.Angles[2]])) >
        (RightAngle + Rounding) * Degree)
    {
      return true;
    }
  }
  return false;
}

// Polar angles that are not negative.
GonioAngles ToAngles(const FileBytes& file, std::size_t line, std::array<double, 4> angles)
{
  for (std::size_t k = 0; k < 4; ++k)
  {
    const double most = k % 2 == 0 ? RightAngle : MostTurns * 360.0;
    if (!(std::abs(angles[k]) <= most + Rounding))
    {
      Fail(file, "line " + std::to_string(line),
        std::string(AngleNames[k]) + " is " + NumberText(angles[k]) + " degrees, expected " +
          NumberText(-most) + " to " + NumberText(most));
    }
  }
  for (const std::size_t k : { 0, 2 })
  {
    if (angles[k] < 0.0)
    {
      angles[k] = -angles[k];
      angles[k + 1] += 180.0;
    }
    angles[k] = std::min(angles[k], RightAngle);
  }
  return { static_cast<float>(angles[0]), static_cast<float>(angles[1]),
    static_cast<float>(angles[2]), static_cast<float>(angles[3]) };
}

GonioReadings Arrange(
  const FileBytes& file, const AstmTexts& texts, const Columns& columns, MaterialFile& result)
{
  const bool degrees = AreDegrees(texts, columns);
  result.AddNote(std::string("Angles were taken as ") + (degrees ? "degrees." : "radians."));
  GonioReadings readings;
  readings.Channels = columns.Values.size();
  for (std::size_t row = 0; row < texts.GetNumberOfRows(); ++row)
  {
    const std::size_t line = texts.Lines[row];
    const double* numbers = &texts.Numbers[row * texts.Columns.size()];
    std::array<double, 4> angles = {};
    for (std::size_t k = 0; k < 4; ++k)
    {
      const double angle = columns.Angles[k] == None ? 0.0 : numbers[columns.Angles[k]];
      angles[k] = degrees ? angle : angle / Degree;
    }
    readings.Angles.push_back(ToAngles(file, line, angles));
    for (const std::size_t k : columns.Values)
    {
      const auto value = static_cast<float>(numbers[k]);
      if (!std::isfinite(value))
      {
        Fail(file, "line " + std::to_string(line),
          "found " + NumberText(numbers[k]) + ", expected a number that 32 bits can hold");
      }
      result.NumberOfNegativeValues += value < 0.0f;
      readings.Values.push_back(value);
    }
  }
  return readings;
}
//------------------------------------------------------------------------------
MaterialFile ReadAstm(const FileBytes& file, const std::string& material)
{
  const AstmTexts texts = AstmParser(file).Parse();
  MaterialFile result;
  Columns columns = FindColumns(file, texts.Columns);
  const SpectralChannels channels = FindChannels(file, texts.Columns, columns, material);
  for (const std::string& line : texts.Header)
  {
    result.AddNote("File header: " + line);
  }
  if (!channels.Note.empty())
  {
    result.AddNote(channels.Note);
  }
  GonioReadings readings = Arrange(file, texts, columns, result);
  readings.Weights = channels.Weights;
  if (result.NumberOfNegativeValues > 0)
  {
    result.AddNote(std::to_string(result.NumberOfNegativeValues) +
                   " values are negative: kept, clamped at 0 after interpolation.");
  }
  const std::string problem = MakeGonioTable(std::move(readings), result);
  if (!problem.empty())
  {
    Fail(file, "rows", problem);
  }
  result.BRDF->SetName(GetFileStem(file.GetPath()) + (material.empty() ? "" : " " + material));
  result.BRDF->SetSource("ASTM E1392 text file " + GetFileTitle(file.GetPath()));
  return result;
}

//------------------------------------------------------------------------------
std::vector<std::string> ListAstmWavelengths(const FileBytes& file)
{
  const AstmTexts texts = AstmParser(file).Parse(true);
  Columns columns = FindColumns(file, texts.Columns);
  std::vector<std::string> names;
  for (const double wavelength : FindWavelengths(file, texts.Columns, columns))
  {
    names.push_back(GetWavelengthName(wavelength));
  }
  return names;
}
}

const MaterialFormat AstmFormat = { AstmFormatName, "ASTM E1392 .astm (as Cornell's)", ".astm",
  [](const vtkBRDFFormat::File& file)
  { return HasExtension(file.Path, ".astm") || HasAstmColumns(file.Bytes); },
  ReadAstm, ListAstmWavelengths };
} // namespace measuredbrdf
