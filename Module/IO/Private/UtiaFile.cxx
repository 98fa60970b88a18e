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
 * Dupuy's dj_brdf takes the database's files; else they are in 1/sr, as they are. Colors are
 * decoded at the nodes, and interpolation is linear in f; dj_brdf interpolates first, and changes
 * from sRGB's line to its curve at 0.0375 instead of 0.04045.
 */

#include "MaterialFormat.h"
#include "NumberText.h"
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
constexpr const char* Name = "UTIA binary";
const char* const Display = "display";
constexpr int PolarAngles = 6;
constexpr float PolarStep = 15.0f; // degrees
constexpr int Azimuths = 48;
constexpr std::size_t Side = PolarAngles * Azimuths;
constexpr std::size_t Plane = Side * Side;

// dj_brdf (Dupuy 2015), which has them from the database's authors.
constexpr double DisplayUnit = 140.0;
constexpr double DisplayScale = 100.0;

// f = 100 sRGB^-1(v / 140).
double DecodeDisplay(double value)
{
  return DisplayScale * DecodeSRGB(std::max(value, 0.0) / DisplayUnit);
}

//------------------------------------------------------------------------------
MaterialFile ReadUtia(const FileBytes& file, const std::string& material)
{
  ByteReader reader(file, Name);
  if (!material.empty() && material != Display)
  {
    throw FileError(file.GetPath() + ": " + Name + ", name: found " + Quote("#" + material) +
                    ", expected '#display' or none");
  }
  const char* bytes = reader.TakeRest(UtiaBytes, "3 planes of 288 x 288 numbers");
  MaterialFile result;
  std::vector<float> rgb(3 * Plane);
  for (std::size_t c = 0; c < 3; ++c)
  {
    for (std::size_t k = 0; k < Plane; ++k)
    {
      const std::size_t place = (c * Plane + k) * sizeof(double);
      double value;
      ByteReader::Copy(&value, bytes + place, 1);
      const auto stored = static_cast<float>(material == Display ? DecodeDisplay(value) : value);
      if (!std::isfinite(value) || !std::isfinite(stored))
      {
        reader.FailAt(place, "values",
          std::string("found ") + NumberText(value, 3) +
            ", expected a finite number that 32 bits can hold");
      }
      result.NumberOfNegativeValues += value < 0.0;
      rgb[3 * k + c] = stored;
    }
  }
  vtkAngularTableBRDF::Nodes nodes;
  for (int k = 0; k < PolarAngles; ++k)
  {
    nodes.Theta.push_back(PolarStep * static_cast<float>(k));
  }
  nodes.Phi = vtkAngularTableBRDF::GetEvenAzimuths(Azimuths);
  vtkNew<vtkAngularTableBRDF> table;
  const std::string problem = table->SetValues(nodes, nodes, std::move(rgb));
  if (!problem.empty())
  {
    reader.FailAt(0, "values", problem);
  }
  table->SetName(GetFileStem(file.GetPath()));
  table->SetSource("UTIA binary file " + GetFileTitle(file.GetPath()) +
                   (material.empty() ? "" : ", its values taken as display colors"));
  result.AddNote(material == Display
                   ? "Values were taken as display colors: f = 100 sRGB^-1(v / 140)."
                   : "Values were taken as they are, in 1/sr.");
  if (result.NumberOfNegativeValues > 0)
  {
    result.AddNote(
      std::to_string(result.NumberOfNegativeValues) + " of " + std::to_string(3 * Plane) +
      " values are negative: " +
      (material == Display ? "taken as 0." : "kept, clamped at 0 after interpolation."));
  }
  NotePadding(reader, result);
  NoteStrangeAlbedo(
    table, 0.0, "its values are scaled in some way, or display colors (FILE.bin#display).", result);
  result.BRDF = table;
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

const MaterialFormat UtiaFormat = { Name, "UTIA .bin (FILE.bin#display for display colors)", ".bin",
  CanReadUtia, ReadUtia, [](const FileBytes&) { return std::vector<std::string>{ Display }; } };
} // namespace measuredbrdf
