// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The formats that images come in: environments, pictures, photographs and weights. OpenImageIO
 * knows some 30 more, for films and scanners, whose readers would meet files of any origin. A
 * file's format is found by its content, never by its name, before a library sees it.
 */

#ifndef ImageFormats_h
#define ImageFormats_h

#include <cstdint>
#include <string>

namespace measuredbrdf
{
struct ImageFormat
{
  const char* Name;   // for people
  const char* Reader; // OpenImageIO's name
  // A header that promises more texels than this per byte of its file (beyond a first block) lies.
  std::uint64_t TexelsPerByte;
};

/// The format of the file, which is there and not empty. Throws FileError, with the list of the
/// formats, where it is none of them.
const ImageFormat& RecognizeImage(const std::string& path);

/// Whether it is the format of that name of OpenImageIO's.
bool IsImageFormat(const ImageFormat& format, const char* reader);

/// The numbers that a header says of an image's size, before anything is allocated.
struct ImageSize
{
  std::int64_t Width = 0;
  std::int64_t Height = 0;
  std::int64_t Channels = 1;
  std::int64_t TileWidth = 0; // 0: no tiles
  std::int64_t TileHeight = 0;
};

/// Images are read in blocks of about this many texels of up to four channels, so that memory
/// follows what the file holds and not what its header promises.
constexpr std::uint64_t BlockTexels = std::uint64_t(1) << 20;

/// How many times four channels a texel has: what a texel counts in a block.
std::uint64_t GetTexelWeight(std::int64_t channels);

/// Throws FileError where a size is not positive, too large, or more than fileSize bytes can hold.
void CheckImageSize(const std::string& path, const ImageFormat& format, const ImageSize& size,
  std::uintmax_t fileSize);

/// The same for the formats whose readers allocate the whole image as they open it: JPEG and BMP.
void CheckStoredSize(const std::string& path, const ImageFormat& format, std::uintmax_t fileSize);
} // namespace measuredbrdf

#endif
