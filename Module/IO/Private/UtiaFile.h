// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The UTIA database's .bin (Filip and Vavra 2014): anisotropic materials, no header. 3 planes (red
 * first) of 288 x 288 doubles, little-endian. A row for each direction of the light, a column for
 * each of the view: polar angles 0, 15, ..., 75 degrees, in each of them azimuths 0, 7.5, ...,
 * 352.5 degrees.
 */

#ifndef UtiaFile_h
#define UtiaFile_h

#include "FileFormat.h"

#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// What a file of this kind has, to the byte.
constexpr std::size_t UtiaBytes = 3u * 288u * 288u * 8u;

/// material: "" for the values as they are, in 1/sr; "display" for values that are display colors
/// (sRGB) of f / 100 in units of 140, as Dupuy's dj_brdf takes the database's files. Colors are
/// decoded at the nodes, and interpolation is linear in f; dj_brdf interpolates first, and changes
/// from sRGB's line to its curve at 0.0375 instead of 0.04045.
MaterialFile ReadUtia(const FileBytes& file, const std::string& material);

class UtiaFormat : public FileFormat
{
public:
  static UtiaFormat* New();
  vtkTypeMacro(UtiaFormat, FileFormat);

  std::string GetName() override;
  std::string GetDescription() override
  {
    return "UTIA .bin (FILE.bin#display for display colors)";
  }
  std::vector<std::string> GetExtensions() override { return { ".bin" }; }
  bool CanRead(const File& file) override;
  std::vector<std::string> GetMaterialNames(const File& file) override;

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
  bool HoldsSeveral() override { return true; }
};
} // namespace measuredbrdf

#endif
