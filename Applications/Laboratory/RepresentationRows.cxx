// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RepresentationRows.h"

#include "NumberText.h"

#include <cstdio>

namespace tool
{
namespace
{
//------------------------------------------------------------------------------
// A cell of text: quoted, quotes in it doubled (RFC 4180).
std::string Quote(const std::string& text)
{
  std::string cell = "\"";
  for (const char c : text)
  {
    cell += c == '"' ? "\"\"" : std::string(1, c);
  }
  return cell + "\"";
}
}

//------------------------------------------------------------------------------
std::string FormatCSV(
  const std::vector<RepresentationRow>& rows, const std::vector<std::string>& environments)
{
  std::string text = "material,representation,functions,relative_l2_zone,relative_l2_hemisphere,"
                     "negative_mass";
  for (const std::string& name : environments)
  {
    text += "," + Quote("image_" + name);
  }
  text += ",texture_bytes,seconds,recommended\n";
  for (const RepresentationRow& row : rows)
  {
    text += Quote(row.Material) + "," + Quote(row.Representation) + "," +
            std::to_string(row.Functions) + "," + measuredbrdf::FixedText(row.Zone, 4) + "," +
            measuredbrdf::FixedText(row.Hemisphere, 4) + "," +
            measuredbrdf::FixedText(row.NegativeMass, 5);
    for (const double image : row.Images)
    {
      text += "," + measuredbrdf::FixedText(image, 4);
    }
    text += "," + std::to_string(row.Bytes) + "," + measuredbrdf::FixedText(row.Seconds, 2) + "," +
            (row.Recommended ? "1" : "0") + "\n";
  }
  return text;
}

//------------------------------------------------------------------------------
std::string FormatText(
  const std::vector<RepresentationRow>& rows, const std::vector<std::string>& environments)
{
  std::string text =
    "                               relative L2       negative   image, relative L1\n"
    "representation              zone   hemisphere     mass  ";
  for (const std::string& name : environments)
  {
    char cell[32];
    std::snprintf(cell, sizeof(cell), " %12.12s", name.c_str());
    text += cell;
  }
  text += "     bytes  seconds\n";
  std::string material;
  for (const RepresentationRow& row : rows)
  {
    if (row.Material != material)
    {
      material = row.Material;
      text += material + "\n";
    }
    char figures[200];
    std::snprintf(figures, sizeof(figures), "%s %-24.24s %6.1f %%   %7.1f %%  %6.2f %%",
      row.Recommended ? ">" : " ", row.Representation.c_str(), 100.0 * row.Zone,
      100.0 * row.Hemisphere, 100.0 * row.NegativeMass);
    text += figures;
    for (const double image : row.Images)
    {
      std::snprintf(figures, sizeof(figures), "   %8.2f %%", 100.0 * image);
      text += figures;
    }
    std::snprintf(figures, sizeof(figures), " %9zu %8.2f\n", row.Bytes, row.Seconds);
    text += figures;
  }
  return text + "> marks what the advisor recommends\n";
}
} // namespace tool
