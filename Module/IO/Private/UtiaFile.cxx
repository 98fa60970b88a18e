// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The UTIA database's .bin (Filip and Vavra 2014): anisotropic materials, no header. 3 planes (red
 * first) of 288 x 288 doubles, little-endian. A row for each direction of the light, a column for
 * each of the view: polar angles 0, 15, ..., 75 degrees, in each of them azimuths 0, 7.5, ...,
 * 352.5 degrees.
 *
 * FILE.bin#display takes the values for display colors (sRGB) of f / 100 in units of 140, as
 * Dupuy's dj_brdf (2015) takes the database's files; else they are in 1/sr, as they are. Colors are
 * decoded at the nodes, and interpolation is linear in f; dj_brdf interpolates first, and changes
 * from sRGB's line to its curve at 0.0375 instead of 0.04045.
 */

#include "MaterialFormat.h"
#include "SRGB.h"
#include "vtkAngularTableBRDF.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr const char* UtiaFormatName = "UTIA binary";
const char* const Display = "display";
constexpr int Azimuths = 48;
constexpr std::size_t Plane = UtiaBytes / (3 * sizeof(double));

//------------------------------------------------------------------------------
MaterialFile ReadUtia(const FileBytes& file, const std::string& material)
{
  ByteReader reader(file, UtiaFormatName);
  const bool isDisplay = material == Display;
  Require(material.empty() || isDisplay, file.GetPath(), ": ", UtiaFormatName, ", name: found ",
    Quote("#" + material), ", expected '#display' or none");
  const char* bytes = reader.TakeRest(UtiaBytes, "3 planes of 288 x 288 numbers");
  MaterialFile result;
  std::vector<float> rgb(3 * Plane);
  for (std::size_t k = 0; k < rgb.size(); ++k)
  {
    double value;
    ByteReader::Copy(&value, bytes + k * sizeof(double), 1);
    const auto f =
      static_cast<float>(isDisplay ? 100.0 * DecodeSRGB(std::max(value, 0.0) / 140.0) : value);
    if (!std::isfinite(value) || !std::isfinite(f))
    {
      reader.FailAt(k * sizeof(double), "values", "found ", NumberText(value, 3),
        ", expected a finite number that 32 bits can hold");
    }
    result.NumberOfNegativeValues += value < 0.0;
    rgb[3 * (k % Plane) + k / Plane] = f;
  }
  const vtkAngularTableBRDF::Nodes nodes = { { 0.0f, 15.0f, 30.0f, 45.0f, 60.0f, 75.0f },
    vtkAngularTableBRDF::GetEvenAzimuths(Azimuths) };
  vtkNew<vtkAngularTableBRDF> table;
  const std::string problem = table->SetValues(nodes, nodes, std::move(rgb));
  reader.Require(problem.empty(), "values", problem);
  result.BRDF = table;
  NameAfterFile(
    result, file, UtiaFormatName, isDisplay ? ", its values taken as display colors" : "");
  result.AddNote(isDisplay ? "Values were taken as display colors: f = 100 sRGB^-1(v / 140)."
                           : "Values were taken as they are, in 1/sr.");
  NoteCount(result.NumberOfNegativeValues,
    Concat(" of ", 3 * Plane, " values are negative: ",
      isDisplay ? "taken as 0." : "kept, clamped at 0 after interpolation."),
    result);
  NotePadding(reader, result);
  NoteStrangeAlbedo(
    table, 0.0, "its values are scaled in some way, or display colors (FILE.bin#display).", result);
  return result;
}

//------------------------------------------------------------------------------
// There is no magic. What MERL's files with this extension begin with are three small integers.
bool CanReadUtia(const vtkBRDFFormat::File& file)
{
  return HasExtension(file.Path, ".bin") &&
         (file.Bytes.size() == UtiaBytes || !MerlFormat.CanRead(file));
}
}

const MaterialFormat UtiaFormat = { UtiaFormatName,
  "UTIA .bin (FILE.bin#display for display colors)", ".bin", CanReadUtia, ReadUtia,
  [](const FileBytes&) { return std::vector<std::string>{ Display }; } };
} // namespace measuredbrdf
