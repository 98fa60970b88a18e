// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One file out of a ZIP archive of which only some bytes are at hand: MERL publishes its hundred
 * materials in one archive of 1.25 GB. The layout is that of PKWARE's APPNOTE.TXT 6.3; archives
 * above 4 GiB (ZIP64) and encrypted ones are refused.
 */

#ifndef ZipMember_h
#define ZipMember_h

#include "Download.h"

#include <cstdint>
#include <string>

namespace tool
{
/// Bytes of the archive.
struct ZipRange
{
  std::uint64_t First = 0;
  std::uint64_t Size = 0;
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

/// Bytes that hold the archive's end record, where its comment is not longer than most are.
constexpr std::uint64_t ZipTailSize = 1 << 16;
/// Bytes of a local header without the name.
constexpr std::uint64_t ZipHeaderSize = 30;

///@{
/// All of these throw WrongBytes where the archive is not as it should be: they find the directory
/// in the archive's last bytes, a member in the directory's bytes, and the number of bytes from the
/// begin of a local header to the member's own.
ZipRange FindZipDirectory(const std::string& tail, std::uint64_t archiveSize);
ZipMember FindZipMember(
  const std::string& directory, const std::string& name, std::uint64_t archiveSize);
std::uint64_t GetZipDataOffset(const std::string& header);
///@}

/// The file, from its packed bytes; its size and CRC-32 are checked. Throws WrongBytes.
std::string UnpackZipMember(const ZipMember& member, const std::string& packed);
} // namespace tool

#endif
