// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Bytes from a web server, by libcurl: only https, few redirects, limits of size and time, and
 * Ctrl-C at any moment. libcurl takes proxies from the environment, as the program curl does.
 */

#ifndef Download_h
#define Download_h

#include "Tool.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace tool
{
/// A request failed and another one may succeed: the connection was cut, or the server is busy.
struct TransientError : Error
{
  using Error::Error;
};

/// What came is not what was asked for, so that bytes from an earlier download are of no use.
struct WrongBytes : Error
{
  using Error::Error;
};

/// Which bytes are wanted, and for how long the server may be silent.
struct DownloadRequest
{
  std::string Url;
  std::uint64_t First = 0; // the first byte wanted
  std::uint64_t Count = 0; // how many; 0: all that follow
  std::uint64_t Limit = 0; // how many may come at most
  int Timeout = 60;        // seconds without an answer, or with less than 1 KiB/s
  bool IsExact = false;    // whether so many must come
};

/// Gives the bytes to `take` as they come, and to `progress` the share of this request that is
/// done. Returns whether the server said how many bytes there are. Throws TransientError,
/// WrongBytes, any other Error for a failure that lasts, and what `take` throws.
bool Download(const DownloadRequest& request,
  const std::function<void(const char* bytes, std::size_t count)>& take,
  const std::function<void(double share)>& progress);

/// Runs `attempt` again after each TransientError, up to `retries` times, after 1, 2, 4 ...
/// seconds. A note says so; it begins with the place, which is asked for after the error.
void Retry(
  int retries, const std::function<std::string()>& getPlace, const std::function<void()>& attempt);

/// Whether files are downloaded from there: by https, or by http from this machine. Addresses with
/// user names are refused.
bool IsAllowedUrl(const std::string& url);

/// Whether a server at `from` may redirect to `to`: an allowed address, by https where `from` is.
bool IsAllowedRedirect(const std::string& from, const std::string& to);
} // namespace tool

#endif
