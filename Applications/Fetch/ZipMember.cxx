// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ZipMember.h"

#include <zlib.h>

#include <algorithm>
#include <vector>

namespace
{
constexpr std::size_t EndSize = 22;   // of the end record, without a comment
constexpr std::size_t EntrySize = 46; // of an entry of the directory, without name and extras
constexpr std::size_t PieceSize = 1 << 16;

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

//------------------------------------------------------------------------------
struct Inflater
{
  Inflater()
  {
    if (inflateInit2(&this->Stream, -MAX_WBITS) != Z_OK) // no zlib header in archives
    {
      throw tool::Error("zlib could not be started");
    }
  }
  ~Inflater() { inflateEnd(&this->Stream); }
  Inflater(const Inflater&) = delete;
  void operator=(const Inflater&) = delete;

  z_stream Stream{};
};

//------------------------------------------------------------------------------
// Takes the file's bytes; no more than there may be.
class Checked
{
public:
  Checked(const tool::ZipMember& member, const std::function<void(const char*, std::size_t)>& write)
    : Member(member)
    , Out(write)
  {
  }

  void Write(const char* bytes, std::size_t count)
  {
    if (count > this->Member.Size - this->Done)
    {
      throw tool::ZipError("the archive's member unpacks to more than the " +
                           std::to_string(this->Member.Size) + " bytes that the directory says");
    }
    this->Crc = crc32(this->Crc, reinterpret_cast<const Bytef*>(bytes), static_cast<uInt>(count));
    this->Out(bytes, count);
    this->Done += count;
  }

  void Finish() const
  {
    if (this->Done != this->Member.Size)
    {
      throw tool::ZipError("the archive's member unpacks to " + std::to_string(this->Done) +
                           " bytes; its directory says " + std::to_string(this->Member.Size));
    }
    if (this->Crc != this->Member.Crc)
    {
      throw tool::ZipError("the archive's member is damaged: its CRC-32 is not the directory's");
    }
  }

private:
  const tool::ZipMember& Member;
  const std::function<void(const char*, std::size_t)>& Out;
  std::uint64_t Done = 0;
  uLong Crc = crc32(0, nullptr, 0);
};
}

namespace tool
{
//------------------------------------------------------------------------------
ZipDirectory FindZipDirectory(const std::string& tail, std::uint64_t archiveSize)
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
    throw ZipError("no ZIP archive: expected an end record in its last " +
                   std::to_string(tail.size()) + " bytes");
  }
  const ZipDirectory directory = { Get(tail, at + 16, 4), Get(tail, at + 12, 4) };
  const std::uint64_t end = archiveSize - tail.size() + at;
  if (Get(tail, at + 4, 4) != 0 || directory.First == 0xffffffff ||
      directory.Size > LargestZipDirectory || directory.First + directory.Size > end)
  {
    throw ZipError("the ZIP archive's end record, at byte " + std::to_string(end) +
                   ", is not understood: expected one disk, no ZIP64, and a directory of at most " +
                   std::to_string(LargestZipDirectory) + " bytes before it");
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
      throw ZipError("the ZIP archive's directory is damaged at its byte " + std::to_string(at) +
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
        throw ZipError(
          "the ZIP archive's member " + name +
          " is not understood: expected it deflated or stored, not encrypted, no ZIP64, "
          "within the archive");
      }
      return member;
    }
    at += size;
  }
  throw ZipError("the ZIP archive has no member " + name);
}

//------------------------------------------------------------------------------
std::uint64_t GetZipDataOffset(const std::string& header)
{
  if (header.size() < ZipHeaderSize || header.compare(0, 4, "PK\3\4") != 0)
  {
    throw ZipError(
      "the ZIP archive is damaged: expected a member's local header where its directory "
      "says");
  }
  return ZipHeaderSize + Get(header, 26, 2) + Get(header, 28, 2);
}

//------------------------------------------------------------------------------
void UnpackZipMember(const ZipMember& member,
  const std::function<std::size_t(std::uint64_t at, char* bytes, std::size_t count)>& read,
  const std::function<void(const char* bytes, std::size_t count)>& write)
{
  Checked out(member, write);
  Inflater inflater;
  z_stream& stream = inflater.Stream;
  std::vector<char> packed(PieceSize);
  std::vector<char> unpacked(PieceSize);
  int state = Z_OK;
  for (std::uint64_t at = 0; at < member.PackedSize && state != Z_STREAM_END;)
  {
    const std::size_t count = read(at, packed.data(),
      static_cast<std::size_t>(std::min<std::uint64_t>(packed.size(), member.PackedSize - at)));
    if (count == 0)
    {
      break;
    }
    at += count;
    if (!member.Deflated)
    {
      out.Write(packed.data(), count);
      continue;
    }
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(count);
    do
    {
      stream.next_out = reinterpret_cast<Bytef*>(unpacked.data());
      stream.avail_out = static_cast<uInt>(unpacked.size());
      state = inflate(&stream, Z_NO_FLUSH);
      if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
      {
        throw ZipError("the archive's member is damaged within its first " + std::to_string(at) +
                       " packed bytes: " + (stream.msg ? stream.msg : "no deflated data"));
      }
      out.Write(unpacked.data(), unpacked.size() - stream.avail_out);
    } while (stream.avail_out == 0 && state != Z_STREAM_END);
  }
  out.Finish();
}
} // namespace tool
