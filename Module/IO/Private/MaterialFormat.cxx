// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialFormat.h"

#include "NumberText.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace measuredbrdf
{
vtkStandardNewMacro(BuiltInFormat);

//------------------------------------------------------------------------------
BuiltInFormat::BuiltInFormat()
{
  static const MaterialFormat none = { "", "", "", [](const File&) { return false; },
    [](const FileBytes& file, const std::string&) -> MaterialFile
    { throw FileError(file.GetPath() + ": is of no format"); } };
  this->Format = &none;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDFFormat> BuiltInFormat::Make(const MaterialFormat& format)
{
  auto made = vtkSmartPointer<BuiltInFormat>::New();
  made->Format = &format;
  return made;
}

//------------------------------------------------------------------------------
bool BuiltInFormat::Read(const File& file, Content& content, std::string& error)
{
  return CatchFileError(file.Path, error,
    [&]()
    {
      if (!file.Material.empty() && !this->Format->ListMaterials)
      {
        throw FileError(file.Path + ": " + this->GetName() + ": holds one material, " +
                        Quote("#" + file.Material) + " names none");
      }
      content = this->Format->Read(FileBytes::View(file.Path, file.Bytes), file.Material);
    });
}

//------------------------------------------------------------------------------
std::vector<std::string> BuiltInFormat::GetMaterialNames(const File& file)
{
  std::vector<std::string> names;
  std::string error; // Read says what is wrong
  CatchFileError(file.Path, error,
    [&]()
    {
      if (this->Format->ListMaterials)
      {
        names = this->Format->ListMaterials(FileBytes::View(file.Path, file.Bytes));
      }
    });
  return names;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> BuiltInFormat::Convert(vtkBRDF* brdf, std::string& error)
{
  return this->Format->Convert ? this->Format->Convert(brdf, error)
                               : this->Superclass::Convert(brdf, error);
}

//------------------------------------------------------------------------------
bool BuiltInFormat::Write(
  vtkBRDF* brdf, const std::string& path, bool halfFloats, std::string& error)
{
  if (!this->Format->Write)
  {
    return this->Superclass::Write(brdf, path, halfFloats, error);
  }
  return CatchFileError(path, error, [&]() { this->Format->Write(brdf, path, halfFloats); });
}

//------------------------------------------------------------------------------
bool HasMagic(const vtkBRDFFormat::File& file, std::string_view magic)
{
  const std::size_t length = std::min(file.Bytes.size(), magic.size());
  return file.Bytes.substr(0, length) == magic.substr(0, length);
}

//------------------------------------------------------------------------------
bool HasExtension(const std::string& path, std::string_view extension)
{
  return path.size() >= extension.size() &&
         std::equal(extension.rbegin(), extension.rend(), path.rbegin(),
           [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

//------------------------------------------------------------------------------
void NoteStrangeAlbedo(vtkBRDF* brdf, double darkest, const std::string& hint, MaterialFile& result)
{
  const double o[3] = { 0.5, 0.0, std::sqrt(0.75) };
  double albedo[3];
  brdf->GetDirectionalAlbedo(o, albedo);
  const double largest = *std::max_element(albedo, albedo + 3);
  if (largest > 1.0 || largest < darkest)
  {
    result.AddNote("The material reflects " + NumberText(largest, 3) +
                   " times the light toward a view at 30 degrees: " + hint);
  }
}

//------------------------------------------------------------------------------
void NotePadding(const ByteReader& reader, MaterialFile& result)
{
  if (reader.GetRemaining() > 0)
  {
    result.AddNote(
      std::to_string(reader.GetRemaining()) + " bytes of padding behind the values were left out.");
  }
}
} // namespace measuredbrdf
