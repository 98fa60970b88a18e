// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchFolder.h"

#include "FetchCatalog.h"
#include "Sha256.h"
#include "Tool.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace
{
constexpr const char* CacheSubfolder = "/vtkMeasuredBRDF/vtkMeasuredBRDF-files";
constexpr const char* SumSuffix = ".sha256";
constexpr std::size_t LongestRecord = 1024; // bytes

//------------------------------------------------------------------------------
std::string GetFolderReason() { return std::strerror(errno); }

//------------------------------------------------------------------------------
// $XDG_CACHE_HOME where that is absolute, as its specification demands, else $HOME/.cache.
std::string GetCachePath()
{
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && *cache == '/')
  {
    return std::string(cache) + CacheSubfolder;
  }
  const char* home = std::getenv("HOME");
  return home && *home ? std::string(home) + "/.cache" + CacheSubfolder : "";
}

//------------------------------------------------------------------------------
// Closes a file descriptor.
struct File
{
  explicit File(int descriptor)
    : Descriptor(descriptor)
  {
  }
  ~File()
  {
    if (this->Descriptor >= 0)
    {
      close(this->Descriptor);
    }
  }
  File(const File&) = delete;
  void operator=(const File&) = delete;
  int Descriptor;
};

//------------------------------------------------------------------------------
// Up to count bytes; fewer only at the end. False: it can't be read.
bool ReadUpTo(int file, char* bytes, std::size_t count, std::size_t& done)
{
  for (done = 0; done < count;)
  {
    const ssize_t got = read(file, bytes + done, count - done);
    if (got == 0)
    {
      return true;
    }
    if (got < 0 && errno != EINTR)
    {
      return false;
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(got, 0));
  }
  return true;
}

