// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FileBytes.h"

#include "WholeFile.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace measuredbrdf
{
namespace
{
std::string LastError() { return std::generic_category().message(errno); }

struct FileCloser
{
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, FileCloser>;
}

//------------------------------------------------------------------------------
void FailIn(const FileBytes& file, const std::string& format, const std::string& field,
  const std::string& what)
{
  throw FileError(file.GetPath() + ": " + format + ", " + field + ": " + what);
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
  if (path.empty())
  {
    throw FileError("no file name was given");
  }
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
  {
    throw FileError(
      path + ": " +
      (error && error != std::errc::no_such_file_or_directory ? error.message() : "no such file"));
  }
  if (std::filesystem::is_directory(status))
  {
    throw FileError(path + ": is a directory, a file was expected");
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw FileError(path + ": is not a regular file");
  }
  if (!FilePointer(std::fopen(path.c_str(), "rb")))
  {
    throw FileError(path + ": cannot be opened: " + LastError());
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error)
  {
    throw FileError(path + ": " + error.message());
  }
  if (size == 0)
  {
    throw FileError(path + ": the file is empty (0 bytes)");
  }
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
  const std::uintmax_t size = CheckFile(path);
  FilePointer file(std::fopen(path.c_str(), "rb"));
  if (!file)
  {
    throw FileError(path + ": cannot be opened: " + LastError());
  }
  const std::size_t count = static_cast<std::size_t>(size);
  this->Data.reset(new char[count]); // not filled first: it may be large
  this->Bytes = std::string_view(this->Data.get(), count);
  if (std::fread(this->Data.get(), 1, count, file.get()) != count)
  {
    throw FileError(
      path + ": could not be read whole: " +
      (std::ferror(file.get()) ? LastError() : std::string("it became shorter meanwhile")));
  }
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
void ByteReader::FailAt(
  std::uint64_t offset, const std::string& field, const std::string& what) const
{
  throw FileError(this->File.GetPath() + ": " + this->Format + ", " + field + " at byte " +
                  std::to_string(offset) + ": " + what);
}

//------------------------------------------------------------------------------
const char* ByteReader::Take(std::uint64_t count, const std::string& field)
{
  if (count > this->GetRemaining())
  {
    this->Fail(field, "needs " + std::to_string(count) + " bytes, but the file ends after " +
                        std::to_string(this->GetRemaining()));
  }
  const char* bytes = this->File.GetData() + this->Offset;
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
    this->FailAt(begin, "values",
      values + " need " + std::to_string(count) + " bytes, found " + std::to_string(found));
  }
  return bytes;
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
  const std::uint64_t size = this->File.GetSize();
  if (offset > size || count > size - offset)
  {
    this->Fail(field, "its " + std::to_string(count) + " bytes from byte " +
                        std::to_string(offset) + " reach beyond the file's end at " +
                        std::to_string(size));
  }
  return this->File.GetData() + offset;
}
} // namespace measuredbrdf
