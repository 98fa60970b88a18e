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
#include <cstddef>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

namespace measuredbrdf
{
/// Text out of pieces.
class TextStream : public std::ostringstream
{
public:
  TextStream() { this->imbue(std::locale::classic()); }
};

#ifdef __cpp_lib_to_chars
inline std::string WriteNumber(double value, std::chars_format format, int digits)
{
  char text[400]; // the largest double has 309 digits before the point
  const auto end = std::to_chars(text, text + sizeof(text), value, format, digits);
  return end.ec == std::errc() ? std::string(text, end.ptr) : "?";
}

/// Reads the number that the text begins with. Returns how many characters it has, 0 if it is none.
inline std::size_t ReadNumber(std::string_view text, double& number)
{
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc() ? static_cast<std::size_t>(read.ptr - text.data()) : 0;
}
#else // GCC 10, with which the wheel for PyPI is built, has these for integers only.
inline std::string WriteNumber(double value, std::chars_format format, int digits)
{
  TextStream text;
  text.precision(digits);
  text.setf(format == std::chars_format::fixed ? std::ios::fixed : std::ios::fmtflags(),
    std::ios::floatfield);
  text << value;
  return text.str().size() < 400 ? text.str() : "?";
}

inline std::size_t ReadNumber(std::string_view text, double& number)
{
  thread_local std::istringstream stream; // a new one for each number takes five times as long
  stream.imbue(std::locale::classic());
  stream.clear();
  stream.str(std::string(text));
  if (text.empty() || text.front() == '+' || !(stream >> std::noskipws >> number))
  {
    return 0;
  }
  return stream.eof() ? text.size() : static_cast<std::size_t>(stream.tellg());
}
#endif

/// As printf's %.*g of the C locale.
inline std::string NumberText(double value, int digits = 6)
{
  return WriteNumber(value, std::chars_format::general, digits);
}

/// As printf's %.*f of the C locale.
inline std::string FixedText(double value, int decimals)
{
  return WriteNumber(value, std::chars_format::fixed, decimals);
}

/// The whole text as a finite number; false for any other.
inline bool ParseNumber(std::string_view text, double& number)
{
  if (text.size() > 1 && text.front() == '+' && text[1] != '-')
  {
    text.remove_prefix(1);
  }
  return !text.empty() && ReadNumber(text, number) == text.size() && std::isfinite(number);
}
} // namespace measuredbrdf

#endif
