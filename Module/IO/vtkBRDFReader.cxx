// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFReader.h"

#include "FileBytes.h"
#include "vtkBRDFFormats.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
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
// What a file that is no material may be: what often lies where one is looked for.
std::string DescribeContent(std::string_view bytes)
{
  struct Kind
  {
    std::string_view Start;
    const char* Description;
  };
  static constexpr Kind kinds[] = {
    { "version https://git-lfs", "it is a pointer of Git LFS, not the file itself: 'git lfs pull' "
                                 "downloads that" },
    { "\xff\xfe", "it may be text in UTF-16: save it as UTF-8" },
    { "\xfe\xff", "it may be text in UTF-16: save it as UTF-8" },
    { "PK\x03\x04", "it is a ZIP archive: unpack it" },
    { "\x1f\x8b", "it is compressed by gzip: unpack it" },
    { "\x89PNG", "it is a PNG picture" },
    { "\xff\xd8\xff", "it is a JPEG picture" },
    { "#?RADIANCE", "it is a Radiance picture, an environment perhaps" },
    { "#?RGBE", "it is a Radiance picture, an environment perhaps" },
    { "\x89HDF", "it is an HDF5 file" },
    { "%PDF", "it is a PDF document" },
  };
  for (const Kind& kind : kinds)
  {
    if (bytes.substr(0, kind.Start.size()) == kind.Start)
    {
      return kind.Description;
    }
  }
  const std::string_view start = bytes.substr(0, 4096);
  if (start.find_first_not_of('\0') == std::string_view::npos)
  {
    return "its bytes are 0: its download or copy may be unfinished";
  }
  if (IsText(start))
  {
    const std::string lower = vtksys::SystemTools::LowerCase(std::string(start));
    const auto holds = [&lower](const char* word) { return lower.find(word) != std::string::npos; };
    const std::size_t first = std::min(lower.find_first_not_of(" \t\r\n"), lower.size());
    if (holds("<html") || lower.find("<!doctype html") == first)
    {
      return "it is a web page, saved in the file's place";
    }
    if (holds("scattertype") && holds("samplerotation"))
    {
      return "it looks like a table of Zemax's (\"ScatterType\"), which is not read";
    }
    const std::string_view line = start.substr(first, start.find_first_of("\r\n", first) - first);
    const bool isXml = !line.empty() && line[0] == '<';
    return (isXml ? "it is XML without the element 'WindowElement' of BSDF files, and begins "
                  : "it is text that begins ") +
           Quote(line.substr(0, 60));
  }
  if (bytes.size() < 12)
  {
    return Concat("it has ", bytes.size(), " bytes only");
  }
  std::array<std::int32_t, 3> sizes;
  ByteReader::Copy(sizes.data(), bytes.data(), sizes.size());
  return Concat("as MERL's three sizes they read ", sizes[0], ", ", sizes[1], ", ", sizes[2],
    ", expected 1 to 2048 each");
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDFFormat> FindFormat(const vtkBRDFFormat::File& file)
{
  auto format = vtkBRDFFormats::FindForReading(file);
  if (format)
  {
    return format;
  }
  throw FileError(file.Path, ": magic at byte 0: the first bytes are of no known format (",
    vtkBRDFFormats::GetNames(), "); ", DescribeContent(file.Bytes));
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

  const bool done = measuredbrdf::CatchFileError(this->FileName, this->ErrorMessage,
    [&]()
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
      const bool isRead = format->Read(file, content, error);
      Require(isRead, error);
      Require(content.BRDF || content.Transmission, path.File, ": ", this->FormatName,
        " gave no material");
      this->Transmission = content.Transmission;
      this->Notes = content.Notes;
      Require(content.BRDF != nullptr, path.File, ": ", this->FormatName,
        ": the file holds transmission only; expected reflection, too");
      this->BRDF = content.BRDF;
      this->NumberOfNegativeValues = content.NumberOfNegativeValues;
      this->NumberOfInvalidValues = content.NumberOfInvalidValues;
      report(1.0);
    });
  if (!done)
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  return done;
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
