// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WholeFile.h"

#include <vtksys/SystemTools.hxx>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>
#include <stdexcept>
#include <system_error>

#if !defined(_WIN32)
#include <unistd.h>
#endif

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

// The regular file to be made or replaced, behind links; empty: path is written to as it is, a
// pipe, a device or, as "/dev/fd/3" and "/dev/stdout" lead to, an open file: others hold it open,
// too.
fs::path FindPlace(const std::string& path)
{
  std::error_code error;
  fs::path place = path;
  const fs::file_status status = fs::status(place, error);
  if (fs::is_directory(status) || !place.has_filename())
  {
    FailToWrite(path, "it is a directory");
  }
  bool isPlace = !fs::exists(status) || fs::is_regular_file(status);
  for (int links = 0; isPlace && fs::is_symlink(fs::symlink_status(place, error)); ++links)
  {
    const fs::path target = fs::read_symlink(place, error);
    if (error || links == MostLinks)
    {
      FailToWrite(path, error ? error.message() : "links that lead to each other");
    }
    const std::string folder = fs::weakly_canonical(GetFolder(place), error).string() + "/";
    isPlace = folder.rfind("/proc/", 0) != 0;
    place = place.parent_path() / target; // that alone where it is absolute
  }
  if (isPlace && !fs::is_directory(GetFolder(place), error))
  {
    FailToWrite(path, "there is no folder " + GetFolder(place).string());
  }
  return isPlace ? place : fs::path();
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

// Onto the disk; a file system that cannot tell is believed.
bool Sync([[maybe_unused]] std::FILE* file)
{
#if defined(_WIN32)
  return true;
#else
  return ::fsync(::fileno(file)) == 0 || errno == EINVAL;
#endif
}

// mode: fopen's. Whether all went well; if not, errno says what. Closing counts, too: file systems
// on a network and quotas may tell then only.
bool WriteTo(const std::string& path, const char* mode, std::string_view bytes, bool onDisk)
{
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
    std::fopen(path.c_str(), mode), [](std::FILE* open) { return std::fclose(open); });
  return file && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
         std::fflush(file.get()) == 0 && (!onDisk || Sync(file.get())) &&
         std::fclose(file.release()) == 0;
}
}

//------------------------------------------------------------------------------
void CheckWritePlace(const std::string& path)
{
  const fs::path place = FindPlace(path);
  std::error_code error;
  const auto isWritable = [](const std::string& name)
  { return vtksys::SystemTools::TestFileAccess(name, vtksys::TEST_FILE_WRITE); };
  if (!place.empty() && !isWritable(GetFolder(place).string()))
  {
    FailToWrite(path, "its folder: " + std::generic_category().message(errno));
  }
  if ((place.empty() || fs::exists(place, error)) && !isWritable(path))
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
    if (!WriteTo(path, "ab", bytes, false))
    {
      FailToWrite(path);
    }
    return;
  }
  const fs::path part = GetFolder(place) / MakePartName();
  std::error_code error;
  const fs::file_status old = fs::symlink_status(place, error);
  bool isWritten = WriteTo(part.string(), "wbx", {}, false);
  if (isWritten && fs::exists(old)) // some file systems have no permissions to keep
  {
    fs::permissions(part, old.permissions() & fs::perms(0777), error); // before others can read it
  }
  isWritten = isWritten && WriteTo(part.string(), "wb", bytes, true);
  const std::error_code written(errno, std::generic_category());
  error.clear();
  if (isWritten)
  {
    fs::rename(part, place, error);
  }
  if (!isWritten || error)
  {
    std::error_code ignored;
    fs::remove(part, ignored);
    FailToWrite(path, (isWritten ? error : written).message());
  }
}
} // namespace measuredbrdf
