// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFReader.h"

#include "AbsentLibraries.h"
#include "ExrHeader.h"
#include "FileBytes.h"
#include "vtkBRDFFormats.h"
#include "vtkCommand.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkObjectFactory.h"

#include <array>
#include <cstdint>
#include <filesystem>

vtkStandardNewMacro(vtkBRDFReader);

namespace
{
using namespace measuredbrdf;

struct Path
{
  std::string File;
  std::string Material; // after '#'
};

//------------------------------------------------------------------------------
Path SplitPath(const std::string& name)
{
  // A file whose own name holds '#' is taken as it is.
  const std::size_t hash = name.rfind('#');
  std::error_code error;
  if (hash == std::string::npos || std::filesystem::exists(name, error))
  {
    return { name, "" };
  }
  return { name.substr(0, hash), name.substr(hash + 1) };
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDFFormat> FindFormat(const vtkBRDFFormat::File& file)
{
  auto format = vtkBRDFFormats::FindForReading(file);
  if (format)
  {
    return format;
  }
  if (!MEASUREDBRDF_WITH_OPENEXR && file.Bytes.substr(0, sizeof(ExrMagic) - 1) == ExrMagic)
  {
    throw FileError(file.Path + ": " + NoOpenEXR + ".exr materials cannot be read");
  }
  std::string found;
  const std::string_view start = file.Bytes.substr(0, 2);
  if (start == "\xff\xfe" || start == "\xfe\xff")
  {
    found = "; it may be text in UTF-16: save it as UTF-8";
  }
  else if (file.Bytes.size() >= 12)
  {
    std::array<std::int32_t, 3> sizes;
    ByteReader::Copy(sizes.data(), file.Bytes.data(), sizes.size());
    found = "; as MERL's three sizes they read " + std::to_string(sizes[0]) + ", " +
            std::to_string(sizes[1]) + ", " + std::to_string(sizes[2]) +
            ", expected 1 to 2048 each";
  }
  throw FileError(file.Path + ": magic at byte 0: the first bytes are of no known format (" +
                  vtkBRDFFormats::GetNames() + ")" + found);
}
}

//------------------------------------------------------------------------------
bool vtkBRDFReader::Read()
{
  this->ErrorMessage.clear();
  this->FormatName.clear();
  this->Notes.clear();
  this->NumberOfNegativeValues = 0;
  this->NumberOfInvalidValues = 0;
  const auto report = [this](double progress)
  { this->InvokeEvent(vtkCommand::ProgressEvent, &progress); };

  try
  {
    report(0.0);
    const Path path = SplitPath(this->FileName);
    const FileBytes bytes(path.File);
    report(0.3);
    const vtkBRDFFormat::File file{ path.File, path.Material, bytes.GetView() };
    const auto format = FindFormat(file);
    this->FormatName = format->GetName();
    vtkBRDFFormat::Content content;
    std::string error;
    if (!format->Read(file, content, error))
    {
      throw FileError(error);
    }
    if (!content.BRDF)
    {
      if (content.Transmission)
      {
        this->Transmission = content.Transmission;
        this->Notes = content.Notes;
      }
      throw FileError(
        path.File + ": " + this->FormatName +
        (content.Transmission ? ": the file holds transmission only; expected reflection, too"
                              : " gave no material"));
    }
    this->BRDF = content.BRDF;
    this->Transmission = content.Transmission;
    this->Notes = content.Notes;
    this->NumberOfNegativeValues = content.NumberOfNegativeValues;
    this->NumberOfInvalidValues = content.NumberOfInvalidValues;
    report(1.0);
    return true;
  }
  catch (const FileError& e)
  {
    this->ErrorMessage = e.what();
  }
  catch (const std::exception& e) // out of memory, say
  {
    this->ErrorMessage = ToPrintable(this->FileName + ": " + e.what());
  }
  vtkErrorMacro(<< this->ErrorMessage);
  return false;
}

//------------------------------------------------------------------------------
std::string vtkBRDFReader::GetPrintable(const std::string& text)
{
  return ToPrintable(text, std::string::npos, true);
}

//------------------------------------------------------------------------------
std::vector<std::string> vtkBRDFReader::GetMaterialNames()
{
  try
  {
    const Path path = SplitPath(this->FileName);
    const FileBytes bytes(path.File);
    const vtkBRDFFormat::File file{ path.File, "", bytes.GetView() };
    return FindFormat(file)->GetMaterialNames(file);
  }
  catch (const std::exception&)
  {
    // No such file has no names; Read says what is wrong with it.
  }
  return {};
}

//------------------------------------------------------------------------------
void vtkBRDFReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << ToPrintable(this->FileName) << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "FormatName: " << this->FormatName << "\n";
  os << indent << "Notes: " << this->Notes << "\n";
  os << indent << "NumberOfNegativeValues: " << this->NumberOfNegativeValues << "\n";
  os << indent << "NumberOfInvalidValues: " << this->NumberOfInvalidValues << "\n";
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "Transmission: " << this->Transmission.Get() << "\n";
}
