// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Two pictures of the same size as numbers, and where they are compared.
 */

#ifndef PicturePair_h
#define PicturePair_h

#include <cstddef>
#include <string>
#include <vector>

class vtkImageData;

namespace measuredbrdf
{
/// A picture's values: integers as shares of their largest value, floats as they are.
struct PictureValues
{
  bool IsEncoded = false;       // integers, sRGB-encoded; floats are linear
  std::vector<double> Color;    // RGB
  std::vector<double> Alpha;    // of each pixel; 1 where the picture has none
  bool HasTransparency = false; // an alpha is not 1

  /// Linear RGB in front of a gray background, of 0 or 1.
  std::vector<double> GetLinear(double background) const;

  /// The same as displayed: clamped to [0,1], and sRGB-encoded.
  std::vector<double> GetDisplayed(double background) const;

  /// The same display light, in linear [0,1].
  std::vector<double> GetDisplayedLight(double background) const;

private:
  std::vector<double> Lay(double background) const;
};

/// Which pixels count.
struct PictureArea
{
  int Border = 0;
  vtkImageData* Mask = nullptr;
  bool IgnoreAlpha = false;
};

struct PicturePair
{
  int Width = 0;
  int Height = 0;
  PictureValues Picture; // the reference's values where nothing is compared
  PictureValues Reference;
  std::vector<std::size_t> Compared; // pixels

  double GetMean(const std::vector<double>& map) const;
};

/// Throws std::invalid_argument, which says what is wrong with which picture.
PicturePair MakePicturePair(
  vtkImageData* picture, vtkImageData* reference, const PictureArea& area);
} // namespace measuredbrdf

#endif
