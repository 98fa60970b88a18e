// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Brings the bytes of an address into memory, by libcurl.
 */

#ifndef Download_h
#define Download_h

#include <cstdint>
#include <string>

namespace tool
{
struct DownloadRequest
{
  std::string Name; // of the progress bar
  std::string Url;
  std::uint64_t Limit = 0; // of the bytes that may come
  std::uint64_t Size = 0;  // of the bytes that must come; 0: not known
  int Timeout = 60;        // seconds without an answer, or with less than 1 KiB/s
  int Retries = 2;         // after a cut connection or a busy server, after 1, 2, 4 ... seconds
};

/// All bytes; each attempt begins anew. Throws Error, which names the address and the byte.
std::string Download(const DownloadRequest& request);

/// Whether files are downloaded from there: by https, or by http from this machine. Addresses with
/// user names are refused.
bool IsAllowedUrl(const std::string& url);
} // namespace tool

#endif
