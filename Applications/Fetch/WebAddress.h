// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which addresses are downloaded from, and what a server says about ranges of bytes.
 */

#ifndef WebAddress_h
#define WebAddress_h

#include <cstdint>
#include <optional>
#include <string>

namespace tool
{
/// Whether the address may be used: https, or http on this machine (127.0.0.0/8, [::1] and
/// localhost), where nobody is in between; without a user's name.
bool IsAllowedUrl(const std::string& url);

/// Whether an address, or one without its scheme ("//user@host"), has a user's name before the
/// host.
bool HasUserName(const std::string& address);

/// The address under another beginning: base/HOST/PATH for https://HOST/PATH, as `wget
/// --force-directories` lays out a mirror.
std::string MoveToBase(const std::string& url, const std::string& base);

/// The bytes first to last of total that an answer holds.
struct ContentRange
{
  std::uint64_t First = 0;
  std::uint64_t Last = 0;
  std::uint64_t Total = 0;
};

/// "bytes 5-9/100" (RFC 9110, section 14.4); nothing where the text is not of that form, the total
/// is missing ("*"), or the numbers do not fit each other.
std::optional<ContentRange> ParseContentRange(const std::string& text);

/// Whether an entity tag names bytes exactly: RFC 9110, section 8.8.3, and not "W/...".
bool IsStrongTag(const std::string& tag);
} // namespace tool

#endif
