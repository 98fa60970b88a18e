// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Brings one file of the catalog into a folder: downloaded or resumed, checked, renamed into place.
 */

#ifndef FetchJob_h
#define FetchJob_h

#include "FetchCatalog.h"
#include "FetchFolder.h"
#include "PartDownload.h"

#include <functional>
#include <string>

namespace tool
{
struct ZipMember;

struct FetchOptions
{
  std::string BaseUrl; // "": where the catalog says
  std::string Sha256;  // the user's own sum; "": the catalog's, or the recorded one
  bool TrustFirst = false;
  int Timeout = 60; // seconds
  int Retries = 2;
};

class FetchJob
{
public:
  /// cache: where the file may already be, beside the folder; may be null.
  FetchJob(const FetchEntry& entry, const FetchOptions& options, const FetchFolder& folder,
    const FetchFolder* cache);

  /// Whether the right file is there already. Throws Error where another one is in the way.
  bool IsDone() const;

  /// Throws Error where no sum is known and the options do not say what to do then.
  void CheckSumIsKnown() const;

  /// Bring the file. Throws Error; the folder is then as it was, but for a part to go on from.
  void Run();

private:
  void FindSum();
  bool CopyFromCache();
  DownloadSource GetSource() const;
  void Download(PartFile& part, const DownloadSource& source, bool& resumed) const;
  void FetchWhole();
  void FetchMember();
  void Unpack(const PartFile& packed, const ZipMember& member, PartFile& part) const;
  std::string Check(const PartFile& part) const;
  void Finish(PartFile& part, const std::string& sum) const;

  const FetchEntry& Entry;
  const FetchOptions& Options;
  const FetchFolder& Folder;
  const FetchFolder* Cache;
  std::string Url;
  std::string Sum;     // "": not known
  std::string SumFrom; // who says so
};
} // namespace tool

#endif
