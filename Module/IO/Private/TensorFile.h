// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The RGL-EPFL database's "tensor_file" (Dupuy and Jakob 2018; layout after the authors' loader
 * github.com/rgl-epfl/brdf-loader): 12 bytes of magic, version 1.0, then named fields with type,
 * shape and the offset of their data. Both forms are read: NAME_rgb.bsdf, and NAME_spec.bsdf, whose
 * field "spectra" has one f cos(theta_o) for each of the field "wavelengths" (nm). Spectra become
 * RGB as SpectralColor.h says: sums over the CIE 1931 color-matching functions under D65.
 */

#ifndef TensorFile_h
#define TensorFile_h

#include "FileFormat.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
constexpr const char* TensorFormatName = "RGL tensor file";
constexpr const char TensorMagic[] = "tensor_file"; // with its terminating zero

MaterialFile ReadTensor(const FileBytes& file);

/// The format, for vtkBRDFFormats.
class TensorFormat : public FileFormat
{
public:
  static TensorFormat* New();
  vtkTypeMacro(TensorFormat, FileFormat);

  std::string GetName() override { return TensorFormatName; }
  std::string GetDescription() override { return "RGL .bsdf (RGB or spectral)"; }
  std::vector<std::string> GetExtensions() override { return { ".bsdf" }; }
  bool CanRead(const File& file) override;

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
};
} // namespace measuredbrdf

#endif
