// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WholeFile.h"

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace measuredbrdf
{
namespace
{
namespace fs = std::filesystem;

constexpr int MostLinks = 40; // as Linux follows

[[noreturn]] void FailToWrite(const std::string& path, const std::string& reason)
{
  throw std::runtime_error(path + ": cannot be written: " + reason);
}

[[noreturn]] void FailToWrite(const std::string& path)
{
  FailToWrite(path, std::generic_category().message(errno));
}

fs::path GetFolder(const fs::path& place)
{
  return place.has_parent_path() ? place.parent_path() : fs::path(".");
}

// The regular file to be made or replaced, behind links; empty: path is written to as it is, a pipe
// or a device.
fs::path FindPlace(const std::string& path)
{
  std::error_code error;
  fs::path place = path;
  const fs::file_status status = fs::status(place, error);
  if (fs::is_directory(status) || !place.has_filename())
  {
    FailToWrite(path, "it is a directory");
  }
  if (fs::exists(status) && !fs::is_regular_file(status))
  {
    return {};
  }
  // An open file, as "/dev/fd/3" and "/dev/stdout" are: others hold it open, too.
  const auto isOpenFile = [](const fs::path& link)
  {
    std::error_code ignored;
    return fs::weakly_canonical(GetFolder(link), ignored).string().rfind("/proc/", 0) == 0;
  };
  for (int links = 0; fs::is_symlink(fs::symlink_status(place, error)); ++links)
  {
    if (isOpenFile(place))
    {
      return {};
    }
    const fs::path target = fs::read_symlink(place, error);
    if (error || links == MostLinks)
    {
      FailToWrite(path, error ? error.message() : "links that lead to each other");
    }
    place = place.parent_path() / target; // that alone where it is absolute
  }
  if (!fs::is_directory(GetFolder(place), error))
  {
    FailToWrite(path, "there is no folder " + GetFolder(place).string());
  }
  return place;
}

std::string MakePartName()
{
  // Short, whatever the file's own name: names may have 255 bytes.
  std::random_device random;
  std::string name = ".";
  for (std::uint64_t bits = (std::uint64_t(random()) << 32) | random(); name.size() < 17;
       bits >>= 4)
  {
    name += "0123456789abcdef"[bits & 15];
  }
  return name + ".part";
}

// For names in a folder, which need not be readable.
#if defined(O_PATH)
constexpr int ForNames = O_PATH | O_DIRECTORY | O_CLOEXEC;
#else
constexpr int ForNames = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
#endif

// A file descriptor whose closing is checked; where it is not, an error is under way.
class OpenFile
{
public:
  explicit OpenFile(int descriptor)
    : Descriptor(descriptor)
  {
  }
  ~OpenFile()
  {
    if (this->Descriptor >= 0)
    {
      ::close(this->Descriptor);
    }
  }
  OpenFile(const OpenFile&) = delete;
  void operator=(const OpenFile&) = delete;

  bool IsOpen() const { return this->Descriptor >= 0; }
  int Get() const { return this->Descriptor; }

  bool Write(std::string_view bytes) const
  {
    while (!bytes.empty())
    {
      const ssize_t count = ::write(this->Descriptor, bytes.data(), bytes.size());
      if (count < 0 && errno != EINTR)
      {
        return false;
      }
      bytes.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
    }
    return true;
  }

  // Onto the disk; a file system that cannot tell is believed.
  bool Sync() const { return ::fsync(this->Descriptor) == 0 || errno == EINVAL; }

  bool Close()
  {
    const int descriptor = this->Descriptor;
    this->Descriptor = -1;
    return ::close(descriptor) == 0 || errno == EINTR; // it is closed then, too
  }

private:
  int Descriptor;
};

void WriteInto(const std::string& path, std::string_view bytes)
{
  OpenFile file(::open(path.c_str(), O_WRONLY | O_APPEND | O_NOCTTY | O_CLOEXEC));
  if (!file.IsOpen() || !file.Write(bytes) || !file.Close())
  {
    FailToWrite(path);
  }
}
}

//------------------------------------------------------------------------------
void CheckWritePlace(const std::string& path)
{
  const fs::path place = FindPlace(path);
  std::error_code error;
  if (!place.empty() && ::access(GetFolder(place).c_str(), W_OK) != 0)
  {
    FailToWrite(path, "its folder: " + std::generic_category().message(errno));
  }
  if ((place.empty() || fs::exists(place, error)) && ::access(path.c_str(), W_OK) != 0)
  {
    FailToWrite(path);
  }
}

//------------------------------------------------------------------------------
void WriteWholeFile(const std::string& path, std::string_view bytes)
{
  CheckWritePlace(path);
  const fs::path place = FindPlace(path);
  if (place.empty())
  {
    WriteInto(path, bytes);
    return;
  }
  // By the folder's descriptor: it stays the same folder.
  const OpenFile folder(::open(GetFolder(place).c_str(), ForNames));
  const std::string part = MakePartName();
  OpenFile file(folder.IsOpen() ? ::openat(folder.Get(), part.c_str(),
                                    O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666)
                                : -1);
  if (!file.IsOpen())
  {
    FailToWrite(path);
  }
  struct stat old;
  const std::string name = place.filename().string();
  const bool isThere = ::fstatat(folder.Get(), name.c_str(), &old, AT_SYMLINK_NOFOLLOW) == 0;
  // Some file systems have no permissions to keep.
  const bool kept = isThere && ::fchmod(file.Get(), old.st_mode & 0777) == 0;
  static_cast<void>(kept);
  if (!file.Write(bytes) || !file.Sync() || !file.Close() ||
      ::renameat(folder.Get(), part.c_str(), folder.Get(), name.c_str()) != 0)
  {
    const int reason = errno;
    ::unlinkat(folder.Get(), part.c_str(), 0);
    FailToWrite(path, std::generic_category().message(reason));
  }
  // The name, too, where the folder is readable; the file is whole either way.
  OpenFile(::openat(folder.Get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)).Sync();
}
} // namespace measuredbrdf
