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
 * SpectralChannels.h; FILE#550nm picks one), or in one column of any name (gray). A negative polar
 * angle is on the other side of the normal. Where phi_i is the same in all rows the material is
 * isotropic (GonioTable.h).
 *
 * Not read: E1392's other sections and codes, transmission, polarization, readings without phi_s.
 */

#ifndef AstmFile_h
#define AstmFile_h

#include "FileFormat.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
constexpr const char* AstmFormatName = "ASTM E1392 text";

/// material: "" or a wavelength's name, such as "550nm".
MaterialFile ReadAstm(const FileBytes& file, const std::string& material);

/// The format, for vtkBRDFFormats.
class AstmFormat : public FileFormat
{
public:
  static AstmFormat* New();
  vtkTypeMacro(AstmFormat, FileFormat);

  std::string GetName() override { return AstmFormatName; }
  std::string GetDescription() override { return "ASTM E1392 .astm (as Cornell's)"; }
  std::vector<std::string> GetExtensions() override { return { ".astm" }; }
  bool CanRead(const File& file) override;
  std::vector<std::string> GetMaterialNames(const File& file) override;

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
  bool HoldsSeveral() override { return true; }
};
} // namespace measuredbrdf

#endif
