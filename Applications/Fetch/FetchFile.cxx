// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchFile.h"

#include "Download.h"
#include "Files.h"
#include "Progress.h"

#include <minizip/unzip.h>
#include <openssl/evp.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

namespace fs = std::filesystem;

namespace
{
constexpr std::uint64_t ArchiveBlock = 4 << 20; // bytes of an archive that one request asks for

//------------------------------------------------------------------------------
// Whether a file is there. Throws Error where something else has its name.
bool HasFile(const std::string& path)
{
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
  {
    throw tool::Error(path + " is in the way: it is no regular file. It was left alone");
  }
  return fs::exists(status);
}

//------------------------------------------------------------------------------
std::string ReadFile(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  if (!file)
  {
    throw tool::Error(path + ": can't be read: " + std::strerror(errno));
  }
  return bytes;
}

//------------------------------------------------------------------------------
// The catalog's files are small: 35 MB at most.
std::string GetSha256(const std::string& bytes)
{
  unsigned char sum[32];
  if (EVP_Digest(bytes.data(), bytes.size(), sum, nullptr, EVP_sha256(), nullptr) != 1)
  {
    throw tool::Error("libcrypto gives no SHA-256");
  }
  std::string text;
  for (const unsigned char byte : sum)
  {
    char digits[3];
    std::snprintf(digits, sizeof(digits), "%02x", byte);
    text += digits;
  }
  return text;
}

//------------------------------------------------------------------------------
// The user's cache folder, made where it is missing.
std::string OpenCache()
{
  std::string path = tool::GetFetchCache();
  if (path.empty())
  {
    throw tool::Error("there is no folder for downloads (neither XDG_CACHE_HOME nor HOME is set); "
                      "name one with --to");
  }
  for (std::size_t end = 0; end != std::string::npos;)
  {
    end = path.find('/', end + 1);
    mkdir(path.substr(0, end).c_str(), 0700); // as XDG's specification says
  }
  struct stat status;
  if (lstat(path.c_str(), &status) != 0)
  {
    throw tool::Error(path + ": can't be used as a folder for downloads: " + std::strerror(errno));
  }
  if (!S_ISDIR(status.st_mode) || status.st_uid != geteuid() ||
      (status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
  {
    throw tool::Error(path + ": not used for downloads: expected a folder of this user's to which "
                             "nobody else may write. Change that, or name a folder with --to");
  }
  return path;
}

/// A ZIP archive on a server as the file that minizip reads: MERL publishes its hundred materials
/// in one archive of 1.25 GB, of which only the blocks that are read are downloaded.
struct RemoteArchive
{
  tool::DownloadRequest Request;
  std::uint64_t Size; // of the archive
  std::uint64_t At = 0;
  std::uint64_t Begin = 0; // of the block at hand
  std::string Block;
  std::exception_ptr Thrown; // waits here until minizip, which is written in C, returns
};

uLong ReadRemote(voidpf user, voidpf, void* buffer, uLong count)
{
  auto* archive = static_cast<RemoteArchive*>(user);
  uLong done = 0;
  try
  {
    while (!archive->Thrown && done < count && archive->At < archive->Size)
    {
      if (archive->At < archive->Begin || archive->At >= archive->Begin + archive->Block.size())
      {
        archive->Begin = archive->At / ArchiveBlock * ArchiveBlock;
        archive->Block.clear();
        tool::DownloadRequest request = archive->Request;
        request.Size = std::min(ArchiveBlock, archive->Size - archive->Begin);
        request.Limit = request.Size;
        request.First = archive->Begin;
        request.IsPiece = true;
        tool::Download(request, archive->Block, true, [](double) {});
      }
      const std::uint64_t skipped = archive->At - archive->Begin;
      const std::uint64_t size =
        std::min<std::uint64_t>(count - done, archive->Block.size() - skipped);
      std::memcpy(static_cast<char*>(buffer) + done, archive->Block.data() + skipped, size);
      archive->At += size;
      done += size;
    }
  }
  catch (...)
  {
    archive->Thrown = std::current_exception();
  }
  return done;
}

long SeekRemote(voidpf user, voidpf, ZPOS64_T offset, int origin)
{
  auto* archive = static_cast<RemoteArchive*>(user);
  archive->At = offset + (origin == ZLIB_FILEFUNC_SEEK_CUR    ? archive->At
                           : origin == ZLIB_FILEFUNC_SEEK_END ? archive->Size
                                                              : 0);
  return 0;
}

/// One file on its way.
class Job
{
public:
  Job(const tool::FetchEntry& entry, const tool::FetchOptions& options);
  bool IsDone() const;
  void CheckSumIsKnown() const;
  void Run();

  const std::string Folder;
  const std::string Path;

private:
  std::string DownloadMember() const;
  void Check(const std::string& bytes) const;
  std::string Bring(const std::string& partPath) const;

  const tool::FetchEntry& Entry;
  const tool::FetchOptions& Options;
  const bool IsCache;
  tool::DownloadRequest Request;
  std::string Sum;     // "": not known
  std::string SumFrom; // who says so
};

//------------------------------------------------------------------------------
Job::Job(const tool::FetchEntry& entry, const tool::FetchOptions& options)
  : Folder(options.Folder.empty() ? OpenCache() : options.Folder)
  , Path((fs::path(this->Folder) / entry.File).string())
  , Entry(entry)
  , Options(options)
  , IsCache(options.Folder.empty())
  , Request{ entry.Url, entry.Size > 0 ? entry.Size : entry.Limit, entry.Size, 0, false,
    options.Timeout, options.Retries }
  , Sum(options.Sha256)
  , SumFrom("--sha256")
{
  if (const std::string& base = options.BaseUrl; !base.empty())
  {
    this->Request.Url =
      base + (base.back() == '/' ? "" : "/") + entry.Url.substr(std::strlen("https://"));
  }
  std::transform(this->Sum.begin(), this->Sum.end(), this->Sum.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!this->Sum.empty() && !entry.Sha256.empty() && entry.Sha256 != this->Sum)
  {
    tool::PrintNote(
      entry.Name + ": --sha256 is used; this program knows another sum, " + entry.Sha256);
  }
  if (this->Sum.empty())
  {
    this->Sum = entry.Sha256;
    this->SumFrom = entry.SumKind == "copy" ? "this program, of a copy that came from elsewhere"
                                            : "this program, as others published it";
  }
  const std::string record = this->Path + ".sha256";
  if (this->Sum.empty() && HasFile(record))
  {
    this->Sum = ReadFile(record).substr(0, 64);
    this->SumFrom = "recorded at the first download: " + record;
    if (this->Sum.size() != 64)
    {
      throw tool::Error(
        record + ": expected one line, the SHA-256 of " + this->Path + " as sha256sum writes it");
    }
  }
}

//------------------------------------------------------------------------------
// Whether the right file is there already. Throws Error where another one is in the way; one in the
// cache is replaced.
bool Job::IsDone() const
{
  if (!HasFile(this->Path) || (this->Sum.empty() && this->IsCache))
  {
    return false;
  }
  if (this->Sum.empty())
  {
    throw tool::Error(this->Path +
                      " is there already, and no SHA-256 is known that would tell whether it is "
                      "right. It was left alone; move it, or give its sum by --sha256");
  }
  const std::string sum = GetSha256(ReadFile(this->Path));
  if (sum == this->Sum)
  {
    return true;
  }
  const std::string text = this->Path + " is there already with the SHA-256 " + sum +
                           ", expected " + this->Sum + " (" + this->SumFrom + ")";
  if (!this->IsCache)
  {
    throw tool::Error(text + ". It was left alone; move it, or name another folder");
  }
  tool::PrintNote(text + ". It is downloaded anew");
  return false;
}

//------------------------------------------------------------------------------
void Job::CheckSumIsKnown() const
{
  if (this->Sum.empty() && !this->Options.TrustFirst)
  {
    throw tool::Error(
      this->Entry.Name + ": this program does not know the SHA-256 of " + this->Entry.Url +
      (this->Entry.Member.empty() ? "" : ", member " + this->Entry.Member) +
      ", so it could not tell a wrong file from the right one. Give the sum by --sha256, "
      "or say --trust-first: what comes first is taken, and checked against from then on");
  }
}

//------------------------------------------------------------------------------
std::string Job::DownloadMember() const
{
  RemoteArchive archive{ this->Request, this->Entry.ArchiveSize, 0, 0, "", nullptr };
  zlib_filefunc64_def functions{};
  functions.opaque = &archive;
  functions.zopen64_file = [](voidpf user, const void*, int) -> voidpf { return user; };
  functions.zread_file = ReadRemote;
  functions.zseek64_file = SeekRemote;
  functions.ztell64_file = [](voidpf user, voidpf) -> ZPOS64_T
  { return static_cast<RemoteArchive*>(user)->At; };
  functions.zclose_file = [](voidpf, voidpf) { return 0; };
  functions.zerror_file = [](voidpf user, voidpf)
  { return static_cast<RemoteArchive*>(user)->Thrown ? 1 : 0; };

  tool::ProgressBar bar(this->Entry.Name);
  const std::unique_ptr<void, int (*)(unzFile)> zip(
    unzOpen2_64(this->Entry.Url.c_str(), &functions), unzClose);
  bool isRight = zip && unzLocateFile(zip.get(), this->Entry.Member.c_str(), 1) == UNZ_OK &&
                 unzOpenCurrentFile(zip.get()) == UNZ_OK;
  std::string content;
  std::string piece(1 << 20, '\0');
  for (int count = 1; isRight && count > 0 && content.size() <= this->Entry.Size;)
  {
    count = unzReadCurrentFile(zip.get(), piece.data(), static_cast<unsigned int>(piece.size()));
    isRight = count >= 0;
    content.append(piece, 0, static_cast<std::size_t>(std::max(count, 0)));
    bar.Update(static_cast<double>(content.size()) / static_cast<double>(this->Entry.Size));
  }
  isRight = isRight && unzCloseCurrentFile(zip.get()) == UNZ_OK; // the CRC-32
  if (archive.Thrown)
  {
    std::rethrow_exception(archive.Thrown);
  }
  if (!isRight || content.size() != this->Entry.Size)
  {
    throw tool::WrongBytes(std::string(zip ? "the ZIP archive is damaged" : "no ZIP archive") +
                           ": expected its member " + this->Entry.Member + " of " +
                           std::to_string(this->Entry.Size) + " bytes, with a right checksum");
  }
  return content;
}

//------------------------------------------------------------------------------
void Job::Check(const std::string& bytes) const
{
  const std::string& begin = this->Entry.Collection->BeginsWith;
  const std::string sum = GetSha256(bytes);
  const std::string size = "the " + std::to_string(bytes.size()) + " bytes that came";
  if (this->Sum.empty() && bytes.compare(0, begin.size(), begin) != 0)
  {
    throw tool::WrongBytes(
      size + " begin with '" + bytes.substr(0, begin.size()) + "', expected '" + begin + "'");
  }
  if (!this->Sum.empty() && sum != this->Sum)
  {
    throw tool::WrongBytes("the SHA-256 of " + size + " is " + sum + ", expected " + this->Sum +
                           " (" + this->SumFrom + ")");
  }
}

//------------------------------------------------------------------------------
// The right file. Its sum decides in the end: bytes of an earlier download that belong to another
// file cost a second download.
std::string Job::Bring(const std::string& partPath) const
{
  const bool resumes = !this->Sum.empty(); // nothing else would tell whether bytes belong together
  std::string part = HasFile(partPath) && resumes ? ReadFile(partPath) : "";
  const std::string place = this->Request.Url;
  for (;;)
  {
    const bool resumed = !part.empty();
    try
    {
      if (!this->Entry.Member.empty())
      {
        part = this->DownloadMember();
      }
      else if (part.size() < this->Request.Limit)
      {
        tool::ProgressBar bar(this->Entry.Name);
        tool::Download(this->Request, part, resumes, [&bar](double share) { bar.Update(share); });
      }
      this->Check(part);
      return part;
    }
    catch (const tool::WrongBytes& e)
    {
      part.clear();
      unlink(partPath.c_str());
      if (!resumed)
      {
        throw tool::Error(place + ": " + e.what() + ". Nothing was kept");
      }
      tool::PrintNote(place + ": " + e.what() + "; an older part may be at fault, beginning anew");
    }
    catch (const tool::Error& e)
    {
      std::string text = place + ", byte " + std::to_string(part.size()) + ": " + e.what();
      if (!part.empty() && resumes)
      {
        try
        {
          tool::WriteWhole(partPath, part);
          text += ". " + std::to_string(part.size()) +
                  " bytes are kept; the same command goes on from there";
        }
        catch (const tool::Error& failure)
        {
          text += std::string(". What came is not kept: ") + failure.what();
        }
      }
      throw tool::Error(text);
    }
  }
}

//------------------------------------------------------------------------------
void Job::Run()
{
  const std::string part =
    (fs::path(this->Folder) / ("." + this->Entry.File + ".measured-brdf-part")).string();
  tool::CheckWritable(this->Path);
  const std::string content = this->Bring(part);
  if (HasFile(this->Path) && !this->IsCache)
  {
    throw tool::Error(this->Path + " appeared meanwhile. It was left alone");
  }
  if (this->Sum.empty())
  {
    const std::string sum = GetSha256(content);
    tool::WriteWhole(this->Path + ".sha256", sum + "  " + this->Entry.File + "\n");
    tool::PrintNote(this->Entry.Name + ": trusted at first sight. Its SHA-256 is " + sum +
                    ", recorded in " + this->Path + ".sha256");
  }
  tool::WriteWhole(this->Path, content);
  unlink(part.c_str());
}
}

namespace tool
{
//------------------------------------------------------------------------------
std::string FetchFile(
  const FetchEntry& entry, const FetchOptions& options, const std::function<void()>& agree)
{
  Job job(entry, options);
  if (!job.IsDone())
  {
    job.CheckSumIsKnown();
    agree();
    job.Run();
  }
  return job.Path;
}
} // namespace tool
