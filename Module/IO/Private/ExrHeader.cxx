// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ExrHeader.h"

#include "FileBytes.h"

#include <fstream>

namespace measuredbrdf
{
namespace
{
// "OpenEXR File Layout", openexr.com: magic, version and flags, headers; a header is a list of
// attributes (name, type, size of the value, value) that an empty name ends; the headers of a
// multi-part file end with an empty one.
constexpr std::uint32_t MultiPartFlag = 0x1000;

//------------------------------------------------------------------------------
std::string ReadText(ByteReader& reader, const std::string& field)
{
  const std::string_view rest = reader.GetFile().GetView().substr(reader.GetOffset());
  const std::size_t length = rest.find('\0');
  if (length == std::string_view::npos)
  {
    reader.Fail(field, "has no end");
  }
  return std::string(reader.Take(length + 1, field), length);
}

//------------------------------------------------------------------------------
// Values that hold sizes themselves.
void CheckValue(
  ByteReader reader, const std::string& type, std::size_t size, const std::string& field)
{
  const std::size_t begin = reader.GetOffset();
  if (type == "preview")
  {
    const std::uint64_t width = reader.Read<std::uint32_t>(field);
    const std::uint64_t height = reader.Read<std::uint32_t>(field);
    const std::uint64_t texels = size < 8 ? 0 : (size - 8) / 4;
    if (height != 0 && width > texels / height)
    {
      reader.Fail(field, "found a preview of " + std::to_string(width) + " x " +
                           std::to_string(height) + ", but its value ends after " +
                           std::to_string(texels) + " texels");
    }
  }
  else if (type == "stringvector")
  {
    while (reader.GetOffset() - begin < size)
    {
      const auto length = reader.Read<std::uint32_t>(field);
      reader.Take(length, field);
    }
  }
}

//------------------------------------------------------------------------------
// Returns whether the header held any attribute.
bool CheckHeader(ByteReader& reader)
{
  bool any = false;
  for (;;)
  {
    const std::string name = ReadText(reader, "header, name of an attribute");
    if (name.empty())
    {
      return any;
    }
    any = true;
    const std::string field = "attribute " + Quote(name);
    const std::string type = ReadText(reader, field + " (type)");
    const auto size = reader.Read<std::uint32_t>(field + " (size)");
    const ByteReader value = reader;
    reader.Take(size, field);
    CheckValue(value, type, size, field);
  }
}
}

//------------------------------------------------------------------------------
void CheckExrHeader(const FileBytes& file, const std::string& format)
{
  ByteReader reader(file, format);
  reader.Take(sizeof(ExrMagic) - 1, "magic");
  const bool multiPart = (reader.Read<std::uint32_t>("version") & MultiPartFlag) != 0;
  while (CheckHeader(reader) && multiPart)
  {
  }
}

//------------------------------------------------------------------------------
void CheckExrImage(const std::string& path)
{
  char magic[sizeof(ExrMagic)] = "";
  std::ifstream(path, std::ios::binary).read(magic, sizeof(magic) - 1);
  if (std::string(magic) == ExrMagic)
  {
    CheckExrHeader(FileBytes(path), "OpenEXR image");
  }
}
} // namespace measuredbrdf
