// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Files that outlive the program, found by what they were made from. A file is whole or absent: it
 * is written beside its place and renamed there, so that programs may share a folder; a checksum
 * guards what is read. The oldest files go when the folder grows too large. Failures are silent: a
 * cache that cannot be used is no cache. Private to the planning and the rendering rooms.
 */

#ifndef PlanCache_h
#define PlanCache_h

#include <cstdint>
#include <string>

class vtkBRDF;
class vtkEnvironment;

namespace measuredbrdf
{
/// 128 bits of whatever is put in.
class ContentHash
{
public:
  void Add(const void* data, std::size_t bytes);
  template <typename T>
  void AddValue(const T& value)
  {
    this->Add(&value, sizeof(value));
  }
  std::string GetText() const; // 32 hexadecimal digits

private:
  std::uint64_t State[2] = { 0xcbf29ce484222325u, 0x9e3779b97f4a7c15u };
};

/// A material by its values at 16384 fixed pairs, an environment by its pixels.
void AddContent(ContentHash& hash, vtkBRDF* brdf);
void AddContent(ContentHash& hash, vtkEnvironment* environment);

/// The folder for this user: $MEASUREDBRDF_CACHE ("off": none), else $XDG_CACHE_HOME or
/// $HOME/.cache. "" where there is none.
std::string GetDefaultCacheFolder();

/// The file's contents, or false.
bool ReadCache(const std::string& folder, const std::string& key, std::string& contents);

/// Keep the contents under the key, and the folder below maximumBytes.
void WriteCache(const std::string& folder, const std::string& key, const std::string& contents,
  std::uint64_t maximumBytes);
} // namespace measuredbrdf

#endif
