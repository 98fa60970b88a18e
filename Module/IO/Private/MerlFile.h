// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * MERL `.binary` (Matusik et al. 2003; layout: the database's BRDFRead.cpp): int32 n_theta_h,
 * n_theta_d, n_phi_d, then float64, three planes R, G, B with phi_d fastest and theta_h slowest.
 * Values are scaled by (1, 1.15, 1.66)/1500; a cell with a negative channel was not measured.
 */

#ifndef MerlFile_h
#define MerlFile_h

#include "FileFormat.h"

#include <string>
#include <vector>

class vtkTabulatedBRDF;

namespace measuredbrdf
{
constexpr const char* MerlFormatName = "MERL binary";

/// Whether the first twelve bytes could be the three sizes (they need not match the file's).
bool LooksLikeMerl(std::string_view bytes);

MaterialFile ReadMerl(const FileBytes& file);

/// Throws where the table can't be held by the format.
void WriteMerl(vtkTabulatedBRDF* table, const std::string& path);

/// The format, for vtkBRDFFormats.
class MerlFormat : public FileFormat
{
public:
  static MerlFormat* New();
  vtkTypeMacro(MerlFormat, FileFormat);

  std::string GetName() override { return MerlFormatName; }
  std::string GetDescription() override { return "MERL .binary"; }
  std::vector<std::string> GetExtensions() override { return { ".binary" }; }
  bool CanRead(const File& file) override;
  bool CanWrite() override { return true; }
  vtkSmartPointer<vtkBRDF> Convert(vtkBRDF* brdf, std::string& error) override;

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
  void DoWrite(vtkBRDF* brdf, const std::string& path, bool halfFloats) override;
};
} // namespace measuredbrdf

#endif
