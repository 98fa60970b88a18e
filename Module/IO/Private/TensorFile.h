// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The RGL-EPFL database's "tensor_file" (Dupuy and Jakob 2018; layout after the authors' loader
 * github.com/rgl-epfl/brdf-loader): 12 bytes of magic, version 1.0, then named fields with type,
 * shape and the offset of their data. Only its RGB form is read.
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
  std::string GetDescription() override { return "RGL .bsdf (RGB)"; }
  std::vector<std::string> GetExtensions() override { return { ".bsdf" }; }
  bool CanRead(const File& file) override;

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
};
} // namespace measuredbrdf

#endif