//------------------------------------------------------------------------------
// Like `mkdir -p`, for this user only, as XDG's specification says.
void MakeFolders(const std::string& path)
{
  for (std::size_t end = 0; end != std::string::npos;)
  {
    end = path.find('/', end + 1);
    mkdir(path.substr(0, end).c_str(), 0700);
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
FetchFolder::FetchFolder(const std::string& path, bool isCache)
  : Folder(path)
  , Cache(isCache)
  , Descriptor(open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | (isCache ? O_NOFOLLOW : 0)))
{
  if (this->Descriptor < 0)
  {
    throw Error(path + ": can't be used as a folder for downloads: " + GetFolderReason());
  }
}

//------------------------------------------------------------------------------
FetchFolder::FetchFolder(FetchFolder&& other) noexcept
  : Folder(std::move(other.Folder))
  , Cache(other.Cache)
  , Descriptor(std::exchange(other.Descriptor, -1))
{
}

//------------------------------------------------------------------------------
FetchFolder::~FetchFolder()
{
  if (this->Descriptor >= 0)
  {
    close(this->Descriptor);
  }
}

//------------------------------------------------------------------------------
FetchFolder FetchFolder::OpenCache()
{
  const std::string path = GetCachePath();
  if (path.empty())
  {
    throw Error("there is no folder for downloads (neither XDG_CACHE_HOME nor HOME is set); name "
                "one with --to");
  }
  MakeFolders(path);
  FetchFolder folder(path, true);
  struct stat status;
  if (fstat(folder.Descriptor, &status) != 0 || status.st_uid != geteuid() ||
      (status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
  {
    throw Error(path + ": not used for downloads: expected a folder of this user's to which nobody "
                       "else may write. Change that, or name a folder with --to");
  }
  return folder;
}

//------------------------------------------------------------------------------
FetchFolder FetchFolder::OpenOther(const std::string& path) { return FetchFolder(path, false); }

//------------------------------------------------------------------------------
std::string FetchFolder::GetPath(const std::string& file) const
{
  return (fs::path(this->Folder) / file).string();
}

//------------------------------------------------------------------------------
bool FetchFolder::Has(const std::string& file) const
{
  struct stat status;
  if (fstatat(this->Descriptor, file.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
  {
    if (errno == ENOENT)
    {
      return false;
    }
    throw Error(this->GetPath(file) + ": can't be looked at: " + GetFolderReason());
  }
  if (!S_ISREG(status.st_mode))
  {
    throw Error(this->GetPath(file) + " is in the way: it is no regular file. It was left alone");
  }
  return true;
}

//------------------------------------------------------------------------------
void FetchFolder::Read(const std::string& file,
  const std::function<void(const char* bytes, std::size_t count)>& take) const
{
  const File opened(
    openat(this->Descriptor, file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  std::vector<char> bytes(std::size_t(1) << 18);
  for (std::size_t count = bytes.size(); count == bytes.size();)
  {
    if (opened.Descriptor < 0 || !ReadUpTo(opened.Descriptor, bytes.data(), bytes.size(), count))
    {
      throw Error(this->GetPath(file) + ": can't be read: " + GetFolderReason());
    }
    take(bytes.data(), count);
  }
}

//------------------------------------------------------------------------------
std::string FetchFolder::GetSum(const std::string& file, std::uint64_t& size) const
{
  Sha256 sum;
  size = 0;
  this->Read(file,
    [&](const char* bytes, std::size_t count)
    {
      sum.Add(bytes, count);
      size += count;
    });
  return sum.GetText();
}

//------------------------------------------------------------------------------
std::string FetchFolder::GetRecordedSum(const std::string& file) const
{
  const std::string name = file + SumSuffix;
  if (!this->Has(name))
  {
    return "";
  }
  const File opened(
    openat(this->Descriptor, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  std::string text(LongestRecord, '\0');
  std::size_t count = 0;
  if (opened.Descriptor < 0 || !ReadUpTo(opened.Descriptor, text.data(), text.size(), count))
  {
    throw Error(this->GetPath(name) + ": can't be read: " + GetFolderReason());
  }
  text.resize(count);
  const std::string sum = text.substr(0, 64);
  if (!IsSha256(sum) || text != sum + "  " + file + "\n")
  {
    throw Error(this->GetPath(name) + ": expected one line, the SHA-256 of " + file +
                " as sha256sum writes it");
  }
  return sum;
}

//------------------------------------------------------------------------------
void FetchFolder::RecordSum(const std::string& file, const std::string& sum) const
{
  const std::string name = file + SumSuffix;
  const File opened(openat(
    this->Descriptor, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
  if (opened.Descriptor < 0 && errno == EEXIST)
  {
    if (this->GetRecordedSum(file) != sum)
    {
      throw Error(this->GetPath(name) + ": another sum stands there");
    }
    return;
  }
  const std::string line = sum + "  " + file + "\n";
  if (opened.Descriptor < 0 ||
      write(opened.Descriptor, line.data(), line.size()) != static_cast<ssize_t>(line.size()) ||
      fsync(opened.Descriptor) != 0)
  {
    const std::string reason = GetFolderReason();
    if (opened.Descriptor >= 0)
    {
      unlinkat(this->Descriptor, name.c_str(), 0); // made above, by nobody else
    }
    throw Error(this->GetPath(name) + ": can't be written: " + reason);
  }
}

//------------------------------------------------------------------------------
void FetchFolder::CheckSpace(std::uint64_t bytes) const
{
  std::error_code error;
  const fs::space_info space = fs::space(this->Folder, error);
  if (!error && space.available < bytes)
  {
    throw Error(this->Folder + ": the disk is full: " + std::to_string(bytes) +
                " more bytes are needed, " + std::to_string(space.available) + " are free");
  }
}

//------------------------------------------------------------------------------
std::string FindFetchedFile(const FetchEntry& entry)
{
  const std::string folder = GetCachePath();
  const std::string path = folder + "/" + entry.File;
  struct stat status;
  const bool there =
    !folder.empty() && lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
  return there ? path : "";
}
} // namespace tool
