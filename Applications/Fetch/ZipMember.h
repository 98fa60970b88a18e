// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One file in a ZIP archive of which only some bytes are at hand: where it lies, and how its bytes
 * become the file. The layout is that of PKWARE's APPNOTE.TXT 6.3; archives above 4 GiB (ZIP64) and
 * encrypted ones are refused.
 */

#ifndef ZipMember_h
#define ZipMember_h

#include "Tool.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace tool
{
/// The archive is not as it should be.
struct ZipError : Error
{
  using Error::Error;
};

/// Where the archive's directory lies.
struct ZipDirectory
{
  std::uint64_t First = 0; // byte of the archive
  std::uint64_t Size = 0;  // bytes
};

/// Where a member lies, and what it must give.
struct ZipMember
{
  std::uint64_t Header = 0;     // byte of the archive at which its local header begins
  std::uint64_t PackedSize = 0; // bytes in the archive
  std::uint64_t Size = 0;       // bytes of the file
  std::uint32_t Crc = 0;
  bool Deflated = true; // else stored as it is
};

/// Bytes that hold the end record, if there is no comment longer than most are.
constexpr std::uint64_t ZipTailSize = 1 << 16;
/// Bytes of a local header without the name.
constexpr std::uint64_t ZipHeaderSize = 30;
/// The largest directory that is read, in bytes.
constexpr std::uint64_t LargestZipDirectory = 1 << 22;

/// The directory, from the archive's last bytes. Throws ZipError.
ZipDirectory FindZipDirectory(const std::string& tail, std::uint64_t archiveSize);

/// A member by its name, from the directory's bytes. Throws ZipError.
ZipMember FindZipMember(
  const std::string& directory, const std::string& name, std::uint64_t archiveSize);

/// The bytes from the begin of a local header to the member's own bytes. Throws ZipError.
std::uint64_t GetZipDataOffset(const std::string& header);

/// The file's bytes, piece by piece. read gives up to count bytes at a place in the packed ones.
/// Throws ZipError where they do not give the size and the CRC of the member, before more than the
/// size was written.
void UnpackZipMember(const ZipMember& member,
  const std::function<std::size_t(std::uint64_t at, char* bytes, std::size_t count)>& read,
  const std::function<void(const char* bytes, std::size_t count)>& write);
} // namespace tool

#endif
