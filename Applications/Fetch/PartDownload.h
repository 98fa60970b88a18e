// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Brings bytes from an address into a part, and goes on where an earlier download stopped. Bytes of
 * two versions of a file never meet in one part: the server is asked by If-Range, and its answer is
 * compared with the notes.
 */

#ifndef PartDownload_h
#define PartDownload_h

#include "HttpRequest.h"
#include "PartFile.h"

#include <cstdint>
#include <functional>
#include <string>

namespace tool
{
class FetchFolder;

/// What stands at an address, and which bytes of it are wanted.
struct DownloadSource
{
  std::string Url;
  bool IsRange = false; // only the bytes First to First + Size - 1 of Total; else all
  std::uint64_t First = 0;
  std::uint64_t Size = 0;  // bytes wanted; 0: not known
  std::uint64_t Total = 0; // bytes at the address; 0: not known
  std::uint64_t Limit = 0; // bytes that may come at most
  std::string Tag;         // of the version that is wanted; "": any

  bool NeedsLength = false; // whether an answer without Content-Length is refused
  int Timeout = 60;         // seconds
  int Retries = 2;          // further attempts after a cut connection or a busy server
};

class PartDownload
{
public:
  PartDownload(const DownloadSource& source, const FetchFolder& folder, PartFile& part,
    std::function<void(double share)> progress);

  /// Throws Error that names the address, the byte and what was expected; says what is kept.
  void Run();

  /// Whether earlier bytes were used.
  bool IsResumed() const { return this->Resumed; }

private:
  void Attempt();
  void RunAttempts();
  void TakeAnswer(const HttpAnswer& answer);
  void TakeRange(const HttpAnswer& answer);
  void TakeWhole(const HttpAnswer& answer);
  void TakeBytes(const char* bytes, std::size_t count);
  void Begin(const HttpAnswer& answer, std::uint64_t size, std::uint64_t total);
  bool IsOfNotes() const;
  std::string DescribePlace() const;

  DownloadSource Source;
  const FetchFolder& Folder;
  PartFile& Part;
  std::function<void(double)> Progress;
  std::uint64_t Asked = 0;    // the part's size when bytes were asked for
  std::uint64_t Expected = 0; // bytes of the whole part; 0: not known
  bool Restarted = false;
  bool Resumed = false;
};
} // namespace tool

#endif
