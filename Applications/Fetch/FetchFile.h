// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Brings one file of the catalog into a folder. It is written, whole or not at all, once its
 * SHA-256 is right. A sum that was taken from a first download stands in FILE.sha256, as the
 * program sha256sum writes it.
 */

#ifndef FetchFile_h
#define FetchFile_h

#include "FetchCatalog.h"

#include <functional>
#include <string>

namespace tool
{
struct FetchOptions
{
  std::string Folder;  // of the user's, which must be there; "": the one in the user's cache
  std::string BaseUrl; // of a mirror; "": where the catalog says
  std::string Sha256;  // the user's own sum; "": the catalog's, or the recorded one
  bool TrustFirst = false;
  int Timeout = 60; // seconds
  int Retries = 2;
};

/// Brings the file and returns its path. `show` is called before anything is downloaded. Throws
/// Error; files that are not this program's stay as they are.
std::string FetchFile(
  const FetchEntry& entry, const FetchOptions& options, const std::function<void()>& show);
} // namespace tool

#endif
