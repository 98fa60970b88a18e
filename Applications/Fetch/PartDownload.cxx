// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartDownload.h"

#include "FetchFolder.h"
#include "Progress.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace
{
/// What is at the address is not what the part began with: once more from byte 0.
struct Changed
{
};

//------------------------------------------------------------------------------
std::string Bytes(std::uint64_t count) { return std::to_string(count) + " bytes"; }

//------------------------------------------------------------------------------
// 1, 2, 4 ... seconds, and less where Ctrl-C is pressed.
void Wait(int attempt)
{
  const auto end =
    std::chrono::steady_clock::now() + std::chrono::seconds(1 << std::min(attempt, 5));
  while (std::chrono::steady_clock::now() < end && !tool::Interruptible::IsInterrupted())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
PartDownload::PartDownload(const DownloadSource& source, const FetchFolder& folder, PartFile& part,
  std::function<void(double share)> progress)
  : Source(source)
  , Folder(folder)
  , Part(part)
  , Progress(std::move(progress))
{
}

//------------------------------------------------------------------------------
// Whether the part holds bytes of what is wanted, in a version that the server can be asked for.
bool PartDownload::IsOfNotes() const
{
  const PartNotes& notes = this->Part.GetNotes();
  return this->Part.GetSize() > 0 && notes.Url == this->Source.Url &&
         notes.First == this->Source.First && !notes.GetValidator().empty() &&
         (this->Source.Tag.empty() || notes.Tag == this->Source.Tag) &&
         (this->Source.Size == 0 || notes.Size == this->Source.Size);
}

//------------------------------------------------------------------------------
std::string PartDownload::DescribePlace() const
{
  const std::uint64_t expected = this->Expected > 0 ? this->Expected : this->Source.Size;
  return this->Source.Url + ", byte " + std::to_string(this->Source.First + this->Part.GetSize()) +
         (expected > 0 ? " (expected: " + Bytes(expected) + ")" : "");
}

//------------------------------------------------------------------------------
void PartDownload::Run()
{
  try
  {
    this->RunAttempts();
  }
  catch (const Error& e)
  {
    const bool kept = this->IsOfNotes();
    const std::string place = this->DescribePlace();
    const std::uint64_t size = this->Part.GetSize();
    if (!kept && size > 0)
    {
      this->Part.Begin({}); // without a tag or a date nobody can tell what else belongs to it
    }
    throw Error(
      place + ": " + e.what() +
      (kept ? ". " + Bytes(size) + " are kept; the same command goes on from there" : ""));
  }
}

//------------------------------------------------------------------------------
void PartDownload::RunAttempts()
{
  this->Resumed = this->IsOfNotes();
  for (int attempt = 0;;)
  {
    try
    {
      this->Attempt();
      return;
    }
    catch (const Changed&)
    {
      if (this->Restarted)
      {
        throw DownloadError("the file changes while it is downloaded", false);
      }
      PrintNote(this->Source.Url + " has changed since the first part of it came; beginning anew");
      this->Restarted = true;
      this->Resumed = false;
      this->Part.Begin({});
    }
    catch (const DownloadError& e)
    {
      if (!e.Transient || attempt >= this->Source.Retries)
      {
        throw;
      }
      PrintNote(this->DescribePlace() + ": " + e.what() + "; trying again");
      Wait(attempt++);
    }
  }
}

//------------------------------------------------------------------------------
void PartDownload::Attempt()
{
  const bool goesOn = this->IsOfNotes();
  if (!goesOn && this->Part.GetSize() > 0)
  {
    this->Part.Begin({});
  }
  this->Asked = this->Part.GetSize();
  this->Expected = goesOn ? this->Part.GetNotes().Size : this->Source.Size;
  if (goesOn && this->Expected > 0 && this->Asked == this->Expected)
  {
    return; // only what comes after the download was missing
  }

  HttpRequest request;
  request.Url = this->Source.Url;
  request.Timeout = this->Source.Timeout;
  request.HasRange = this->Source.IsRange || goesOn;
  request.First = this->Source.First + this->Asked;
  request.Last = this->Source.IsRange ? this->Source.First + this->Source.Size - 1 : 0;
  request.IfRange = goesOn ? this->Part.GetNotes().GetValidator() : this->Source.Tag;
  request.OnAnswer = [this](const HttpAnswer& answer) { this->TakeAnswer(answer); };
  request.OnBytes = [this](const char* bytes, std::size_t count) { this->TakeBytes(bytes, count); };
  request.Run();
  if (this->Expected > 0 && this->Part.GetSize() < this->Expected)
  {
    throw DownloadError("the connection was closed before the end", true);
  }
}

//------------------------------------------------------------------------------
void PartDownload::TakeAnswer(const HttpAnswer& answer)
{
  if (answer.Status == 416 && this->Asked > 0) // the range begins behind the end
  {
    throw Changed();
  }
  if (answer.Status != 200 && answer.Status != 206)
  {
    const bool busy = answer.Status == 408 || answer.Status == 429 || answer.Status >= 500;
    throw DownloadError("the server answered with HTTP status " + std::to_string(answer.Status) +
                          (answer.Status == 404 || answer.Status == 410 ? " (no such file)" : "") +
                          ", expected " + (this->Source.IsRange ? "206" : "200"),
      busy);
  }
  if (!answer.Encoding.empty() && answer.Encoding != "identity")
  {
    throw DownloadError(
      "the server sends the file encoded (" + answer.Encoding + "), expected it as it is", false);
  }
  answer.Status == 206 ? this->TakeRange(answer) : this->TakeWhole(answer);
}

//------------------------------------------------------------------------------
void PartDownload::TakeRange(const HttpAnswer& answer)
{
  const std::uint64_t first = this->Source.First + this->Asked;
  const auto range = ParseContentRange(answer.Range);
  const std::string wanted =
    "bytes " + std::to_string(first) + "-" +
    (this->Source.IsRange ? std::to_string(this->Source.First + this->Source.Size - 1) : "");
  if (!range || range->First != first || (!this->Source.IsRange && this->Asked == 0))
  {
    throw DownloadError("the server answered with the range '" + answer.Range + "', expected " +
                          (this->Source.IsRange || this->Asked > 0 ? wanted : "the whole file"),
      false);
  }
  const PartNotes& notes = this->Part.GetNotes();
  const bool goesOn = this->Asked > 0;
  const bool same =
    (notes.Tag.empty() || answer.Tag.empty() || answer.Tag == notes.Tag) &&
    (notes.Modified.empty() || answer.Modified.empty() || answer.Modified == notes.Modified) &&
    (notes.Total == 0 || range->Total == notes.Total);
  if (goesOn && !same)
  {
    throw Changed();
  }
  if (this->Source.Total > 0 && range->Total != this->Source.Total)
  {
    throw DownloadError("the file has " + Bytes(range->Total) + " now, expected " +
                          std::to_string(this->Source.Total),
      false);
  }
  if (!this->Source.Tag.empty() && answer.Tag != this->Source.Tag)
  {
    throw DownloadError("the archive changed between two requests", true);
  }
  if (!goesOn)
  {
    this->Begin(answer, this->Source.Size, range->Total);
  }
  this->Expected = this->Source.IsRange ? this->Source.Size : range->Total;
  this->Folder.CheckSpace(this->Expected - std::min(this->Expected, this->Asked));
}

//------------------------------------------------------------------------------
void PartDownload::TakeWhole(const HttpAnswer& answer)
{
  if (this->Source.IsRange)
  {
    throw DownloadError("the server ignores ranges: it would send all of the archive" +
                          (answer.Length ? ", " + Bytes(*answer.Length) : ""),
      false);
  }
  if (answer.Length && this->Source.Size > 0 && *answer.Length != this->Source.Size)
  {
    throw DownloadError("the server announces " + Bytes(*answer.Length) + ", expected " +
                          std::to_string(this->Source.Size),
      false);
  }
  if (answer.Length && *answer.Length > this->Source.Limit)
  {
    throw DownloadError("the server announces " + Bytes(*answer.Length) + ", expected at most " +
                          std::to_string(this->Source.Limit),
      false);
  }
  if (!answer.Length && this->Source.NeedsLength)
  {
    throw DownloadError("the server does not say how long the file is, so a cut one could not be "
                        "told from a whole one; expected a Content-Length",
      false);
  }
  if (this->Asked > 0)
  {
    PrintNote(this->Source.Url + ": the server sends all of it instead of what was missing; "
                                 "beginning anew");
    this->Resumed = false;
    this->Asked = 0;
  }
  this->Expected = this->Source.Size > 0 ? this->Source.Size : answer.Length.value_or(0);
  this->Begin(answer, this->Expected, this->Expected);
  this->Folder.CheckSpace(this->Expected);
}

//------------------------------------------------------------------------------
void PartDownload::Begin(const HttpAnswer& answer, std::uint64_t size, std::uint64_t total)
{
  PartNotes notes;
  notes.Url = this->Source.Url;
  notes.Tag = IsStrongTag(answer.Tag) ? answer.Tag : "";
  notes.Modified = answer.Modified.size() <= 64 ? answer.Modified : "";
  notes.First = this->Source.First;
  notes.Size = size;
  notes.Total = total;
  this->Part.Begin(notes);
}

//------------------------------------------------------------------------------
void PartDownload::TakeBytes(const char* bytes, std::size_t count)
{
  const std::uint64_t most = this->Expected > 0 ? this->Expected : this->Source.Limit;
  if (count > most - std::min(most, this->Part.GetSize()))
  {
    this->Part.Begin({}); // nobody knows which of these bytes are right
    throw DownloadError("the server sends more than the " + Bytes(most) + " expected", false);
  }
  this->Part.Write(bytes, count);
  if (this->Progress && most > 0)
  {
    this->Progress(static_cast<double>(this->Part.GetSize()) / static_cast<double>(most));
  }
}
} // namespace tool
