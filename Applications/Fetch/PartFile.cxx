// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartFile.h"

#include "BoundedJson.h"
#include "FetchFolder.h"
#include "Progress.h"
#include "Tool.h"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace
{
using Json = nlohmann::json;

constexpr const char* Magic = "vtkMeasuredBRDF part 1\n"; // the number rises with the form
constexpr std::size_t LongestNotes = 8192;                // bytes
constexpr std::chrono::milliseconds Pause(100);

//------------------------------------------------------------------------------
std::string GetPartReason() { return std::strerror(errno); }

//------------------------------------------------------------------------------
std::string Format(const tool::PartNotes& notes)
{
  const Json data = { { "url", notes.Url }, { "tag", notes.Tag }, { "modified", notes.Modified },
    { "first", notes.First }, { "size", notes.Size }, { "total", notes.Total } };
  return Magic + data.dump(2, ' ', true, Json::error_handler_t::replace) + "\n";
}

//------------------------------------------------------------------------------
// Text after the magic number. Anything unusual: no notes, and the download begins anew.
tool::PartNotes Parse(const std::string& text)
{
  tool::PartNotes notes;
  try
  {
    const Json data = measuredbrdf::ParseJson<Json>(text);
    notes.Url = data.at("url");
    notes.Tag = data.at("tag");
    notes.Modified = data.at("modified");
    notes.First = data.at("first");
    notes.Size = data.at("size");
    notes.Total = data.at("total");
  }
  catch (const std::exception&)
  {
    return {};
  }
  return notes;
}
}

