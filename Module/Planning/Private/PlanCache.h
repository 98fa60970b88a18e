// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Files that outlive the program, found by what they were made from. They lie in a sub-folder of
 * our own (mode 0700) of the folder that is given; nothing outside it is touched, and in it only
 * regular files that bear our kind of name and begin with our magic are ever read, replaced or
 * removed. A file is whole or absent: it is written beside its place and renamed there, so that
 * programs may share a folder; a checksum guards what is read. The files used longest ago go when
 * the folder grows too large, and what programs that died left half written goes after an hour.
 * Failures are silent: a cache that cannot be used is no cache. Elsewhere than on POSIX systems
 * there is none. Private to the planning and the rendering rooms.
 */

#ifndef PlanCache_h
#define PlanCache_h

#include "ContentHash.h"

#include <cstdint>
#include <string>

class vtkEnvironment;

namespace measuredbrdf
{
/// The sub-folder of every cache folder that is our own.
constexpr const char* CacheSubfolder = "vtkMeasuredBRDF-plans";

/// An environment by its pixels.
void AddContent(ContentHash& hash, vtkEnvironment* environment);

/// What the code that makes plans and tables is: another one wherever its sources changed.
std::string GetPlanVersion();

/// The folder for this user: $MEASUREDBRDF_CACHE ("off": none), else $XDG_CACHE_HOME where that is
/// absolute, as its specification demands, else $HOME/.cache. "" where there is none.
std::string GetDefaultCacheFolder();

/// The contents of the file under a key of 32 hexadecimal digits (ContentHash), or false.
bool ReadCache(const std::string& folder, const std::string& key, std::string& contents);

/// Keep the contents under the key, and our files in the folder below maximumBytes. What lies under
/// the key and is not ours stays, and nothing is kept.
void WriteCache(const std::string& folder, const std::string& key, const std::string& contents,
  std::uint64_t maximumBytes);
} // namespace measuredbrdf

#endif
