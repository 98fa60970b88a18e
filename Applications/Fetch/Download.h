// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Bytes from a web server, by libcurl: only https, limits of size and time, and Ctrl-C at any
 * moment. libcurl takes proxies from the environment, as the program curl does.
 */

#ifndef Download_h
#define Download_h

#include "Tool.h"

#include <cstdint>
#include <functional>
#include <string>

namespace tool
{
struct DownloadRequest
{
  std::string Url;
  std::uint64_t Limit = 0; // of the bytes that may come
  std::uint64_t Size = 0;  // of the bytes that must come; 0: not known
  int Timeout = 60;        // seconds without an answer, or with less than 1 KiB/s
  int Retries = 2;         // after a cut connection or a busy server, after 1, 2, 4 ... seconds
};

/// Appends to `bytes`, the first ones of what is wanted, those that follow. resumes: whether
/// another attempt goes on from where one stopped. `progress` gets the share that is done. Throws
/// Error.
void Download(const DownloadRequest& request, std::string& bytes, bool resumes,
  const std::function<void(double share)>& progress);

/// Whether files are downloaded from there: by https, or by http from this machine. Addresses with
/// user names are refused.
bool IsAllowedUrl(const std::string& url);
} // namespace tool

#endif
