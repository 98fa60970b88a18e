// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A file that is being downloaded: .FILE.part, and beside it .FILE.part.notes, which says where the
 * bytes come from. Both stay when a download stops, and the next one goes on from there. Of several
 * processes one has the part at a time (flock); the others wait.
 */

#ifndef PartFile_h
#define PartFile_h

#include <cstddef>
#include <cstdint>
#include <string>

namespace tool
{
class FetchFolder;

/// What is known of the bytes of a part.
struct PartNotes
{
  std::string Url;
  std::string Tag;         // a strong entity tag, or ""
  std::string Modified;    // Last-Modified, or ""
  std::uint64_t First = 0; // where the part's first byte stands in what is at Url
  std::uint64_t Size = 0;  // bytes of the whole part; 0: not known
  std::uint64_t Total = 0; // bytes of what is at Url; 0: not known

  /// What If-Range takes: the tag, else the date; "" if the server gave neither.
  const std::string& GetValidator() const { return this->Tag.empty() ? this->Modified : this->Tag; }
};

class PartFile
{
public:
  /// Opens or makes the part, and waits until no other process has it. Throws Error, also where
  /// Ctrl-C was pressed meanwhile, or a file that is not ours has the name.
  PartFile(const FetchFolder& folder, const std::string& file);
  /// Removes the part where it is empty.
  ~PartFile();
  PartFile(const PartFile&) = delete;
  void operator=(const PartFile&) = delete;

  std::uint64_t GetSize() const { return this->Size; }
  std::string GetPath() const;
  const std::string& GetName() const { return this->Name; }
  int GetDescriptor() const { return this->Descriptor; }
  const PartNotes& GetNotes() const { return this->Notes; }

  /// Empty the part, for bytes of which that is known. Throws Error.
  void Begin(const PartNotes& notes);

  /// Append bytes. Throws Error: a full disk, say; what is there stays.
  void Write(const char* bytes, std::size_t count);

  /// The first bytes. Throws Error.
  std::string ReadBeginning(std::size_t count) const;

  /// Give the part the file's name, whole on disk. Throws Error.
  void Publish();

  /// Remove it.
  void Discard();

private:
  void Open();
  bool Lock();
  void ReadNotes();
  void Close();

  const FetchFolder& Folder;
  std::string File;
  std::string Name;
  std::string NotesName;
  int Descriptor = -1;
  std::uint64_t Size = 0;
  PartNotes Notes;
};
} // namespace tool

#endif
