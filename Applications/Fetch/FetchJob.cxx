// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchJob.h"

#include "ArchiveReader.h"
#include "Progress.h"
#include "Sha256.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>

namespace
{
//------------------------------------------------------------------------------
std::string ToLower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

//------------------------------------------------------------------------------
// Deflated data is at most a little larger than what it holds (five bytes for each 16 KiB).
std::uint64_t GetLargestPacked(std::uint64_t size) { return size + size / 1024 + 1024; }
}

namespace tool
{
//------------------------------------------------------------------------------
FetchJob::FetchJob(const FetchEntry& entry, const FetchOptions& options, const FetchFolder& folder,
  const FetchFolder* cache)
  : Entry(entry)
  , Options(options)
  , Folder(folder)
  , Cache(cache)
  , Url(MoveToBase(entry.Url, options.BaseUrl))
{
  this->FindSum();
  if (!options.Sha256.empty() && !entry.Sha256.empty() && entry.Sha256 != this->Sum)
  {
    PrintNote(entry.Name + ": --sha256 is used; this program knows another sum, " + entry.Sha256);
  }
}

//------------------------------------------------------------------------------
void FetchJob::FindSum()
{
  const std::string& file = this->Entry.File;
  if (!this->Options.Sha256.empty())
  {
    this->Sum = ToLower(this->Options.Sha256);
    this->SumFrom = "--sha256";
  }
  else if (!this->Entry.Sha256.empty())
  {
    this->Sum = this->Entry.Sha256;
    this->SumFrom = this->Entry.SumKind == "copy"
                      ? "this program, of a copy that came from elsewhere"
                      : "this program, as others published it";
  }
  else
  {
    this->Sum = this->Folder.GetRecordedSum(file);
    this->SumFrom = "recorded at the first download: " + this->Folder.GetPath(file) + ".sha256";
    if (this->Sum.empty() && this->Cache)
    {
      this->Sum = this->Cache->GetRecordedSum(file);
      this->SumFrom = "recorded at the first download: " + this->Cache->GetPath(file) + ".sha256";
    }
  }
}

//------------------------------------------------------------------------------
bool FetchJob::IsDone() const
{
  if (!this->Folder.Has(this->Entry.File) || this->Sum.empty())
  {
    if (this->Folder.Has(this->Entry.File) && !this->Folder.IsCache())
    {
      throw Error(this->Folder.GetPath(this->Entry.File) +
                  " is there already, and no SHA-256 is known that would tell whether it is right. "
                  "It was left alone; move it, or give its sum by --sha256");
    }
    return false;
  }
  std::uint64_t size = 0;
  const std::string sum = this->Folder.GetSum(this->Entry.File, size);
  if (sum == this->Sum)
  {
    return true;
  }
  const std::string text = this->Folder.GetPath(this->Entry.File) + " is there already with " +
                           std::to_string(size) + " bytes and the SHA-256 " + sum + ", expected " +
                           this->Sum + " (" + this->SumFrom + ")";
  if (!this->Folder.IsCache())
  {
    throw Error(text + ". It was left alone; move it, or name another folder");
  }
  PrintNote(text + ". It is downloaded anew");
  return false;
}

//------------------------------------------------------------------------------
void FetchJob::CheckSumIsKnown() const
{
  if (this->Sum.empty() && !this->Options.TrustFirst)
  {
    throw Error(
      this->Entry.Name + ": this program does not know the SHA-256 of " + this->Entry.Url +
      (this->Entry.Member.empty() ? "" : ", member " + this->Entry.Member) +
      ", so it could not tell a wrong file from the right one. Give the sum by --sha256, "
      "or say --trust-first: what comes first is taken, and checked against from then on");
  }
}

//------------------------------------------------------------------------------
void FetchJob::Run()
{
  if (!this->CopyFromCache())
  {
    this->Entry.Member.empty() ? this->FetchWhole() : this->FetchMember();
  }
}

//------------------------------------------------------------------------------
// Nothing needs to be downloaded that the cache has.
bool FetchJob::CopyFromCache()
{
  const std::string& file = this->Entry.File;
  std::uint64_t size = 0;
  if (!this->Cache || this->Sum.empty() || !this->Cache->Has(file) ||
      this->Cache->GetSum(file, size) != this->Sum)
  {
    return false;
  }
  PartFile part(this->Folder, file);
  if (this->IsDone())
  {
    return true;
  }
  PartNotes notes;
  notes.Url = this->Url;
  part.Begin(notes);
  try
  {
    this->Folder.CheckSpace(size);
    this->Cache->Read(
      file, [&part](const char* bytes, std::size_t count) { part.Write(bytes, count); });
    this->Finish(part, this->Check(part));
  }
  catch (const Error&)
  {
    part.Discard();
    throw;
  }
  PrintNote(this->Entry.Name + ": copied from " + this->Cache->GetPath(file));
  return true;
}

//------------------------------------------------------------------------------
DownloadSource FetchJob::GetSource() const
{
  DownloadSource source;
  source.Url = this->Url;
  source.Size = this->Entry.Size;
  source.Limit = this->Entry.Limit;
  source.NeedsLength = this->Sum.empty();
  source.Timeout = this->Options.Timeout;
  source.Retries = this->Options.Retries;
  return source;
}

//------------------------------------------------------------------------------
void FetchJob::Download(PartFile& part, const DownloadSource& source, bool& resumed) const
{
  ProgressBar bar(this->Entry.Name);
  PartDownload download(source, this->Folder, part, [&bar](double share) { bar.Update(share); });
  download.Run();
  resumed = download.IsResumed();
}

//------------------------------------------------------------------------------
void FetchJob::FetchWhole()
{
  PartFile part(this->Folder, this->Entry.File);
  this->FindSum();
  if (this->IsDone()) // by another process, while this one waited
  {
    return;
  }
  for (bool resumed = true; resumed;)
  {
    this->Download(part, this->GetSource(), resumed);
    try
    {
      this->Finish(part, this->Check(part));
      return;
    }
    catch (const DownloadError& e)
    {
      part.Begin({}); // bytes that are wrong are of no use
      if (!resumed)
      {
        throw Error(this->Url + ": " + e.what() + ". Nothing was kept");
      }
      PrintNote(this->Url + ": " + e.what() + "; an older part may be at fault, beginning anew");
    }
  }
}

//------------------------------------------------------------------------------
void FetchJob::FetchMember()
{
  PartFile packed(this->Folder, this->Entry.File + ".packed");
  this->FindSum();
  if (this->IsDone())
  {
    return;
  }
  DownloadSource source = this->GetSource();
  source.Total = this->Entry.ArchiveSize;
  const MemberPlace place = FindMember(source, this->Entry.Member);
  const ZipMember& member = place.Member;
  if (member.Size > this->Entry.Limit ||
      (this->Entry.Size > 0 && member.Size != this->Entry.Size) ||
      member.PackedSize > GetLargestPacked(this->Entry.Limit))
  {
    throw Error(this->Url + ": the archive's member " + this->Entry.Member + " has " +
                std::to_string(member.Size) + " bytes (" + std::to_string(member.PackedSize) +
                " packed), expected " + std::to_string(this->Entry.Size));
  }
  source.IsRange = true;
  source.First = place.First;
  source.Size = member.PackedSize;
  source.Limit = member.PackedSize;
  source.Tag = place.Tag;
  bool resumed = false;
  this->Download(packed, source, resumed);

  PartFile part(this->Folder, this->Entry.File);
  try
  {
    this->Unpack(packed, member, part);
    this->Finish(part, this->Check(part));
  }
  catch (const DownloadError& e)
  {
    part.Begin({});
    packed.Begin({});
    throw Error(this->Url + ", member " + this->Entry.Member + ": " + e.what() +
                ". Nothing was kept; the same command begins anew");
  }
  packed.Discard();
}

//------------------------------------------------------------------------------
void FetchJob::Unpack(const PartFile& packed, const ZipMember& member, PartFile& part) const
{
  this->Folder.CheckSpace(member.Size);
  PartNotes notes;
  notes.Url = this->Url;
  part.Begin(notes);
  const auto write = [&part](const char* bytes, std::size_t count)
  {
    if (Interruptible::IsInterrupted())
    {
      throw Error("interrupted");
    }
    part.Write(bytes, count);
  };
  const auto read = [&packed](std::uint64_t at, char* bytes, std::size_t count)
  {
    const ssize_t got = pread(packed.GetDescriptor(), bytes, count, static_cast<off_t>(at));
    return static_cast<std::size_t>(std::max<ssize_t>(got, 0));
  };
  try
  {
    UnpackZipMember(member, read, write);
  }
  catch (const ZipError& e)
  {
    throw DownloadError(e.what(), false);
  }
  catch (const Error& e) // a full disk, or Ctrl-C
  {
    part.Begin({});
    throw Error(std::string(e.what()) + ". The download is kept in " + packed.GetPath() +
                "; the same command goes on from there");
  }
}

//------------------------------------------------------------------------------
// The sum of what came; a DownloadError where it is not the right file.
std::string FetchJob::Check(const PartFile& part) const
{
  std::uint64_t size = 0;
  const std::string sum = this->Folder.GetSum(part.GetName(), size);
  const std::string& begin = this->Entry.Collection->BeginsWith;
  if (this->Sum.empty() && part.ReadBeginning(begin.size()) != begin)
  {
    throw DownloadError("the " + std::to_string(size) + " bytes that came begin with '" +
                          part.ReadBeginning(begin.size()) + "', expected '" + begin + "'",
      false);
  }
  if (!this->Sum.empty() && sum != this->Sum)
  {
    throw DownloadError("the SHA-256 of the " + std::to_string(size) + " bytes that came is " +
                          sum + ", expected " + this->Sum + " (" + this->SumFrom + ")",
      false);
  }
  return sum;
}

//------------------------------------------------------------------------------
void FetchJob::Finish(PartFile& part, const std::string& sum) const
{
  if (this->Sum.empty())
  {
    this->Folder.RecordSum(this->Entry.File, sum);
    PrintNote(this->Entry.Name + ": trusted at first sight. Its SHA-256 is " + sum +
              ", recorded in " + this->Folder.GetPath(this->Entry.File) + ".sha256");
  }
  part.Publish();
}
} // namespace tool
