// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pixels of an image file as they are stored, by OpenImageIO.
 *
 * OpenImageIO brings many libraries along: on Debian some 200, for films and scanners. A program
 * that reads no image should not load them. DecodeImage is therefore defined twice:
 *
 * - ImageDecoder.cxx calls OpenImageIO. A shared build makes a plugin of it, a static one takes it
 *   in.
 * - ImagePlugin.cxx, in a shared build, loads the plugin when the first image is read.
 */

#ifndef ImageDecoder_h
#define ImageDecoder_h

#include "ImageFormats.h"

#include <cstdint>
#include <string>
#include <string_view>
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

/// What to decode.
struct ImageSource
{
  std::string Path;
  std::uintmax_t FileSize = 0;
  const ImageFormat* Format = nullptr;
  std::string_view Bytes; // in place of the file's; empty: the file's
  ImageValues Values = ImageValues::Color;
  std::string Layer;
};

/// An image as it is stored, and what OpenImageIO tells of its header.
struct DecodedImage : ImageFile
{
  int Left = 0; // the first texel's place in the display window; may be outside
  int Top = 0;
  int DisplayWidth = 0;
  int DisplayHeight = 0;
  int Orientation = 1;                // as EXIF numbers it
  std::vector<double> Chromaticities; // empty, or 8: ImageFile.cxx
};

/// Throws FileError.
DecodedImage DecodeImage(const ImageSource& source);

/// What the plugin exports: the same; returns false, with the error, in place of throwing.
using DecodeImageInPlugin = bool(
  const ImageSource& source, DecodedImage& image, std::string& error);
constexpr const char DecodeImageSymbol[] = "vtkMeasuredBRDFDecodeImage";
} // namespace measuredbrdf

#endif
