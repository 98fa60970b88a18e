// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AstmFile.h"

#include "AstmParser.h"
#include "GonioTable.h"
#include "NumberText.h"
#include "SpectralChannels.h"
#include "XYZColor.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

namespace measuredbrdf
{
namespace
{
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
}

//------------------------------------------------------------------------------
MaterialFile ReadAstm(const FileBytes& file, const std::string& material)
{
  const AstmTexts texts = ParseAstm(file, AstmFormatName);
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
  GonioTable table;
  const std::string problem = table.Make(std::move(readings));
  if (!problem.empty())
  {
    Fail(file, "rows", problem);
  }
  for (const std::string& note : table.Notes)
  {
    result.AddNote(note);
  }
  table.BRDF->SetName(GetFileStem(file.GetPath()) + (material.empty() ? "" : " " + material));
  table.BRDF->SetSource("ASTM E1392 text file " + GetFileTitle(file.GetPath()));
  result.BRDF = table.BRDF;
  return result;
}

//------------------------------------------------------------------------------
vtkStandardNewMacro(AstmFormat);

//------------------------------------------------------------------------------
bool AstmFormat::CanRead(const File& file)
{
  std::string end = file.Path.size() < 5 ? "" : file.Path.substr(file.Path.size() - 5);
  std::transform(end.begin(), end.end(), end.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return end == ".astm" || HasAstmColumns(file.Bytes);
}

//------------------------------------------------------------------------------
std::vector<std::string> AstmFormat::GetMaterialNames(const File& file)
{
  std::vector<std::string> names;
  try
  {
    const FileBytes bytes = FileBytes::View(file.Path, file.Bytes);
    const AstmTexts texts = ParseAstm(bytes, AstmFormatName, true);
    Columns columns = FindColumns(bytes, texts.Columns);
    for (const double wavelength : FindWavelengths(bytes, texts.Columns, columns))
    {
      names.push_back(GetWavelengthName(wavelength));
    }
  }
  catch (const std::exception&)
  {
    names.clear(); // Read says what is wrong
  }
  return names;
}

//------------------------------------------------------------------------------
MaterialFile AstmFormat::DoRead(const FileBytes& file, const std::string& material)
{
  return ReadAstm(file, material);
}
} // namespace measuredbrdf
