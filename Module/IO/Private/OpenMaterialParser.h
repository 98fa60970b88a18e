// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The JSON of an ASAM OpenMATERIAL 3D look-up table (.xompt), as texts and numbers. Private to the
 * IO room.
 */

#ifndef OpenMaterialParser_h
#define OpenMaterialParser_h

#include "FileBytes.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace measuredbrdf
{
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

/**
 * Read without building a tree: memory is at most five times the file's size. Throws FileError
 * where it is no JSON, is nested deeper than 32 levels, has no "brdf" with a "lookupTable" of rows
 * of five numbers, or has one twice.
 */
OpenMaterialTexts ParseOpenMaterial(const FileBytes& file);
} // namespace measuredbrdf

#endif
