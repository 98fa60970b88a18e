// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Sheets of labelled pictures.
 */

#ifndef Sheet_h
#define Sheet_h

#include "Picture.h"

#include <string>

namespace tool
{
constexpr RGB White = { 1.0, 1.0, 1.0 };
constexpr RGB Gray = { 0.5, 0.5, 0.52 };

/// A sheet of dark paper.
Picture MakePaper(int width, int height);

/// Put a tile with its lower left corner at (x0, y0); what lies outside the sheet is left out.
void Paste(Picture& sheet, const Picture& tile, int x0, int y0);

/// RollOff of every value.
void RollOff(Picture& picture);

/// The environment blurred and darkened: it steps back behind the objects.
Backdrop MakeQuietBackdrop(vtkEnvironment* environment);

/// Scale that makes a white diffuse ball's mean brightness under this light a light gray.
double ChooseExposure(vtkEnvironment* environment);

/// A title above columns x rows of equal tiles, each with a name and up to three lines below.
class ContactSheet
{
public:
  ContactSheet(const std::string& title, int columns, int rows, int tileWidth, int tileHeight);

  /// A tile of display light, any size up to the tiles'; row 0 is the top one.
  void Add(
    int column, int row, const Picture& tile, const std::string& name, const std::string& note);

  /// As PNG.
  void Write(const std::string& path) const;

  /// Display light, as it would be written.
  const Picture& GetPicture() const { return this->Paper; }

private:
  int TileWidth;
  int TileHeight;
  int Font;
  int Gap;
  int CaptionHeight;
  Picture Paper;
  int Top;
};
} // namespace tool

#endif
