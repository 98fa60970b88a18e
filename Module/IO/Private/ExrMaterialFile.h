// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * This project's material format: an OpenEXR file whose first part's string attribute
 * "measuredBRDF" holds JSON (names, model, numbers; vtkBRDFData), and whose parts hold
 * the tables as 32-bit or 16-bit floats, ZIP-compressed (lossless). Part "volume" or, in term 1 of
 * a sum, "1.volume": width = fastest axis, height = product of the others, channels R, G, B or Y. A
 * material without tables has one part "header" of one texel.
 */

#ifndef ExrMaterialFile_h
#define ExrMaterialFile_h

#include "FileFormat.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
constexpr const char* ExrFormatName = "OpenEXR material";

MaterialFile ReadExrMaterial(const FileBytes& file);

/// halfFloats: tables as 16-bit floats, a rounding of 2^-11; else 32-bit ones, bit by bit.
void WriteExrMaterial(vtkBRDF* brdf, const std::string& path, bool halfFloats);

/// The format, for vtkBRDFFormats.
class ExrFormat : public FileFormat
{
public:
  static ExrFormat* New();
  vtkTypeMacro(ExrFormat, FileFormat);

  std::string GetName() override { return ExrFormatName; }
  std::string GetDescription() override { return "this project's .exr"; }
  std::vector<std::string> GetExtensions() override { return { ".exr" }; }
  bool CanRead(const File& file) override;
  bool CanWrite() override { return true; }

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
  void DoWrite(vtkBRDF* brdf, const std::string& path, bool halfFloats) override;
};
} // namespace measuredbrdf

#endif
