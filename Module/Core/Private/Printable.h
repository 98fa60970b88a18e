// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Makes text of unknown origin (a file's name or content) safe for a message: terminals execute
 * control characters, and messages must not be too long.
 */

#ifndef Printable_h
#define Printable_h

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace measuredbrdf
{
/// Largest number of bytes of a quoted name in a message, and of a whole message.
constexpr std::size_t LongestName = 200;
constexpr std::size_t LongestMessage = 8000;

/// Length of the well-formed UTF-8 character that text begins with (The Unicode Standard, table
/// 3-7), 0 where there is none; its code point.
inline std::size_t ReadUTF8(std::string_view text, unsigned int& code)
{
  const auto byte = [text](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  if (text.empty() || byte(0) < 0x80)
  {
    code = text.empty() ? 0 : byte(0);
    return text.empty() ? 0 : 1;
  }
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length)
  {
    return 0;
  }
  code = byte(0) & (0x7fu >> length);
  for (std::size_t k = 1; k < length; ++k)
  {
    if ((byte(k) & 0xc0) != 0x80)
    {
      return 0;
    }
    code = (code << 6) | (byte(k) & 0x3f);
  }
  const bool overlong = code < (length == 4 ? 0x10000u : length == 3 ? 0x800u : 0x80u);
  return overlong || code > 0x10ffff || (code >= 0xd800 && code < 0xe000) ? 0 : length;
}

/**
 * The text with \xNN for every byte that is neither printable ASCII nor part of a UTF-8 letter:
 * control characters, including Unicode's (U+0080 to U+009F, which terminals execute), and
 * characters that change the direction of writing or are invisible; '\n' and '\t' stay if multiline
 * is set. Text is cut, with "...", after `longest` bytes.
 */
inline std::string ToPrintable(
  std::string_view text, std::size_t longest = LongestMessage, bool multiline = false)
{
  const auto isHidden = [](unsigned int code)
  {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0xad ||
           (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
           (code >= 0x2060 && code <= 0x206f) || code == 0x61c || code == 0xfeff ||
           (code >= 0xfff0 && code <= 0xffff && code != 0xfffd) || code >= 0xe0000;
  };
  std::string printable;
  for (std::size_t k = 0; k < text.size();)
  {
    if (printable.size() >= longest)
    {
      return printable + "...";
    }
    unsigned int code = 0;
    const std::size_t length = ReadUTF8(text.substr(k, 4), code);
    const bool breaks = multiline && (text[k] == '\n' || text[k] == '\t');
    if (length > 0 && (breaks || !isHidden(code)))
    {
      printable.append(text.substr(k, length));
      k += length;
      continue;
    }
    for (const std::size_t end = k + (length > 0 ? length : 1); k < end; ++k)
    {
      char escaped[8];
      std::snprintf(escaped, sizeof(escaped), "\\x%02x", static_cast<unsigned char>(text[k]));
      printable += escaped;
    }
  }
  return printable;
}

/// A name in quotes, for a message.
inline std::string Quote(std::string_view name)
{
  return "'" + ToPrintable(name, LongestName) + "'";
}
} // namespace measuredbrdf

#endif
