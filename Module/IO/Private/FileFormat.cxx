// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FileFormat.h"

#include <algorithm>

namespace measuredbrdf
{
//------------------------------------------------------------------------------
bool FileFormat::Read(const File& file, Content& content, std::string& error)
{
  try
  {
    if (!file.Material.empty() && !this->HoldsSeveral())
    {
      throw FileError(file.Path + ": " + this->GetName() + ": holds one material, " +
                      Quote("#" + file.Material) + " names none");
    }
    content = this->DoRead(FileBytes::View(file.Path, file.Bytes), file.Material);
    return true;
  }
  catch (const FileError& e)
  {
    error = e.what();
  }
  catch (const std::exception& e) // out of memory, say
  {
    error = ToPrintable(file.Path + ": " + e.what());
  }
  return false;
}

//------------------------------------------------------------------------------
bool FileFormat::Write(vtkBRDF* brdf, const std::string& path, bool halfFloats, std::string& error)
{
  try
  {
    this->DoWrite(brdf, path, halfFloats);
    return true;
  }
  catch (const FileError& e)
  {
    error = e.what();
  }
  catch (const std::exception& e)
  {
    error = ToPrintable(path + ": " + e.what());
  }
  return false;
}

//------------------------------------------------------------------------------
void FileFormat::DoWrite(vtkBRDF*, const std::string& path, bool)
{
  throw FileError(path + ": " + this->GetName() + " is read only");
}

//------------------------------------------------------------------------------
bool FileFormat::HasMagic(const File& file, std::string_view magic)
{
  const std::size_t length = std::min(file.Bytes.size(), magic.size());
  return file.Bytes.substr(0, length) == magic.substr(0, length);
}
} // namespace measuredbrdf
