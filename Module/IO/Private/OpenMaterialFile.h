// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * ASAM OpenMATERIAL 3D's BRDF look-up tables (.xompt; schema material_brdf_schema.json of versions
 * 1.0 and 1.1): JSON with "metadata" and "brdf". "brdf" holds rows of wavelength (m), zenith angles
 * of incidence and exit, azimuth of exit from incidence (rad), and f (1/sr). The material is
 * isotropic. An azimuth of 0 is on the side from which the light comes; azimuths run
 * counterclockwise, seen from above the surface (the standard does not say).
 *
 * Several visible wavelengths become RGB (SpectralColor.h). A single one, or wavelengths of which
 * fewer than two are visible, give gray, by the first of them; `path#905nm` picks one.
 */

#ifndef OpenMaterialFile_h
#define OpenMaterialFile_h

#include "FileFormat.h"
#include "OpenMaterialParser.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
/// material: "" or a wavelength's name, such as "905nm".
MaterialFile ReadOpenMaterial(const FileBytes& file, const std::string& material);

/// The format, for vtkBRDFFormats.
class OpenMaterialFormat : public FileFormat
{
public:
  static OpenMaterialFormat* New();
  vtkTypeMacro(OpenMaterialFormat, FileFormat);

  std::string GetName() override { return OpenMaterialFormatName; }
  std::string GetDescription() override { return "OpenMATERIAL 3D .xompt"; }
  std::vector<std::string> GetExtensions() override { return { ".xompt" }; }
  bool CanRead(const File& file) override;
  std::vector<std::string> GetMaterialNames(const File& file) override;

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
  bool HoldsSeveral() override { return true; }
};
} // namespace measuredbrdf

#endif
