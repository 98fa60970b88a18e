// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanCache.h"

#include "EnvironmentPrecomputation.h"
#include "PlanVersion.h" // made of the sources that decide plans
#include "vtkEnvironment.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <random>
#include <utility>
#include <vector>

#if !defined(_WIN32)
#include <cerrno>
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace measuredbrdf
{
void AddContent(ContentHash& hash, vtkEnvironment* environment)
{
  const std::string key = environment->GetParts().GetContentKey(
    [environment]()
    {
      ContentHash pixels;
      pixels.AddValue(environment->GetWidth());
      pixels.AddValue(environment->GetHeight());
      pixels.AddValues(environment->GetPixels());
      return pixels.GetText();
    });
  hash.Add(key.data(), key.size());
}

std::string GetPlanVersion() { return MEASUREDBRDF_PLAN_VERSION; }

std::string GetDefaultCacheFolder()
{
  const char* own = std::getenv("MEASUREDBRDF_CACHE");
  if (own && *own)
  {
    return std::string(own) == "off" ? "" : own;
  }
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && *cache == '/')
  {
    return std::string(cache) + "/vtkMeasuredBRDF";
  }
  const char* home = std::getenv("HOME");
  return home && *home ? std::string(home) + "/.cache/vtkMeasuredBRDF" : "";
}

#if defined(_WIN32)
bool ReadCache(const std::string&, const std::string&, std::string&) { return false; }
void WriteCache(const std::string&, const std::string&, const std::string&, std::uint64_t) {}
#else

namespace
{
constexpr char Magic[] = "vtkMeasuredBRDF plan 1\n"; // the number rises with the format
constexpr std::size_t MagicSize = sizeof(Magic) - 1;
constexpr std::size_t KeySize = 32; // also the checksum's
constexpr std::uint64_t LargestFile = 1ull << 30;
constexpr std::time_t StaleSeconds = 3600; // of a file that nobody finished
constexpr const char* PartSuffix = ".part";

// Closes a file descriptor.
class Descriptor
{
public:
  explicit Descriptor(int descriptor)
    : Value(descriptor)
  {
  }
  Descriptor(Descriptor&& other) noexcept
    : Value(std::exchange(other.Value, -1))
  {
  }
  ~Descriptor()
  {
    if (this->Value >= 0)
    {
      ::close(this->Value);
    }
  }
  Descriptor(const Descriptor&) = delete;
  void operator=(const Descriptor&) = delete;

