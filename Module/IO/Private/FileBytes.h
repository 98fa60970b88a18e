// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Files as bytes: reading them bounds-checked, so that every error names file, format, field and
 * byte; and writing them whole or not at all. Private to IO, which uses exceptions inside
 * and turns them into error events at its classes' borders.
 */

#ifndef FileBytes_h
#define FileBytes_h

#include "NumberText.h"
#include "Printable.h"
#include "vtkByteSwap.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace measuredbrdf
{
/// The pieces one after the other: texts, and numbers as NumberText(number) has them.
template <typename... Pieces>
std::string Concat(const Pieces&... pieces)
{
  TextStream text;
  (text << ... << pieces);
  return text.str();
}

/// What is wrong with a file, for people: the pieces (texts and numbers) name the file and the
/// place. Whatever the file or its name holds, the text is fit for a terminal.
class FileError : public std::runtime_error
{
public:
  template <typename... Pieces>
  explicit FileError(const Pieces&... pieces)
    : std::runtime_error(ToPrintable(Concat(pieces...)))
  {
  }
};

/// Throw FileError of the pieces unless the condition holds.
template <typename... Pieces>
void Require(bool condition, const Pieces&... pieces)
{
  if (!condition)
  {
    throw FileError(pieces...);
  }
}

/// Whether run() came back. If not, error says what it threw, and names the file: a FileError, or
/// anything else, such as that memory ran out.
bool CatchFileError(const std::string& path, std::string& error, const std::function<void()>& run);

/**
 * Size of a regular, readable file; throws FileError for what is missing, a directory, a device,
 * unreadable or empty.
 */
std::uintmax_t CheckFile(const std::string& path);

/// A file's name without folders and extension.
std::string GetFileStem(const std::string& path);

/// A file's name without folders.
std::string GetFileTitle(const std::string& path);

/// Whether these may be characters of a text in UTF-8.
bool IsText(std::string_view bytes);

/// The text behind the mark that some editors begin UTF-8 with.
inline std::string_view SkipByteOrderMark(std::string_view text)
{
  return text.substr(text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0);
}

/// As WriteWholeFile (WholeFile.h); throws FileError.
void WriteFile(const std::string& path, std::string_view bytes);

/**
 * A whole file in memory.
 */
class FileBytes
{
public:
  explicit FileBytes(const std::string& path);

  /// Bytes that stay in memory meanwhile; path: what messages call them.
  static FileBytes View(const std::string& path, std::string_view bytes);

  const std::string& GetPath() const { return this->Path; }
  std::string_view GetView() const { return this->Bytes; }

private:
  FileBytes() = default;

  std::string Path;
  std::unique_ptr<char[]> Data; // null: a view
  std::string_view Bytes;
};

/// Throw FileError: "PATH: FORMAT, FIELD: what".
template <typename... Pieces>
[[noreturn]] void FailIn(
  const FileBytes& file, const char* format, const std::string& field, const Pieces&... what)
{
  throw FileError(file.GetPath(), ": ", format, ", ", field, ": ", what...);
}

/**
 * Reads little-endian values one after the other and never beyond the end.
 */
class ByteReader
{
public:
  ByteReader(const FileBytes& file, const char* format)
    : File(file)
    , Format(format)
  {
  }

  std::size_t GetOffset() const { return this->Offset; }
  std::size_t GetRemaining() const { return this->File.GetView().size() - this->Offset; }
  const FileBytes& GetFile() const { return this->File; }

  ///@{
  /// Throw FileError: "PATH: FORMAT, FIELD at byte N: what"; Require: unless the condition holds.
  template <typename... Pieces>
  [[noreturn]] void FailAt(
    std::uint64_t offset, const std::string& field, const Pieces&... what) const
  {
    FailIn(this->File, this->Format, Concat(field, " at byte ", offset), what...);
  }
  template <typename... Pieces>
  [[noreturn]] void Fail(const std::string& field, const Pieces&... what) const
  {
    this->FailAt(this->Offset, field, what...);
  }
  template <typename... Pieces>
  void Require(bool condition, const std::string& field, const Pieces&... what) const
  {
    if (!condition)
    {
      this->Fail(field, what...);
    }
  }
  ///@}

  /// The next count bytes, stepped over.
  const char* Take(std::uint64_t count, const std::string& field);

  /// The next count bytes, behind which there is nothing but padding. values: what they are.
  const char* TakeRest(std::uint64_t count, const std::string& values);

  /// The next bytes up to the delimiter, which is stepped over with them; missing: what is wrong
  /// where there is none.
  std::string_view TakeUntil(char delimiter, const std::string& field, const char* missing);

  /// Whether at most 4 KiB of zeros, white space and DOS's end of file are left: what transfers and
  /// editors add behind the data.
  bool IsPadding() const;

  /// count bytes anywhere in the file; the reading place stays.
  const char* At(std::uint64_t offset, std::uint64_t count, const std::string& field) const;

  template <typename T>
  T Read(const std::string& field)
  {
    T value;
    Copy(&value, this->Take(sizeof(T), field), 1);
    return value;
  }

  /// Copy count values from bytes that Take or At gave.
  template <typename T>
  static void Copy(T* out, const char* bytes, std::size_t count)
  {
    std::memcpy(out, bytes, count * sizeof(T));
    if constexpr (sizeof(T) > 1)
    {
      vtkByteSwap::SwapLERange(out, count);
    }
  }

private:
  const FileBytes& File;
  const char* Format;
  std::size_t Offset = 0;
};

constexpr const char ExrMagic[] = "\x76\x2f\x31\x01";

/**
 * OpenEXR allocates what a file's header claims before it reads; this looks at the claims first.
 * The file begins with ExrMagic. Throws FileError, with the attribute and the byte, where an
 * attribute of the header claims more than the file holds. format: what the message calls the
 * file's format.
 */
void CheckExrHeader(const FileBytes& file, const char* format);
} // namespace measuredbrdf

#endif
