// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFReader.h"

#include "ExrHeader.h"
#include "ExrMaterialFile.h"
#include "FileBytes.h"
#include "FitFile.h"
#include "MbsdfFile.h"
#include "MerlFile.h"
#include "TensorFile.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

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
// Whether the file begins with the magic, or is too short for it but begins like it.
bool HasMagic(const FileBytes& file, std::string_view magic)
{
  const std::size_t length = std::min(file.GetSize(), magic.size());
  return file.GetView().substr(0, length) == magic.substr(0, length);
}

//------------------------------------------------------------------------------
// ASCII or UTF-8 without control characters, judged by the first bytes.
bool LooksLikeText(const FileBytes& file)
{
  const std::string_view start = file.GetView().substr(0, 4096);
  return std::all_of(start.begin(), start.end(),
    [](char c)
    {
      const auto byte = static_cast<unsigned char>(c);
      return byte >= 0x20 ? byte != 0x7f && byte < 0xf5 : (c == '\n' || c == '\r' || c == '\t');
    });
}

//------------------------------------------------------------------------------
const char* GetFormat(const FileBytes& file)
{
  // Magics end with bytes that matter ("\0", "\n"): their whole arrays but the closing zero count.
  if (HasMagic(file, std::string_view(TensorMagic, sizeof(TensorMagic))))
  {
    return TensorFormat;
  }
  if (HasMagic(file, std::string_view(MbsdfMagic, sizeof(MbsdfMagic) - 1)))
  {
    return MbsdfFormat;
  }
  if (HasMagic(file, std::string_view(ExrMagic, sizeof(ExrMagic) - 1)))
  {
    return ExrFormat;
  }
  if (LooksLikeText(file))
  {
    return FitFormat;
  }
  if (LooksLikeMerl(file))
  {
    return MerlFormat;
  }
  std::string found;
  const std::string_view start = file.GetView().substr(0, 2);
  if (start == "\xff\xfe" || start == "\xfe\xff")
  {
    found = "; it may be text in UTF-16: save it as UTF-8";
  }
  else if (file.GetSize() >= 12)
  {
    std::array<std::int32_t, 3> sizes;
    ByteReader::Copy(sizes.data(), file.GetData(), sizes.size());
    found = "; as MERL's three sizes they read " + std::to_string(sizes[0]) + ", " +
            std::to_string(sizes[1]) + ", " + std::to_string(sizes[2]) +
            ", expected 1 to 2048 each";
  }
  throw FileError(
    file.GetPath() +
    ": magic at byte 0: the first bytes are of no known format (MERL binary, RGL tensor file, "
    "NVIDIA MBSDF, OpenEXR material, text of published fits)" +
    found);
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
    const FileBytes file(path.File);
    report(0.3);
    const std::string format = GetFormat(file);
    this->FormatName = format;
    if (format != FitFormat && !path.Material.empty())
    {
      throw FileError(path.File + ": " + format + ": holds one material, " +
                      Quote("#" + path.Material) + " names none");
    }
    MaterialFile result;
    if (format == TensorFormat)
    {
      result = ReadTensor(file);
    }
    else if (format == MbsdfFormat)
    {
      result = ReadMbsdf(file);
    }
    else if (format == ExrFormat)
    {
      result = ReadExrMaterial(file);
    }
    else if (format == FitFormat)
    {
      result = FitFile(path.File, file.GetView()).GetMaterial(path.Material);
    }
    else
    {
      result = ReadMerl(file);
    }
    this->BRDF = result.BRDF;
    this->Notes = result.Notes;
    this->NumberOfNegativeValues = result.NumberOfNegativeValues;
    this->NumberOfInvalidValues = result.NumberOfInvalidValues;
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
    const FileBytes file(path.File);
    if (GetFormat(file) == std::string(FitFormat))
    {
      return FitFile(path.File, file.GetView()).GetNames();
    }
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
}