  explicit operator bool() const { return this->Value >= 0; }
  int Get() const { return this->Value; }

private:
  int Value;
};

std::string GetChecksum(const std::string& contents)
{
  ContentHash hash;
  hash.AddText(contents);
  return hash.GetText();
}

bool IsKey(const std::string& name)
{
  return name.size() == KeySize && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// KEY.DIGITS.part
bool IsPart(const std::string& name)
{
  const std::size_t suffix = std::strlen(PartSuffix);
  if (name.size() < KeySize + 2 + suffix || name[KeySize] != '.' ||
      name.compare(name.size() - suffix, suffix, PartSuffix) != 0)
  {
    return false;
  }
  const std::string digits = name.substr(KeySize + 1, name.size() - KeySize - 1 - suffix);
  return IsKey(name.substr(0, KeySize)) &&
         digits.find_first_not_of("0123456789") == std::string::npos;
}

// Like `mkdir -p`, for this user only, as XDG's specification says.
void MakeFolders(const std::string& path)
{
  for (std::size_t end = 0; end != std::string::npos;)
  {
    end = path.find('/', end + 1);
    ::mkdir(path.substr(0, end).c_str(), 0700);
  }
}

// Our sub-folder: a real directory of this user's, which nobody else may write to.
Descriptor OpenFolder(const std::string& folder, bool make)
{
  const std::string path = folder + "/" + CacheSubfolder;
  if (make)
  {
    MakeFolders(path);
  }
  Descriptor directory(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status;
  const bool own = directory && ::fstat(directory.Get(), &status) == 0 &&
                   status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  return own ? std::move(directory) : Descriptor(-1);
}

bool ReadAll(int file, char* bytes, std::size_t count)
{
  while (count > 0)
  {
    const ssize_t read = ::read(file, bytes, count);
    if (read <= 0 && !(read < 0 && errno == EINTR))
    {
      return false;
    }
    bytes += std::max<ssize_t>(read, 0);
    count -= static_cast<std::size_t>(std::max<ssize_t>(read, 0));
  }
  return true;
}

bool WriteAll(int file, const std::string& bytes)
{
  for (std::size_t done = 0; done < bytes.size();)
  {
    const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno != EINTR)
    {
      return false;
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(written, 0));
  }
  return true;
}

// A regular file that begins with our magic, opened behind it; its status. Looked at before it is
// opened (opening a FIFO or a device acts on others) and, since it may be exchanged in between,
// opened so that nothing waits and no link is followed.
Descriptor OpenOurs(const Descriptor& folder, const std::string& name, struct stat& status)
{
  if (::fstatat(folder.Get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 ||
      !S_ISREG(status.st_mode))
  {
    return Descriptor(-1);
  }
  Descriptor file(
    ::openat(folder.Get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  char magic[MagicSize];
  const bool ours = file && ::fstat(file.Get(), &status) == 0 && S_ISREG(status.st_mode) &&
                    ReadAll(file.Get(), magic, MagicSize) &&
                    std::memcmp(magic, Magic, MagicSize) == 0;
  return ours ? std::move(file) : Descriptor(-1);
}

std::vector<std::string> ListFolder(const Descriptor& folder)
{
  std::vector<std::string> names;
  const int copy = ::openat(folder.Get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  DIR* list = copy >= 0 ? ::fdopendir(copy) : nullptr;
  if (!list)
  {
    Descriptor close(copy);
    return names;
  }
  while (const dirent* entry = ::readdir(list))
  {
    names.push_back(entry->d_name);
  }
  ::closedir(list);
  return names;
}

std::pair<std::time_t, long> GetTime(const struct stat& status)
{
#if defined(__APPLE__)
  return { status.st_mtimespec.tv_sec, status.st_mtimespec.tv_nsec };
#else
  return { status.st_mtim.tv_sec, status.st_mtim.tv_nsec };
#endif
}

// What was used longest ago goes first. Only what is to go is opened, to see whether it is ours:
// hundreds of programs may share a folder on a server.
void Evict(const Descriptor& folder, std::uint64_t maximumBytes)
{
  struct Entry
  {
    std::pair<std::time_t, long> Time;
    std::uint64_t Size;
    std::string Name;
  };
  std::vector<Entry> entries;
  std::uint64_t total = 0;
  for (const std::string& name : ListFolder(folder))
  {
    struct stat status;
    const bool part = IsPart(name);
    if ((!part && !IsKey(name)) ||
        ::fstatat(folder.Get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 ||
        !S_ISREG(status.st_mode))
    {
      continue;
    }
    if (!part)
    {
      const std::uint64_t size = static_cast<std::uint64_t>(status.st_size);
      entries.push_back({ GetTime(status), size, name });
      total += size;
    }
    else if (GetTime(status).first + StaleSeconds < std::time(nullptr) &&
             OpenOurs(folder, name, status))
    {
      ::unlinkat(folder.Get(), name.c_str(), 0);
    }
  }
  std::sort(
    entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.Time < b.Time; });
  for (const Entry& entry : entries)
  {
    if (total <= maximumBytes)
    {
      break;
    }
    struct stat status;
    if (OpenOurs(folder, entry.Name, status))
    {
      ::unlinkat(folder.Get(), entry.Name.c_str(), 0);
    }
    total -= entry.Size; // what is not ours does not count
  }
}
}

bool ReadCache(const std::string& folder, const std::string& key, std::string& contents)
{
  const Descriptor directory = OpenFolder(folder, false);
  struct stat status;
  if (!directory || !IsKey(key))
  {
    return false;
  }
  const Descriptor file = OpenOurs(directory, key, status);
  const std::uint64_t size = file ? static_cast<std::uint64_t>(status.st_size) : 0;
  if (size < MagicSize + KeySize || size > LargestFile)
  {
    return false;
  }
  std::string checksum(KeySize, '\0');
  std::string all(static_cast<std::size_t>(size) - MagicSize - KeySize, '\0');
  if (!ReadAll(file.Get(), checksum.data(), checksum.size()) ||
      !ReadAll(file.Get(), all.data(), all.size()) || GetChecksum(all) != checksum)
  {
    return false;
  }
  ::futimens(file.Get(), nullptr); // used now
  contents.swap(all);
  return true;
}

void WriteCache(const std::string& folder, const std::string& key, const std::string& contents,
  std::uint64_t maximumBytes)
{
  const std::uint64_t size = MagicSize + KeySize + contents.size();
  if (!IsKey(key) || size > maximumBytes || size > LargestFile)
  {
    return;
  }
  const Descriptor directory = OpenFolder(folder, true);
  if (!directory)
  {
    return;
  }
  struct stat status;
  const bool taken = ::fstatat(directory.Get(), key.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
  if (taken && !OpenOurs(directory, key, status))
  {
    return;
  }
  // A name of its own, then the final one: nobody sees half a file.
  std::random_device random;
  const std::string part =
    key + "." + std::to_string(random()) + std::to_string(random()) + PartSuffix;
  {
    const Descriptor file(::openat(
      directory.Get(), part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    if (!file)
    {
      return;
    }
    // The magic and all else in one: what is left of a program that died shows whose it was.
    if (!WriteAll(file.Get(), Magic + GetChecksum(contents) + contents) || ::fsync(file.Get()) != 0)
    {
      ::unlinkat(directory.Get(), part.c_str(), 0);
      return;
    }
  }
  if (::renameat(directory.Get(), part.c_str(), directory.Get(), key.c_str()) != 0)
  {
    ::unlinkat(directory.Get(), part.c_str(), 0);
    return;
  }
  Evict(directory, maximumBytes);
}
#endif
} // namespace measuredbrdf
