// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One GET request by libcurl: https only, few redirects, a limit of time, and Ctrl-C at any moment.
 * libcurl takes proxies from the environment, as the program curl does.
 */

#ifndef HttpRequest_h
#define HttpRequest_h

#include "Tool.h"
#include "WebAddress.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace tool
{
/// A download failed. Transient: another attempt may go better (a cut connection, a busy server).
struct DownloadError : Error
{
  DownloadError(const std::string& message, bool transient)
    : Error(message)
    , Transient(transient)
  {
  }
  bool Transient;
};

/// What a server's answer says before its bytes come.
struct HttpAnswer
{
  long Status = 0;
  std::optional<std::uint64_t> Length; // Content-Length
  std::string Range;                   // Content-Range, as it stands
  std::string Tag;                     // ETag
  std::string Modified;                // Last-Modified
  std::string Encoding;                // Content-Encoding
  std::string Location;                // of a redirect, as it stands
};

/// What is asked for.
struct HttpRequest
{
  std::string Url;
  bool HasRange = false;   // else all bytes
  std::uint64_t First = 0; // the first byte of the range,
  std::uint64_t Last = 0;  // and the last; 0: to the end
  std::string IfRange;     // a strong entity tag or a date; "": none
  int Timeout = 60;        // seconds without an answer, or with less than 1 KiB/s on average

  /// Called once, before the bytes of the last answer (redirects are followed). May throw.
  std::function<void(const HttpAnswer&)> OnAnswer;
  /// Called with the bytes. May throw.
  std::function<void(const char* bytes, std::size_t count)> OnBytes;

  /// Throws DownloadError, what the functions throw, and Error where Ctrl-C was pressed. An answer
  /// that is shorter than its Content-Length is an error.
  void Run() const;
};
} // namespace tool

#endif
