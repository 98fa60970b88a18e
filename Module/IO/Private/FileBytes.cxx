// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FileBytes.h"

#include "WholeFile.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <system_error>

namespace measuredbrdf
{
namespace
{
std::string LastError() { return std::generic_category().message(errno); }
}

//------------------------------------------------------------------------------
bool CatchFileError(const std::string& path, std::string& error, const std::function<void()>& run)
{
  try
  {
    run();
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
std::uintmax_t CheckFile(const std::string& path)
{
  Require(!path.empty(), "no file name was given");
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const bool isOtherError = error && error != std::errc::no_such_file_or_directory;
  Require(std::filesystem::exists(status), path, ": ",
    isOtherError ? error.message() : std::string("no such file"));
  Require(!std::filesystem::is_directory(status), path, ": is a directory, a file was expected");
  Require(std::filesystem::is_regular_file(status), path, ": is not a regular file");
  const bool opens = std::ifstream(path, std::ios::binary).is_open();
  Require(opens, path, ": cannot be opened: ", LastError());
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  Require(!error, path, ": ", error.message());
  Require(size > 0, path, ": the file is empty (0 bytes)");
  return size;
}

//------------------------------------------------------------------------------
std::string GetFileStem(const std::string& path)
{
  return std::filesystem::path(path).stem().string();
}

//------------------------------------------------------------------------------
std::string GetFileTitle(const std::string& path)
{
  return std::filesystem::path(path).filename().string();
}

//------------------------------------------------------------------------------
bool IsText(std::string_view bytes)
{
  return std::all_of(bytes.begin(), bytes.end(),
    [](char c)
    {
      const auto byte = static_cast<unsigned char>(c);
      return byte >= 0x20 ? byte != 0x7f && byte < 0xf5 : (c == '\n' || c == '\r' || c == '\t');
    });
}

//------------------------------------------------------------------------------
void WriteFile(const std::string& path, std::string_view bytes)
{
  try
  {
    WriteWholeFile(path, bytes);
  }
  catch (const std::runtime_error& e)
  {
    throw FileError(e.what());
  }
}

//------------------------------------------------------------------------------
FileBytes::FileBytes(const std::string& path)
  : Path(path)
{
  const auto count = static_cast<std::size_t>(CheckFile(path));
  this->Data.reset(new char[count]); // not filled first: it may be large
  this->Bytes = std::string_view(this->Data.get(), count);
  std::ifstream file(path, std::ios::binary);
  file.read(this->Data.get(), static_cast<std::streamsize>(count));
  Require(static_cast<std::size_t>(file.gcount()) == count, path, ": could not be read whole: ",
    file.bad() || !file.is_open() ? LastError() : std::string("it became shorter meanwhile"));
}

//------------------------------------------------------------------------------
FileBytes FileBytes::View(const std::string& path, std::string_view bytes)
{
  FileBytes file;
  file.Path = path;
  file.Bytes = bytes;
  return file;
}

//------------------------------------------------------------------------------
const char* ByteReader::Take(std::uint64_t count, const std::string& field)
{
  this->Require(count <= this->GetRemaining(), field, "needs ", count,
    " bytes, but the file ends after ", this->GetRemaining());
  const char* bytes = this->File.GetView().data() + this->Offset;
  this->Offset += static_cast<std::size_t>(count);
  return bytes;
}

//------------------------------------------------------------------------------
const char* ByteReader::TakeRest(std::uint64_t count, const std::string& values)
{
  const std::size_t begin = this->Offset;
  const std::uint64_t found = this->GetRemaining();
  const char* bytes = found < count ? nullptr : this->Take(count, "values");
  if (!bytes || !this->IsPadding())
  {
    this->FailAt(begin, "values", values, " need ", count, " bytes, found ", found);
  }
  return bytes;
}

//------------------------------------------------------------------------------
std::string_view ByteReader::TakeUntil(
  char delimiter, const std::string& field, const char* missing)
{
  const std::string_view rest = this->File.GetView().substr(this->Offset);
  const std::size_t length = rest.find(delimiter);
  this->Require(length != std::string_view::npos, field, missing);
  this->Offset += length + 1;
  return rest.substr(0, length);
}

//------------------------------------------------------------------------------
bool ByteReader::IsPadding() const
{
  constexpr std::size_t most = 4096;
  const std::string_view padding("\0 \t\r\n\x1a", 6);
  return this->GetRemaining() <= most &&
         this->File.GetView().find_first_not_of(padding, this->Offset) == std::string_view::npos;
}

//------------------------------------------------------------------------------
const char* ByteReader::At(
  std::uint64_t offset, std::uint64_t count, const std::string& field) const
{
  const std::uint64_t size = this->File.GetView().size();
  this->Require(!(offset > size || count > size - offset), field, "its ", count,
    " bytes from byte ", offset, " reach beyond the file's end at ", size);
  return this->File.GetView().data() + offset;
}

//------------------------------------------------------------------------------
// "OpenEXR File Layout", openexr.com: magic, version and flags, headers; a header is a list of
// attributes (name, type, size of the value, value) that an empty name ends; the headers of a
// multi-part file end with an empty one.
namespace
{
constexpr std::uint32_t MultiPartFlag = 0x1000;
constexpr std::size_t ChannelSize = 16; // behind a channel's name

// Sizes of values that are always the same. OpenEXR takes the next attribute from behind what it
// has read of a value, whatever the value's size claims.
const std::map<std::string_view, std::size_t> FixedSizes = { { "box2f", 16 }, { "box2i", 16 },
  { "chromaticities", 32 }, { "compression", 1 }, { "deepImageState", 1 }, { "double", 8 },
  { "envmap", 1 }, { "float", 4 }, { "int", 4 }, { "keycode", 28 }, { "lineOrder", 1 },
  { "m33d", 72 }, { "m33f", 36 }, { "m44d", 128 }, { "m44f", 64 }, { "rational", 8 },
  { "tiledesc", 9 }, { "timecode", 8 }, { "v2d", 16 }, { "v2f", 8 }, { "v2i", 8 }, { "v3d", 24 },
  { "v3f", 12 }, { "v3i", 12 } };

std::string_view ReadText(ByteReader& reader, const std::string& field)
{
  return reader.TakeUntil('\0', field, "has no end");
}

// How many bytes OpenEXR reads of a value.
std::size_t MeasureValue(
  ByteReader reader, std::string_view type, std::size_t size, const std::string& field)
{
  const std::size_t begin = reader.GetOffset();
  const auto fixed = FixedSizes.find(type);
  if (fixed != FixedSizes.end())
  {
    return fixed->second;
  }
  if (type == "preview")
  {
    const std::uint64_t width = reader.Read<std::uint32_t>(field);
    const std::uint64_t height = reader.Read<std::uint32_t>(field);
    const std::uint64_t texels = size < 8 ? 0 : (size - 8) / 4;
    reader.Require(height == 0 || width <= texels / height, field, "found a preview of ", width,
      " x ", height, ", but its value ends after ", texels, " texels");
    return 8 + 4 * static_cast<std::size_t>(width * height);
  }
  if (type == "stringvector")
  {
    while (reader.GetOffset() - begin < size)
    {
      reader.Take(reader.Read<std::uint32_t>(field), field);
    }
    return reader.GetOffset() - begin;
  }
  if (type == "chlist")
  {
    while (!ReadText(reader, field + " (channel)").empty())
    {
      reader.Take(ChannelSize, field);
    }
    return reader.GetOffset() - begin;
  }
  return size;
}

// Returns whether the header held any attribute.
bool CheckAttributes(ByteReader& reader)
{
  for (bool any = false;; any = true)
  {
    const std::string_view name = ReadText(reader, "header, name of an attribute");
    if (name.empty())
    {
      return any;
    }
    const std::string field = "attribute " + Quote(name);
    const std::string_view type = ReadText(reader, field + " (type)");
    const std::size_t size = reader.Read<std::uint32_t>(field + " (size)");
    const ByteReader value = reader;
    reader.Take(size, field);
    const std::size_t expected = MeasureValue(value, type, size, field);
    value.Require(size == expected, field, "found ", size, " bytes of type ", Quote(type),
      ", expected ", expected);
  }
}
}

void CheckExrHeader(const FileBytes& file, const char* format)
{
  ByteReader reader(file, format);
  reader.Take(sizeof(ExrMagic) - 1, "magic");
  const bool multiPart = (reader.Read<std::uint32_t>("version") & MultiPartFlag) != 0;
  while (CheckAttributes(reader) && multiPart)
  {
  }
}
} // namespace measuredbrdf
