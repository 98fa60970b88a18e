// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The one way to read an image file: environments, pictures, photographs and weights. Its pixels
 * are as its header says that they are to be seen: turned, cut to the display window, divided by
 * the exposure, in Rec. 709.
 */

#ifndef ImageFile_h
#define ImageFile_h

#include <cstdint>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// What OpenEXR's envmap attribute says that an image is.
enum class ImageEnvmap
{
  None,
  LatLong,
  Cube
};

struct ImageFile
{
  int Width = 0;
  int Height = 0;
  int Channels = 0;       // 3, or 1: of each texel's color only the first value is set
  bool HasAlpha = false;  // the value after the color's, where it was asked for
  bool IsEncoded = false; // integers that are not said to be linear
  bool IsInteger = false; // else floats
  bool HasBytes = false;  // integers of 8 bits
  ImageEnvmap Envmap = ImageEnvmap::None;
  std::vector<std::string> Notes; // for people: what was chosen or lost
  std::vector<float> Pixels;      // 3 values a texel, 4 where alpha was asked for; top row first
};

/// What to read of each texel.
enum class ImageValues
{
  Color,
  ColorAndAlpha // not multiplied into integers' colors; OpenEXR's colors keep it
};

/**
 * Read an image of the file. Memory follows what the file holds, not what its header promises.
 * layer: the layer or part of an OpenEXR file; empty: the one named Combined, else the channels R,
 * G and B without a name, else the first layer. Throws FileError.
 */
ImageFile ReadImageFile(
  const std::string& path, ImageValues values = ImageValues::Color, const std::string& layer = "");
} // namespace measuredbrdf

#endif
