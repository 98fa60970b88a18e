// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Finds one file in a ZIP archive on a server, by a few requests for some of its bytes.
 */

#ifndef ArchiveReader_h
#define ArchiveReader_h

#include "PartDownload.h"
#include "ZipMember.h"

#include <string>

namespace tool
{
/// A member, and where its own bytes are.
struct MemberPlace
{
  ZipMember Member;
  std::uint64_t First = 0; // byte of the archive
  std::string Tag;         // the archive's strong entity tag; "": none
};

/// archive: the address, its Total and the limits of time. Throws Error that names the address.
MemberPlace FindMember(const DownloadSource& archive, const std::string& name);
} // namespace tool

#endif
