// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ContactSheet.h"

#include "TextDrawing.h"

#include "vtkEnvironment.h"
#include "vtkMath.h"

#include <algorithm>

namespace
{
constexpr double BlurDegrees = 11.0;
constexpr double BackdropDim = 0.42;
constexpr tool::RGB PaperColor = { 0.013, 0.014, 0.017 };
}

namespace tool
{
//------------------------------------------------------------------------------
Picture MakePaper(int width, int height)
{
  Picture paper(width, height);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      paper.Blend(x, y, PaperColor, 1.0);
    }
  }
  return paper;
}

//------------------------------------------------------------------------------
void Paste(Picture& sheet, const Picture& tile, int x0, int y0)
{
  const int left = std::max(0, -x0);
  const int right = std::min(tile.Width, sheet.Width - x0);
  for (int y = std::max(0, -y0); left < right && y < std::min(tile.Height, sheet.Height - y0); ++y)
  {
    std::copy_n(
      tile.At(left, y), 4 * static_cast<std::size_t>(right - left), sheet.At(x0 + left, y0 + y));
  }
}

//------------------------------------------------------------------------------
void RollOff(Picture& picture)
{
  for (float& value : picture.Pixels)
  {
    value = static_cast<float>(RollOff(value));
  }
}

//------------------------------------------------------------------------------
Backdrop MakeQuietBackdrop(vtkEnvironment* environment)
{
  Backdrop backdrop(environment, BlurDegrees);
  backdrop.Scale(BackdropDim);
  return backdrop;
}

//------------------------------------------------------------------------------
double ChooseExposure(vtkEnvironment* environment)
{
  double total[3];
  environment->GetTotal(total);
  const double mean = vtkEnvironment::GetLuminance(total) / (4.0 * vtkMath::Pi());
  return mean > 0.0 ? 0.7 / mean : 1.0;
}

//------------------------------------------------------------------------------
ContactSheet::ContactSheet(
  const std::string& title, int columns, int rows, int tileWidth, int tileHeight)
  : TileWidth(tileWidth)
  , TileHeight(tileHeight)
  , Font(std::clamp(tileWidth / 20, 9, 24))
  , Gap(std::max(4, tileWidth / 48))
  , CaptionHeight(Font * 11 / 2)
  , Paper(MakePaper(columns * (tileWidth + Gap) + Gap,
      rows * (tileHeight + CaptionHeight + Gap) + Gap + 3 * Font))
  , Top(Paper.Height - 3 * Font)
{
  DrawText(this->Paper, this->Gap + this->Font / 2, this->Top + this->Font,
    Fit(title, this->Font * 5 / 4, false, this->Paper.Width - 2 * this->Gap - this->Font),
    this->Font * 5 / 4, false, White);
}

//------------------------------------------------------------------------------
void ContactSheet::Add(
  int column, int row, const Picture& tile, const std::string& name, const std::string& note)
{
  const int x = this->Gap + column * (this->TileWidth + this->Gap);
  const int y = this->Top - (row + 1) * (this->TileHeight + this->CaptionHeight + this->Gap);
  Paste(this->Paper, tile, x, y + this->CaptionHeight);
  const int left = x + this->Font / 3;
  const int room = this->TileWidth - this->Font / 2;
  int line = y + this->CaptionHeight - this->Font * 7 / 4;
  DrawText(this->Paper, left, line, Fit(name, this->Font, true, room), this->Font, true, White);
  const int small = std::max(8, this->Font * 4 / 5);
  for (const std::string& text : Wrap(note, small, room, 3))
  {
    line -= small * 3 / 2;
    DrawText(this->Paper, left, line, text, small, false, Gray);
  }
}

//------------------------------------------------------------------------------
void ContactSheet::Write(const std::string& path) const { WritePNG(path, this->Paper, EncodeSRGB); }
} // namespace tool
