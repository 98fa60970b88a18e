// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What `measured-brdf fetch` knows: published materials and environments, where they are, their
 * licences and sums. The data stand in FetchCatalog.json, which the build puts into the tool.
 */

#ifndef FetchCatalog_h
#define FetchCatalog_h

#include <cstdint>
#include <string>
#include <vector>

namespace tool
{
/// Files of one source under one licence.
struct FetchCollection
{
  std::string Id;
  std::string Title;
  std::string Kind; // "material" or "environment"
  std::string Licence;
  std::string LicenceUrl;
  std::string Terms;      // in words
  std::string BeginsWith; // the first bytes of every file; "": any
};

/// One file.
struct FetchEntry
{
  std::string Name;        // what the user says
  std::string File;        // as it is called on disk
  std::string Url;         // of the file
  std::string Page;        // for people
  std::uint64_t Size = 0;  // bytes of the file; 0: not known
  std::uint64_t Limit = 0; // bytes that it cannot exceed
  std::string Sha256;      // lower case; "": not known
  std::string SumKind; // "published": by people who downloaded it there; "copy": of a copy at hand
  const FetchCollection* Collection = nullptr;
};

/// All entries, in the order of the data.
const std::vector<FetchEntry>& GetFetchCatalog();

/// The entry of that name, or whose file has that name; null if there is none.
const FetchEntry* FindFetchEntry(const std::string& name);

/// The folder that files are downloaded to unless the user names another one:
/// vtkMeasuredBRDF/vtkMeasuredBRDF-files in $XDG_CACHE_HOME or $HOME/.cache. "" where there is no
/// such folder; makes nothing.
std::string GetFetchCache();

/// The path of a file that was downloaded to that folder, or "".
std::string FindFetchedFile(const FetchEntry& entry);

/// The file to read for an argument of another command: the downloaded one where the argument is a
/// name of the catalog, of that kind ("material", "environment"), and no file of that name is
/// there; else the argument.
std::string ResolveFetched(const std::string& argument, const std::string& kind);

/// Where an argument names no file: how to get the published one of that name, as a sentence that
/// begins with a blank; "" where there is none.
std::string GetFetchAdvice(const std::string& argument, const std::string& kind);
} // namespace tool

#endif
