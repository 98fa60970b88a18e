// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Text in pictures, with VTK's own font.
 */

#ifndef Lettering_h
#define Lettering_h

#include "Picture.h"

#include <string>
#include <vector>

namespace tool
{
/// Draw one line with its lower left corner at (x, y); size is the font's, in pixels. Throws Error.
void DrawText(
  Picture& picture, int x, int y, const std::string& text, int size, bool bold, const RGB& color);

/// Width of a line in pixels.
int MeasureText(const std::string& text, int size, bool bold);

/// Text cut to a width in pixels, with "..." where something is missing.
std::string Fit(const std::string& text, int size, bool bold, int width);

/// Text broken between words into lines of a width, at most so many; the last one is cut to fit.
std::vector<std::string> Wrap(const std::string& text, int size, int width, int lines);
} // namespace tool

#endif
