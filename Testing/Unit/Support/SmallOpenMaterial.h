// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * OpenMATERIAL 3D look-up tables, for tests and fuzz targets.
 */

#ifndef SmallOpenMaterial_h
#define SmallOpenMaterial_h

#include "NumberText.h"

#include <functional>
#include <string>
#include <vector>

namespace testio
{
inline std::string MakeOpenMaterialFile(const std::string& wavelengths, const std::string& rows)
{
  return "{\"$schema\": \"https://example.org/OpenMATERIAL-3D/material_brdf_schema.json\",\n"
         "\"metadata\": {\"name\": \"road\", \"license\": \"CC0-1.0\", \"authors\": [\"a\", "
         "\"b\"],\n"
         "\"openMaterial3dVersion\": \"1.0.0\", \"sources\": \"simulation\"},\n"
         "\"brdf\": {\"wavelengths\": [" +
         wavelengths + "],\n\"lookupTable\": [" + rows + "]}}\n";
}

/// A row: meters and radians, as the format has them.
inline std::string MakeOpenMaterialRow(
  double nanometers, double thetaI, double thetaO, double phi, double value)
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  std::string text = "[" + measuredbrdf::NumberText(nanometers * 1e-9, 10);
  for (const double number : { thetaI * degree, thetaO * degree, phi * degree, value })
  {
    text += ", " + measuredbrdf::NumberText(number, 9);
  }
  return text + "]";
}

/// Degrees and nanometers; value: (nanometers, thetaI, thetaO, phi).
inline std::string MakeOpenMaterial(const std::vector<double>& nanometers,
  const std::vector<double>& thetaI, const std::vector<double>& thetaO,
  const std::vector<double>& phi,
  const std::function<double(double, double, double, double)>& value)
{
  std::string wavelengths;
  std::string rows;
  for (const double l : nanometers)
  {
    wavelengths += (wavelengths.empty() ? "" : ", ") + measuredbrdf::NumberText(l * 1e-9, 10);
    for (const double i : thetaI)
    {
      for (const double o : thetaO)
      {
        for (const double p : phi)
        {
          rows += (rows.empty() ? "" : ",\n") + MakeOpenMaterialRow(l, i, o, p, value(l, i, o, p));
        }
      }
    }
  }
  return MakeOpenMaterialFile(wavelengths, rows);
}
} // namespace testio

#endif
