// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause

#include "FileBytes.h"

#include <map>

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
// Sizes of values that are always the same. OpenEXR takes the next attribute from behind what it
// has read of a value, whatever the value's size claims.
const std::map<std::string, std::size_t> FixedSizes = { { "box2f", 16 }, { "box2i", 16 },
  { "chromaticities", 32 }, { "compression", 1 }, { "deepImageState", 1 }, { "double", 8 },
  { "envmap", 1 }, { "float", 4 }, { "int", 4 }, { "keycode", 28 }, { "lineOrder", 1 },
  { "m33d", 72 }, { "m33f", 36 }, { "m44d", 128 }, { "m44f", 64 }, { "rational", 8 },
  { "tiledesc", 9 }, { "timecode", 8 }, { "v2d", 16 }, { "v2f", 8 }, { "v2i", 8 }, { "v3d", 24 },
  { "v3f", 12 }, { "v3i", 12 } };
constexpr std::size_t ChannelSize = 16; // behind a channel's name

//------------------------------------------------------------------------------
// How many bytes OpenEXR reads of a value that says so itself.
std::size_t MeasureValue(
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
    return 8 + 4 * static_cast<std::size_t>(width * height);
  }
  if (type == "stringvector")
  {
    while (reader.GetOffset() - begin < size)
    {
      const auto length = reader.Read<std::uint32_t>(field);
      reader.Take(length, field);
    }
  }
  else if (type == "chlist")
  {
    while (!ReadText(reader, field + " (channel)").empty())
    {
      reader.Take(ChannelSize, field);
    }
  }
  else
  {
    return size;
  }
  return reader.GetOffset() - begin;
}

//------------------------------------------------------------------------------
void CheckValue(
  const ByteReader& reader, const std::string& type, std::size_t size, const std::string& field)
{
  const auto fixed = FixedSizes.find(type);
  const std::size_t expected =
    fixed != FixedSizes.end() ? fixed->second : MeasureValue(reader, type, size, field);
  if (size != expected)
  {
    reader.Fail(field, "found " + std::to_string(size) + " bytes of type " + Quote(type) +
                         ", expected " + std::to_string(expected));
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
} // namespace measuredbrdf
