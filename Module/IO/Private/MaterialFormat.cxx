// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialFormat.h"

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
    { throw FileError(file.GetPath(), ": is of no format"); } };
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
      Require(file.Material.empty() || this->Format->ListMaterials, file.Path, ": ",
        this->GetName(), ": holds one material, ", Quote("#" + file.Material), " names none");
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
  return this->Format->Write
           ? CatchFileError(path, error, [&]() { this->Format->Write(brdf, path, halfFloats); })
           : this->Superclass::Write(brdf, path, halfFloats, error);
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
void NameAfterFile(
  MaterialFile& result, const FileBytes& file, const std::string& kind, const std::string& more)
{
  result.BRDF->SetName(GetFileStem(file.GetPath()));
  result.BRDF->SetSource(kind + " file " + GetFileTitle(file.GetPath()) + more);
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
void NoteCount(std::int64_t count, const std::string& what, MaterialFile& result)
{
  if (count > 0)
  {
    result.AddNote(Concat(count, what));
  }
}

//------------------------------------------------------------------------------
void NotePadding(const ByteReader& reader, MaterialFile& result)
{
  NoteCount(static_cast<std::int64_t>(reader.GetRemaining()),
    " bytes of padding behind the values were left out.", result);
}
} // namespace measuredbrdf
