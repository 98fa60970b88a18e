// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The folder that downloaded files lie in: one in the user's cache folder, or one that the user
 * names. Sums that were taken from a first download stand beside the files, in the form of the
 * program sha256sum.
 */

#ifndef FetchFolder_h
#define FetchFolder_h

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace tool
{
struct FetchEntry;

class FetchFolder
{
public:
  /// vtkMeasuredBRDF/vtkMeasuredBRDF-files in $XDG_CACHE_HOME or $HOME/.cache, made where it is
  /// missing (mode 0700). Throws Error where there is no cache, or others may write to it.
  static FetchFolder OpenCache();

  /// A folder of the user's, which must be there. Throws Error.
  static FetchFolder OpenOther(const std::string& path);

  FetchFolder(FetchFolder&& other) noexcept;
  ~FetchFolder();
  FetchFolder(const FetchFolder&) = delete;
  void operator=(const FetchFolder&) = delete;

  bool IsCache() const { return this->Cache; }
  int GetDescriptor() const { return this->Descriptor; }
  std::string GetPath(const std::string& file) const;

  /// Whether something of that name is there. Throws Error where it is no regular file.
  bool Has(const std::string& file) const;

  /// The bytes of a file that is there, piece by piece. Throws Error.
  void Read(const std::string& file,
    const std::function<void(const char* bytes, std::size_t count)>& take) const;

  /// The SHA-256 of a file that is there, and its size. Throws Error.
  std::string GetSum(const std::string& file, std::uint64_t& size) const;

  ///@{
  /// The sum that was recorded for the file, "" if none was. To record one is an Error where
  /// another one stands there.
  std::string GetRecordedSum(const std::string& file) const;
  void RecordSum(const std::string& file, const std::string& sum) const;
  ///@}

  /// Throws Error where the folder's disk has less room than that.
  void CheckSpace(std::uint64_t bytes) const;

private:
  FetchFolder(const std::string& path, bool isCache);

  std::string Folder;
  bool Cache;
  int Descriptor;
};

/// The path of a file in the cache, or "" where it is not there or there is no cache. Makes
/// nothing.
std::string FindFetchedFile(const FetchEntry& entry);
} // namespace tool

#endif
