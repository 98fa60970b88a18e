// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pixels of an image file, by OpenImageIO.
 *
 * OpenImageIO brings many libraries along: on Debian some 200, for films and scanners. A program
 * that reads no image should not load them. ReadImageFile is therefore defined twice:
 *
 * - ImageFile.cxx calls OpenImageIO. A shared build makes a plugin of it, a static one takes it in.
 * - ImagePlugin.cxx, in a shared build, loads the plugin when the first image is read.
 */

#ifndef ImageFile_h
#define ImageFile_h

#include <cstdint>
#include <string>
#include <vector>

namespace measuredbrdf
{
struct ImageFile
{
  int Width = 0;
  int Height = 0;
  int Channels = 0;          // 3, or 1: of each texel's color only the first value is set
  bool HasAlpha = false;     // the value after the color's, where it was asked for
  bool IsEncoded = false;    // integers that are not said to be linear
  bool IsInteger = false;    // else floats
  bool HasBytes = false;     // integers of 8 bits
  bool IsWindowed = false;   // the data window differs from the display window
  std::vector<float> Pixels; // 3 values a texel, 4 where alpha was asked for; top row first
};

/// What to read of each texel.
enum class ImageValues
{
  Color,
  ColorAndAlpha // not multiplied into integers' colors; OpenEXR's colors keep it
};

/**
 * Read the first image of the file, which has fileSize bytes. Memory follows what the file holds,
 * not what its header promises. Throws FileError.
 */
ImageFile ReadImageFile(
  const std::string& path, std::uintmax_t fileSize, ImageValues values = ImageValues::Color);

/// What the plugin exports: the same; returns false, with the error, in place of throwing.
using ReadImageFileInPlugin = bool(const std::string& path, std::uintmax_t fileSize,
  ImageValues values, ImageFile& image, std::string& error);
constexpr const char ReadImageFileSymbol[] = "vtkMeasuredBRDFReadImageFile";
} // namespace measuredbrdf

#endif
