// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   FileFormat
 * @brief   superclass of the module's own formats, whose errors are exceptions
 *
 * Private to the IO room. Subclasses throw FileError, or any std::exception, out of DoRead and
 * DoWrite; here they become error texts.
 */

#ifndef FileFormat_h
#define FileFormat_h

#include "FileBytes.h"
#include "vtkBRDFFormat.h"

#include <string>
#include <string_view>

namespace measuredbrdf
{
using MaterialFile = vtkBRDFFormat::Content;

class FileFormat : public vtkBRDFFormat
{
public:
  vtkTypeMacro(FileFormat, vtkBRDFFormat);

  bool Read(const File& file, Content& content, std::string& error) final;
  bool Write(vtkBRDF* brdf, const std::string& path, bool halfFloats, std::string& error) final;

protected:
  FileFormat() = default;
  ~FileFormat() override = default;

  virtual MaterialFile DoRead(const FileBytes& file, const std::string& material) = 0;
  virtual void DoWrite(vtkBRDF* brdf, const std::string& path, bool halfFloats);

  /// Whether `path#name` picks one of several; else DoRead is never called with a material.
  virtual bool HoldsSeveral() { return false; }

  /// Whether the file begins with the magic, or is too short for it but begins like it.
  static bool HasMagic(const File& file, std::string_view magic);

private:
  FileFormat(const FileFormat&) = delete;
  void operator=(const FileFormat&) = delete;
};
} // namespace measuredbrdf

#endif
