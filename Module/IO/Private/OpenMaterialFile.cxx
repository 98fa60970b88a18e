// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OpenMaterialFile.h"

#include "GonioTable.h"
#include "NumberText.h"
#include "SpectralChannels.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

namespace measuredbrdf
{
namespace
{
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

[[noreturn]] void Fail(const FileBytes& file, const std::string& field, const std::string& what)
{
  throw FileError(file.GetPath() + ": " + OpenMaterialFormatName + ", " + field + ": " + what);
}

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
vtkStandardNewMacro(OpenMaterialFormat);

//------------------------------------------------------------------------------
// The extension, or JSON with the names that the format's files begin with.
bool OpenMaterialFormat::CanRead(const File& file)
{
  std::string extension = file.Path.size() < 6 ? "" : file.Path.substr(file.Path.size() - 6);
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string_view start = file.Bytes.substr(0, 4096);
  const std::size_t first = start.find_first_not_of(std::string_view("\xef\xbb\xbf \t\r\n", 7));
  return extension == ".xompt" ||
         (first != std::string_view::npos && start[first] == '{' &&
           (start.find("OpenMATERIAL-3D") != std::string_view::npos ||
             start.find("openMaterial3dVersion") != std::string_view::npos));
}

//------------------------------------------------------------------------------
std::vector<std::string> OpenMaterialFormat::GetMaterialNames(const File& file)
{
  std::vector<std::string> names;
  try
  {
    const FileBytes bytes = FileBytes::View(file.Path, file.Bytes);
    for (const double wavelength :
      ToNanometers(FindWavelengths(bytes, ParseOpenMaterial(bytes).Rows)))
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
MaterialFile OpenMaterialFormat::DoRead(const FileBytes& file, const std::string& material)
{
  return ReadOpenMaterial(file, material);
}
} // namespace measuredbrdf
