// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Private to the rendering component.
 */

#ifndef ReplacedText_h
#define ReplacedText_h

#include <cstddef>
#include <string>

namespace measuredbrdf
{
/// Returns how often from was there.
inline std::size_t ReplaceAll(std::string& text, const std::string& from, const std::string& to)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
  {
    text.replace(at, from.size(), to);
    ++count;
  }
  return count;
}
} // namespace measuredbrdf

#endif