namespace tool
{
//------------------------------------------------------------------------------
PartFile::PartFile(const FetchFolder& folder, const std::string& file)
  : Folder(folder)
  , File(file)
  , Name("." + file + ".part")
  , NotesName(this->Name + ".notes")
{
  bool told = false;
  try
  {
    for (this->Open(); !this->Lock(); this->Open())
    {
      if (!told)
      {
        PrintNote("another process downloads " + file + "; waiting for it");
        told = true;
      }
      std::this_thread::sleep_for(Pause);
      Interruptible::Check();
    }
    this->ReadNotes();
  }
  catch (...)
  {
    this->Close();
    throw;
  }
}

//------------------------------------------------------------------------------
PartFile::~PartFile()
{
  if (this->Descriptor >= 0 && this->Size == 0)
  {
    this->Discard();
  }
  this->Close();
}

//------------------------------------------------------------------------------
void PartFile::Close()
{
  if (this->Descriptor >= 0)
  {
    close(this->Descriptor);
  }
  this->Descriptor = -1;
}

//------------------------------------------------------------------------------
std::string PartFile::GetPath() const { return this->Folder.GetPath(this->Name); }

//------------------------------------------------------------------------------
void PartFile::Open()
{
  this->Close();
  this->Folder.Has(this->Name); // an Error for anything but a regular file
  this->Descriptor = openat(this->Folder.GetDescriptor(), this->Name.c_str(),
    O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
  if (this->Descriptor < 0)
  {
    throw Error(this->GetPath() + ": can't be written: " + GetPartReason());
  }
}

//------------------------------------------------------------------------------
// False where another process has it, or had it and gave it another name or removed it.
bool PartFile::Lock()
{
  if (flock(this->Descriptor, LOCK_EX | LOCK_NB) != 0)
  {
    if (errno == EWOULDBLOCK || errno == EINTR)
    {
      return false;
    }
    throw Error(this->GetPath() + ": can't be locked: " + GetPartReason());
  }
  struct stat ours;
  struct stat named;
  if (fstat(this->Descriptor, &ours) != 0)
  {
    throw Error(this->GetPath() + ": can't be looked at: " + GetPartReason());
  }
  if (fstatat(this->Folder.GetDescriptor(), this->Name.c_str(), &named, AT_SYMLINK_NOFOLLOW) != 0 ||
      named.st_ino != ours.st_ino || named.st_dev != ours.st_dev)
  {
    return false;
  }
  if (ours.st_uid != geteuid() || ours.st_nlink != 1)
  {
    throw Error(this->GetPath() + " is in the way: expected a file of this user's with one name. "
                                  "It was left alone");
  }
  this->Size = static_cast<std::uint64_t>(ours.st_size);
  return true;
}

//------------------------------------------------------------------------------
// Notes are there before the first byte is: a part without them is somebody else's file.
void PartFile::ReadNotes()
{
  std::string text;
  if (this->Folder.Has(this->NotesName))
  {
    const int notes = openat(this->Folder.GetDescriptor(), this->NotesName.c_str(),
      O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    text.resize(LongestNotes);
    const ssize_t count = notes < 0 ? -1 : read(notes, text.data(), text.size());
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (notes >= 0)
    {
      close(notes);
    }
  }
  const std::string magic = Magic;
  if (text.compare(0, magic.size(), magic) == 0)
  {
    this->Notes = Parse(text.substr(magic.size()));
  }
  else if (this->Size > 0 || !text.empty())
  {
    if (this->Size == 0) // made just now
    {
      unlinkat(this->Folder.GetDescriptor(), this->Name.c_str(), 0);
    }
    throw Error(this->Folder.GetPath(this->Size > 0 ? this->Name : this->NotesName) +
                " is in the way: no download of this program's. It was left alone");
  }
}

//------------------------------------------------------------------------------
void PartFile::Begin(const PartNotes& notes)
{
  if (ftruncate(this->Descriptor, 0) != 0)
  {
    throw Error(this->GetPath() + ": can't be written: " + GetPartReason());
  }
  this->Size = 0;
  const std::string text = Format(notes);
  const int file = openat(this->Folder.GetDescriptor(), this->NotesName.c_str(),
    O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
  bool done =
    file >= 0 && write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  std::string reason = GetPartReason();
  if (file >= 0 && close(file) != 0 && done)
  {
    done = false;
    reason = GetPartReason();
  }
  if (!done)
  {
    throw Error(this->Folder.GetPath(this->NotesName) + ": can't be written: " + reason);
  }
  this->Notes = notes;
}

//------------------------------------------------------------------------------
void PartFile::Write(const char* bytes, std::size_t count)
{
  while (count > 0)
  {
    const ssize_t written = pwrite(this->Descriptor, bytes, count, static_cast<off_t>(this->Size));
    if (written < 0 && errno != EINTR)
    {
      throw Error(this->GetPath() + ": can't be written at byte " + std::to_string(this->Size) +
                  ": " + GetPartReason());
    }
    const auto done = static_cast<std::size_t>(std::max<ssize_t>(written, 0));
    bytes += done;
    count -= done;
    this->Size += done;
  }
}

//------------------------------------------------------------------------------
std::string PartFile::ReadBeginning(std::size_t count) const
{
  std::string text(count, '\0');
  const ssize_t got = pread(this->Descriptor, text.data(), text.size(), 0);
  if (got < 0)
  {
    throw Error(this->GetPath() + ": can't be read: " + GetPartReason());
  }
  text.resize(static_cast<std::size_t>(got));
  return text;
}

//------------------------------------------------------------------------------
void PartFile::Publish()
{
  const int folder = this->Folder.GetDescriptor();
  const char* const name = this->Name.c_str();
  const char* const file = this->File.c_str();
  bool done = fsync(this->Descriptor) == 0;
  if (done && !this->Folder.IsCache() && linkat(folder, name, folder, file, 0) == 0)
  {
    unlinkat(folder, name, 0);
  }
  else if (done)
  {
    // The cache's own file is replaced where it was damaged. In a folder of the user's nothing is,
    // also not what appeared meanwhile; some file systems have no links to tell that with.
    if (!this->Folder.IsCache() && (errno == EEXIST || this->Folder.Has(this->File)))
    {
      throw Error(this->Folder.GetPath(this->File) +
                  " appeared meanwhile. It was left alone; what was downloaded is " +
                  this->GetPath());
    }
    done = renameat(folder, name, folder, file) == 0;
  }
  if (!done)
  {
    throw Error(this->Folder.GetPath(this->File) + ": can't be written: " + GetPartReason());
  }
  fsync(folder);
  unlinkat(folder, this->NotesName.c_str(), 0);
  this->Close();
}

//------------------------------------------------------------------------------
void PartFile::Discard()
{
  unlinkat(this->Folder.GetDescriptor(), this->NotesName.c_str(), 0);
  unlinkat(this->Folder.GetDescriptor(), this->Name.c_str(), 0);
  this->Close();
}
} // namespace tool
