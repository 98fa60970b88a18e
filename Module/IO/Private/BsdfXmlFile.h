// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * BSDF XML files of WINDOW (Lawrence Berkeley National Laboratory) and Radiance: matrices over
 * angle bases (Klems 1994), and tensor trees (Ward et al. 2012). Reflection is read of one side,
 * transmission of both.
 */

#ifndef BsdfXmlFile_h
#define BsdfXmlFile_h

#include "FileFormat.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
/// material: "front" or "back", as Radiance calls the sides (the file says the opposite); empty:
/// front, or the side that the file has. A file of transmission only gives no BRDF.
MaterialFile ReadBsdfXml(const FileBytes& file, const std::string& material);

class BsdfXmlFormat : public FileFormat
{
public:
  static BsdfXmlFormat* New();
  vtkTypeMacro(BsdfXmlFormat, FileFormat);

  std::string GetName() override;
  std::string GetDescription() override
  {
    return "Radiance and WINDOW BSDF .xml (FILE.xml#front or #back)";
  }
  std::vector<std::string> GetExtensions() override { return { ".xml" }; }
  bool CanRead(const File& file) override;
  std::vector<std::string> GetMaterialNames(const File& file) override;

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
  bool HoldsSeveral() override { return true; }
};
} // namespace measuredbrdf

#endif
