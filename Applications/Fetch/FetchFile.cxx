// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchFile.h"

#include "Download.h"
#include "Files.h"
#include "Progress.h"
#include "ZipMember.h"

#include <openssl/evp.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

namespace fs = std::filesystem;

namespace
{
//------------------------------------------------------------------------------
[[noreturn]] void ThrowReason(const std::string& path, const std::string& what)
{
  throw tool::Error(path + ": " + what + ": " + std::strerror(errno));
}

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
    ThrowReason(path, "can't be read");
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
    text += "0123456789abcdef"[byte / 16];
    text += "0123456789abcdef"[byte % 16];
  }
  return text;
}

//------------------------------------------------------------------------------
// The sum that was recorded for a file at its first download; "" if none was.
std::string ReadRecordedSum(const std::string& path)
{
  if (!HasFile(path + ".sha256"))
  {
    return "";
  }
  const std::string text = ReadFile(path + ".sha256");
  const std::string sum = text.substr(0, 64);
  if (!tool::IsSha256(sum) || text != sum + "  " + fs::path(path).filename().string() + "\n")
  {
    throw tool::Error(
      path + ".sha256: expected one line, the SHA-256 of " + path + " as sha256sum writes it");
  }
  return sum;
}

//------------------------------------------------------------------------------
// While one of these lives, other processes of this program that want the folder wait.
class FolderLock
{
public:
  // The other constructor makes the object whole, so that it is closed where this one throws.
  explicit FolderLock(const std::string& path)
    : FolderLock(open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
  {
    if (this->Folder < 0)
    {
      ThrowReason(path, "can't be used as a folder for downloads");
    }
    bool told = false;
    // Some network file systems lock no folders: there it is up to the user.
    while (flock(this->Folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    {
      tool::Interruptible::Check();
      tool::PrintNote(told ? "" : "another process downloads to " + path + "; waiting for it");
      told = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  ~FolderLock() { close(this->Folder); }
  FolderLock(const FolderLock&) = delete;
  void operator=(const FolderLock&) = delete;

private:
  explicit FolderLock(int folder)
    : Folder(folder)
  {
  }
  const int Folder;
};

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
    ThrowReason(path, "can't be used as a folder for downloads");
  }
  if (!S_ISDIR(status.st_mode) || status.st_uid != geteuid() ||
      (status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
  {
    throw tool::Error(path + ": not used for downloads: expected a folder of this user's to which "
                             "nobody else may write. Change that, or name a folder with --to");
  }
  return path;
}

//------------------------------------------------------------------------------
// One file on its way.
class Job
{
public:
  Job(const tool::FetchEntry& entry, const tool::FetchOptions& options);
  bool IsDone(bool tells) const;
  void CheckSumIsKnown() const;
  void Run();

  const std::string Folder;
  const std::string Path;

private:
  void ReadSum();
  tool::ZipMember FindMember(std::uint64_t& first) const;
  std::string GetPlace(std::uint64_t byte, std::uint64_t size) const;
  std::string ReadArchive(std::uint64_t first, std::uint64_t count) const;
  std::string Download(std::string& part, bool& resumed) const;
  void Check(const std::string& bytes) const;
  std::string Bring(const std::string& partPath) const;

  const tool::FetchEntry& Entry;
  const tool::FetchOptions& Options;
  const bool IsCache;
  std::string Url;
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
  , Url(entry.Url)
{
  if (const std::string& base = options.BaseUrl; !base.empty())
  {
    this->Url = base + (base.back() == '/' ? "" : "/") + entry.Url.substr(std::strlen("https://"));
  }
  if (!options.Sha256.empty())
  {
    this->Sum = options.Sha256;
    std::transform(this->Sum.begin(), this->Sum.end(), this->Sum.begin(),
      [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    this->SumFrom = "--sha256";
    if (!entry.Sha256.empty() && entry.Sha256 != this->Sum)
    {
      tool::PrintNote(
        entry.Name + ": --sha256 is used; this program knows another sum, " + entry.Sha256);
    }
  }
  else if (!entry.Sha256.empty())
  {
    this->Sum = entry.Sha256;
    this->SumFrom = entry.SumKind == "copy" ? "this program, of a copy that came from elsewhere"
                                            : "this program, as others published it";
  }
  this->ReadSum();
}

//------------------------------------------------------------------------------
// Takes the recorded sum where no other is known.
void Job::ReadSum()
{
  for (const std::string& folder : { this->Folder, tool::GetFetchCache() })
  {
    if (this->Sum.empty() && !folder.empty())
    {
      const std::string path = (fs::path(folder) / this->Entry.File).string();
      this->Sum = ReadRecordedSum(path);
      this->SumFrom = "recorded at the first download: " + path + ".sha256";
    }
  }
}

//------------------------------------------------------------------------------
// Whether the right file is there already. Throws Error where another one is in the way; tells of
// one in the cache, which is replaced.
bool Job::IsDone(bool tells) const
{
  if (!HasFile(this->Path))
  {
    return false;
  }
  if (this->Sum.empty())
  {
    if (!this->IsCache)
    {
      throw tool::Error(this->Path +
                        " is there already, and no SHA-256 is known that would tell whether it is "
                        "right. It was left alone; move it, or give its sum by --sha256");
    }
    return false;
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
  tool::PrintNote(tells ? text + ". It is downloaded anew" : "");
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
// Where a download stands; size: of the whole, 0: not known.
std::string Job::GetPlace(std::uint64_t byte, std::uint64_t size) const
{
  return this->Url + ", byte " + std::to_string(byte) +
         (size > 0 ? " (expected: " + std::to_string(size) + " bytes)" : "");
}

//------------------------------------------------------------------------------
std::string Job::ReadArchive(std::uint64_t first, std::uint64_t count) const
{
  std::string bytes;
  tool::Retry(
    this->Options.Retries,
    [&]() { return this->GetPlace(first + bytes.size(), this->Entry.ArchiveSize); },
    [&]()
    {
      bytes.clear();
      tool::Download(
        { this->Url, first, count, count, this->Options.Timeout, true },
        [&bytes](const char* data, std::size_t size) { bytes.append(data, size); }, [](double) {});
    });
  return bytes;
}

//------------------------------------------------------------------------------
// first: the byte of the archive at which the member's own bytes begin.
tool::ZipMember Job::FindMember(std::uint64_t& first) const
{
  const std::uint64_t size = this->Entry.ArchiveSize;
  const std::string tail = this->ReadArchive(size - tool::ZipTailSize, tool::ZipTailSize);
  const tool::ZipRange directory = tool::FindZipDirectory(tail, size);
  const tool::ZipMember member = tool::FindZipMember(
    this->ReadArchive(directory.First, directory.Size), this->Entry.Member, size);
  first =
    member.Header + tool::GetZipDataOffset(this->ReadArchive(member.Header, tool::ZipHeaderSize));
  if (member.Size != this->Entry.Size || member.PackedSize == 0 || member.PackedSize > member.Size)
  {
    throw tool::WrongBytes("the archive's member " + this->Entry.Member + " has " +
                           std::to_string(member.Size) + " bytes (" +
                           std::to_string(member.PackedSize) + " packed), expected " +
                           std::to_string(this->Entry.Size));
  }
  return member;
}

//------------------------------------------------------------------------------
// Completes the part, the first bytes that come from the server, and returns the file. `resumed`
// becomes true where the part had bytes before a request.
std::string Job::Download(std::string& part, bool& resumed) const
{
  const bool isMember = !this->Entry.Member.empty();
  std::uint64_t first = 0;
  const tool::ZipMember member = isMember ? this->FindMember(first) : tool::ZipMember();
  const std::uint64_t size = isMember ? member.PackedSize : this->Entry.Size;
  const std::uint64_t limit = size > 0 ? size : this->Entry.Limit;
  const auto attempt = [&]()
  {
    if (this->Sum.empty())
    {
      part.clear(); // nothing would tell whether the bytes of two requests belong together
    }
    const std::uint64_t begin = part.size();
    resumed = resumed || begin > 0;
    if (begin >= limit)
    {
      return; // the check says whether they are right
    }
    tool::ProgressBar bar(this->Entry.Name);
    const bool hasLength = tool::Download(
      { this->Url, first + begin, isMember ? limit - begin : 0, limit - begin,
        this->Options.Timeout, size > 0 },
      [&part](const char* bytes, std::size_t count) { part.append(bytes, count); },
      [&bar](double share) { bar.Update(share); });
    if (!hasLength && this->Sum.empty())
    {
      throw tool::WrongBytes("the server does not say how long the file is, so a cut one could not "
                             "be told from a whole one; expected a Content-Length");
    }
  };
  tool::Retry(
    this->Options.Retries, [&]() { return this->GetPlace(part.size(), size); }, attempt);
  return isMember ? tool::UnpackZipMember(member, part) : part;
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
  std::string part = HasFile(partPath) && !this->Sum.empty() ? ReadFile(partPath) : "";
  for (bool again = false;; again = true)
  {
    bool resumed = false;
    try
    {
      std::string content = this->Download(part, resumed);
      this->Check(content);
      return content;
    }
    catch (const tool::WrongBytes& e)
    {
      part.clear();
      unlink(partPath.c_str());
      if (!resumed || again)
      {
        throw tool::Error(this->Url + ": " + e.what() + ". Nothing was kept");
      }
      tool::PrintNote(
        this->Url + ": " + e.what() + "; an older part may be at fault, beginning anew");
    }
    catch (const tool::Error& e)
    {
      const std::string size = std::to_string(part.size());
      std::string text = this->GetPlace(part.size(), 0) + ": " + e.what();
      if (!part.empty() && !this->Sum.empty())
      {
        try
        {
          tool::WriteWhole(partPath, part);
          text += ". " + size + " bytes are kept; the same command goes on from there";
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
  const std::string cached = this->IsCache ? "" : tool::FindFetchedFile(this->Entry);
  std::string content = cached.empty() ? "" : ReadFile(cached);
  std::unique_ptr<FolderLock> lock;
  if (!cached.empty() && GetSha256(content) == this->Sum)
  {
    tool::PrintNote(this->Entry.Name + ": copied from " + cached);
  }
  else
  {
    lock = std::make_unique<FolderLock>(this->Folder);
    this->ReadSum(); // another process may have been here
    if (this->IsDone(true))
    {
      return;
    }
    content = this->Bring(part);
  }
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
bool IsSha256(const std::string& text)
{
  return text.size() == 64 && std::all_of(text.begin(), text.end(),
                                [](unsigned char c) { return std::isxdigit(c) != 0; });
}

//------------------------------------------------------------------------------
std::string FetchFile(
  const FetchEntry& entry, const FetchOptions& options, const std::function<void()>& agree)
{
  Job job(entry, options);
  if (!job.IsDone(false))
  {
    job.CheckSumIsKnown();
    agree();
    job.Run();
  }
  return job.Path;
}
} // namespace tool
