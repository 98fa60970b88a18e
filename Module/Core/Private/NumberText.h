// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Numbers as text and back, the same in every locale. A host may set C's locale and C++'s: Qt and
 * GTK do, and then printf, strtod and streams write and expect commas. Shaders, files and names
 * keep the decimal point, and so do messages, which quote them.
 */

#ifndef NumberText_h
#define NumberText_h

#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

namespace measuredbrdf
{
/// As printf's %.*g of the C locale.
inline std::string NumberText(double value, int digits = 6)
{
  char text[48];
  const auto end =
    std::to_chars(text, text + sizeof(text), value, std::chars_format::general, digits);
  return end.ec == std::errc() ? std::string(text, end.ptr) : "?";
}

/// As printf's %.*f of the C locale.
inline std::string FixedText(double value, int decimals)
{
  char text[400]; // the largest double has 309 digits before the point
  const auto end =
    std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed, decimals);
  return end.ec == std::errc() ? std::string(text, end.ptr) : "?";
}

/// The whole text as a finite number; false for any other.
inline bool ParseNumber(std::string_view text, double& number)
{
  if (text.size() > 1 && text.front() == '+' && text[1] != '-')
  {
    text.remove_prefix(1);
  }
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  return read.ec == std::errc() && read.ptr == end && std::isfinite(number);
}

/// Text out of pieces.
class TextStream : public std::ostringstream
{
public:
  TextStream() { this->imbue(std::locale::classic()); }
};
} // namespace measuredbrdf

#endif
