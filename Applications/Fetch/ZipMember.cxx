// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ZipMember.h"

#include <zlib.h>

namespace
{
constexpr std::size_t EndSize = 22;   // of the end record, without a comment
constexpr std::size_t EntrySize = 46; // of an entry of the directory, without name and extras
constexpr std::uint64_t LargestDirectory = 1 << 22;
constexpr std::uint64_t MostDeflated =
  1032; // bytes that one deflated byte can give (zlib's manual)

//------------------------------------------------------------------------------
// An unsigned number of that many bytes, little-endian.
std::uint64_t Get(const std::string& bytes, std::size_t at, int count)
{
  std::uint64_t number = 0;
  for (int k = count - 1; k >= 0; --k)
  {
    number = number << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(k)]);
  }
  return number;
}
}

namespace tool
{
//------------------------------------------------------------------------------
ZipRange FindZipDirectory(const std::string& tail, std::uint64_t archiveSize)
{
  // The record's comment is its end, and the archive's: it tells a record from what looks like one.
  std::size_t at = tail.size() < EndSize ? std::string::npos : tail.size() - EndSize;
  for (; at != std::string::npos; at = at == 0 ? std::string::npos : at - 1)
  {
    if (tail.compare(at, 4, "PK\5\6") == 0 && at + EndSize + Get(tail, at + 20, 2) == tail.size())
    {
      break;
    }
  }
  if (at == std::string::npos)
  {
    throw WrongBytes("no ZIP archive: expected an end record in its last " +
                     std::to_string(tail.size()) + " bytes");
  }
  const ZipRange directory = { Get(tail, at + 16, 4), Get(tail, at + 12, 4) };
  const std::uint64_t end = archiveSize - tail.size() + at;
  if (Get(tail, at + 4, 4) != 0 || directory.First == 0xffffffff ||
      directory.Size > LargestDirectory || directory.First + directory.Size > end)
  {
    throw WrongBytes(
      "the ZIP archive's end record, at byte " + std::to_string(end) +
      ", is not understood: expected one disk, no ZIP64, and a directory of at most " +
      std::to_string(LargestDirectory) + " bytes before it");
  }
  return directory;
}

//------------------------------------------------------------------------------
ZipMember FindZipMember(
  const std::string& directory, const std::string& name, std::uint64_t archiveSize)
{
  std::size_t at = 0;
  while (directory.size() - at >= EntrySize)
  {
    const std::size_t nameSize = Get(directory, at + 28, 2);
    const std::size_t size =
      EntrySize + nameSize + Get(directory, at + 30, 2) + Get(directory, at + 32, 2);
    if (directory.compare(at, 4, "PK\1\2") != 0 || size > directory.size() - at)
    {
      throw WrongBytes("the ZIP archive's directory is damaged at its byte " + std::to_string(at) +
                       ": expected an entry");
    }
    if (directory.compare(at + EntrySize, nameSize, name) == 0)
    {
      const std::uint64_t method = Get(directory, at + 10, 2);
      const ZipMember member = { Get(directory, at + 42, 4), Get(directory, at + 20, 4),
        Get(directory, at + 24, 4), static_cast<std::uint32_t>(Get(directory, at + 16, 4)),
        method == 8 };
      if ((method != 0 && method != 8) || (Get(directory, at + 8, 2) & 1) != 0 ||
          member.Header + ZipHeaderSize + member.PackedSize > archiveSize)
      {
        throw WrongBytes(
          "the ZIP archive's member " + name +
          " is not understood: expected it deflated or stored, not encrypted, no ZIP64, "
          "within the archive");
      }
      return member;
    }
    at += size;
  }
  throw WrongBytes("the ZIP archive has no member " + name);
}

//------------------------------------------------------------------------------
std::uint64_t GetZipDataOffset(const std::string& header)
{
  if (header.size() < ZipHeaderSize || header.compare(0, 4, "PK\3\4") != 0)
  {
    throw WrongBytes(
      "the ZIP archive is damaged: expected a member's local header where its directory "
      "says");
  }
  return ZipHeaderSize + Get(header, 26, 2) + Get(header, 28, 2);
}

//------------------------------------------------------------------------------
std::string UnpackZipMember(const ZipMember& member, const std::string& packed)
{
  std::string content = packed;
  if (member.Deflated && member.Size <= MostDeflated * packed.size())
  {
    content.assign(member.Size, '\0');
    z_stream stream{};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(content.data());
    stream.avail_out = static_cast<uInt>(content.size());
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) // archives have no zlib header
    {
      throw Error("zlib could not be started");
    }
    const int state = inflate(&stream, Z_FINISH);
    const std::size_t missing = stream.avail_out;
    inflateEnd(&stream);
    if (state != Z_STREAM_END)
    {
      throw WrongBytes("the archive's member is damaged: its " + std::to_string(packed.size()) +
                       " packed bytes do not give the " + std::to_string(member.Size) +
                       " bytes that the directory says");
    }
    content.resize(content.size() - missing);
  }
  if (content.size() != member.Size)
  {
    throw WrongBytes("the archive's member unpacks to " + std::to_string(content.size()) +
                     " bytes; its directory says " + std::to_string(member.Size));
  }
  const auto* bytes = reinterpret_cast<const Bytef*>(content.data());
  if (crc32(crc32(0, nullptr, 0), bytes, static_cast<uInt>(content.size())) != member.Crc)
  {
    throw WrongBytes("the archive's member is damaged: its CRC-32 is not the directory's");
  }
  return content;
}
} // namespace tool
