// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * NVIDIA's `.mbsdf` (MDL specification, appendix B): a magic line, lines of key="value", then a
 * block of values over (theta_in, theta_out, phi), phi fastest. Only reflection is read.
 */

#ifndef MbsdfFile_h
#define MbsdfFile_h

#include "FileFormat.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
constexpr const char* MbsdfFormatName = "NVIDIA MBSDF";
constexpr const char MbsdfMagic[] = "NVIDIA ARC MBSDF V1"; // a line

MaterialFile ReadMbsdf(const FileBytes& file);

/// The format, for vtkBRDFFormats.
class MbsdfFormat : public FileFormat
{
public:
  static MbsdfFormat* New();
  vtkTypeMacro(MbsdfFormat, FileFormat);

  std::string GetName() override { return MbsdfFormatName; }
  std::string GetDescription() override { return "NVIDIA .mbsdf"; }
  std::vector<std::string> GetExtensions() override { return { ".mbsdf" }; }
  bool CanRead(const File& file) override;

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
};
} // namespace measuredbrdf

#endif
