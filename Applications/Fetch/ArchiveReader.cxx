// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ArchiveReader.h"

#include <algorithm>

namespace
{
//------------------------------------------------------------------------------
// Some bytes of the archive; sets the tag at the first time, and wants it from then on.
std::string ReadOnce(
  const tool::DownloadSource& archive, std::uint64_t first, std::uint64_t size, std::string& tag)
{
  std::string bytes;
  tool::HttpRequest request;
  request.Url = archive.Url;
  request.Timeout = archive.Timeout;
  request.HasRange = true;
  request.First = first;
  request.Last = first + size - 1;
  request.IfRange = tag;
  request.OnAnswer = [&](const tool::HttpAnswer& answer)
  {
    const auto range = tool::ParseContentRange(answer.Range);
    if (answer.Status != 206 || !range || range->First != first || range->Last != request.Last)
    {
      throw tool::DownloadError("the server answered with HTTP status " +
                                  std::to_string(answer.Status) + " and the range '" +
                                  answer.Range + "', expected 206 and bytes " +
                                  std::to_string(first) + "-" + std::to_string(request.Last),
        answer.Status == 408 || answer.Status == 429 || answer.Status >= 500);
    }
    if (range->Total != archive.Total)
    {
      throw tool::DownloadError("the archive has " + std::to_string(range->Total) +
                                  " bytes now, expected " + std::to_string(archive.Total),
        false);
    }
    const std::string now = tool::IsStrongTag(answer.Tag) ? answer.Tag : "";
    if (!tag.empty() && now != tag)
    {
      throw tool::DownloadError("the archive changed between two requests", false);
    }
    tag = now;
  };
  request.OnBytes = [&](const char* data, std::size_t count)
  {
    if (count > size - bytes.size())
    {
      throw tool::DownloadError(
        "the server sends more than the " + std::to_string(size) + " bytes expected", false);
    }
    bytes.append(data, count);
  };
  request.Run();
  if (bytes.size() < size)
  {
    throw tool::DownloadError("the connection was closed at byte " + std::to_string(bytes.size()) +
                                " of " + std::to_string(size),
      true);
  }
  return bytes;
}

//------------------------------------------------------------------------------
std::string Read(
  const tool::DownloadSource& archive, std::uint64_t first, std::uint64_t size, std::string& tag)
{
  for (int attempt = 0;; ++attempt)
  {
    try
    {
      return ReadOnce(archive, first, size, tag);
    }
    catch (const tool::DownloadError& e)
    {
      if (!e.Transient || attempt >= archive.Retries)
      {
        throw;
      }
    }
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
MemberPlace FindMember(const DownloadSource& archive, const std::string& name)
{
  MemberPlace place;
  try
  {
    const std::uint64_t size = std::min(ZipTailSize, archive.Total);
    const std::uint64_t tailFirst = archive.Total - size;
    const std::string tail = Read(archive, tailFirst, size, place.Tag);
    const ZipDirectory directory = FindZipDirectory(tail, archive.Total);
    if (directory.Size == 0)
    {
      throw ZipError("the ZIP archive is empty");
    }
    const std::string entries = directory.First >= tailFirst
                                  ? tail.substr(directory.First - tailFirst, directory.Size)
                                  : Read(archive, directory.First, directory.Size, place.Tag);
    place.Member = FindZipMember(entries, name, archive.Total);
    place.First = place.Member.Header +
                  GetZipDataOffset(Read(archive, place.Member.Header, ZipHeaderSize, place.Tag));
    if (place.Member.PackedSize == 0 || place.First + place.Member.PackedSize > archive.Total)
    {
      throw ZipError("the ZIP archive's member " + name + " does not lie within the archive");
    }
  }
  catch (const Error& e)
  {
    throw Error(archive.Url + ": " + e.what());
  }
  return place;
}
} // namespace tool
