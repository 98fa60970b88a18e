// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFile.h"

#include "FileBytes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace measuredbrdf
{
namespace
{
constexpr double MaximumTexels = 1 << 28;
constexpr double MaximumSide = 1 << 16;
constexpr double MaximumChannels = 1024;

// How a file of the format begins.
struct Beginning
{
  ImageFormat Format;
  std::string_view Bytes;
};

// The one list. Deflate shrinks by 1032 at most; Radiance's runs hold 127 values of a channel in 2
// bytes; those of bitmaps 255 texels in 2 bytes; a portable bitmap has 8 texels in a byte.
constexpr ImageFormat OpenExr = { "OpenEXR", "openexr", 1032 };
constexpr ImageFormat Radiance = { "Radiance HDR", "hdr", 16 };
constexpr ImageFormat Png = { "PNG", "png", 1032 };
constexpr ImageFormat Jpeg = { "JPEG", "jpeg", 1032 };
constexpr ImageFormat Tiff = { "TIFF", "tiff", 1032 };
constexpr ImageFormat Bitmap = { "BMP", "bmp", 128 };
constexpr ImageFormat Portable = { "PNM or PFM", "pnm", 8 };

using namespace std::string_view_literals;
constexpr Beginning Beginnings[] = { { OpenExr, "\x76\x2f\x31\x01"sv }, { Radiance, "#?"sv },
  { Png, "\x89PNG\r\n\x1a\n"sv }, { Jpeg, "\xff\xd8\xff"sv }, { Tiff, "II*\0"sv },
  { Tiff, "MM\0*"sv }, { Tiff, "II+\0"sv }, { Tiff, "MM\0+"sv }, { Bitmap, "BM"sv },
  { Portable, "P1"sv }, { Portable, "P2"sv }, { Portable, "P3"sv }, { Portable, "P4"sv },
  { Portable, "P5"sv }, { Portable, "P6"sv }, { Portable, "PF"sv }, { Portable, "Pf"sv } };

//------------------------------------------------------------------------------
// In the order of the list, each once.
std::string ListFormats()
{
  std::string list;
  std::string_view last;
  for (const Beginning& beginning : Beginnings)
  {
    if (beginning.Format.Name != last)
    {
      list += (list.empty() ? "" : ", ") + std::string(beginning.Format.Name);
      last = beginning.Format.Name;
    }
  }
  return list;
}

//------------------------------------------------------------------------------
// Unsigned values at a place of a file; 0 beyond its end.
class Peek
{
public:
  explicit Peek(const std::string& path)
    : Stream(path, std::ios::binary)
  {
  }

  std::uint64_t Get(std::uint64_t at, int bytes, bool bigEndian)
  {
    unsigned char data[8] = {};
    this->Stream.clear();
    this->Stream.seekg(static_cast<std::streamoff>(at));
    this->Stream.read(reinterpret_cast<char*>(data), bytes);
    std::uint64_t value = 0;
    for (int k = 0; k < bytes; ++k)
    {
      value = value << 8 | data[bigEndian ? k : bytes - 1 - k];
    }
    return this->Stream ? value : 0;
  }

private:
  std::ifstream Stream;
};

//------------------------------------------------------------------------------
// EXIF 2.32, 4.5: a TIFF header and directory, which has the tag 274; 1 where it has not.
int PeekOrientation(Peek& file, std::uint64_t header)
{
  const bool bigEndian = file.Get(header, 1, true) == 'M';
  const std::uint64_t directory = header + file.Get(header + 4, 4, bigEndian);
  const std::uint64_t count = file.Get(directory, 2, bigEndian);
  for (std::uint64_t k = 0; k < count; ++k)
  {
    const std::uint64_t entry = directory + 2 + 12 * k;
    if (file.Get(entry, 2, bigEndian) == 274)
    {
      return static_cast<int>(file.Get(entry + 8, 2, bigEndian));
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
// ITU-T T.81, B.2.2: the frame header's Y and X; 0 where there is none. EXIF lies before it.
ImageSize PeekJpeg(Peek& file, std::uintmax_t fileSize)
{
  ImageSize size;
  std::uint64_t at = 2;
  while (at + 9 < fileSize && file.Get(at, 1, true) == 0xff)
  {
    const std::uint64_t marker = file.Get(at + 1, 1, true);
    if (marker == 0xff) // filling
    {
      ++at;
      continue;
    }
    if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
    {
      size.Height = double(file.Get(at + 5, 2, true));
      size.Width = double(file.Get(at + 7, 2, true));
      return size;
    }
    if (marker == 0xe1 && file.Get(at + 4, 6, true) == 0x457869660000) // "Exif"
    {
      size.Orientation = PeekOrientation(file, at + 10);
    }
    at += 2 + std::max<std::uint64_t>(file.Get(at + 2, 2, true), 2);
  }
  return size;
}

//------------------------------------------------------------------------------
// OS/2's header has 16 bits a side, those of Windows 32; a negative height: the top row first.
ImageSize PeekBitmap(Peek& file)
{
  ImageSize size;
  if (file.Get(14, 4, false) == 12)
  {
    size.Width = double(file.Get(18, 2, false));
    size.Height = double(file.Get(20, 2, false));
    return size;
  }
  size.Width = static_cast<std::int32_t>(file.Get(18, 4, false));
  size.Height = std::abs(double(static_cast<std::int32_t>(file.Get(22, 4, false))));
  return size;
}
}

//------------------------------------------------------------------------------
const ImageFormat& RecognizeImage(const std::string& path)
{
  char bytes[8] = {};
  std::ifstream stream(path, std::ios::binary);
  stream.read(bytes, sizeof(bytes));
  const std::string_view begin(bytes, static_cast<std::size_t>(stream.gcount()));
  const auto* found = std::find_if(std::begin(Beginnings), std::end(Beginnings),
    [begin](const Beginning& one) { return begin.substr(0, one.Bytes.size()) == one.Bytes; });
  Require(found != std::end(Beginnings), path,
    ": image header: found none of the formats that images are read from (", ListFormats(), ")");
  return found->Format;
}

//------------------------------------------------------------------------------
double GetTexelWeight(double channels) { return std::ceil(std::max(channels, 1.0) / 4.0); }

//------------------------------------------------------------------------------
void CheckImageSize(const std::string& path, const ImageFormat& format, const ImageSize& size,
  std::uintmax_t fileSize)
{
  const auto number = [](double value) { return NumberText(value, 15); };
  const std::string found =
    ": image size: found " + number(size.Width) + " x " + number(size.Height);
  const std::string with = " with " + number(size.Channels) + " channels";
  const double texels = size.Width * size.Height;
  const double weight = GetTexelWeight(size.Channels);
  Require(std::min({ size.Width, size.Height, size.Channels }) >= 1, path, found, with,
    ", expected at least 1 x 1 with 1");
  Require(std::max(size.Width, size.Height) <= MaximumSide, path, found,
    ", expected sides of at most ", number(MaximumSide));
  Require(
    texels <= MaximumTexels, path, found, ", expected at most ", number(MaximumTexels), " texels");
  Require(size.Channels <= MaximumChannels, path, ": image channels: found ", number(size.Channels),
    ", expected at most ", number(MaximumChannels));
  const bool isTileLarge = std::max(size.TileWidth, size.TileHeight) > MaximumSide ||
                           size.TileWidth * std::max(size.TileHeight, 1.0) * weight > BlockTexels;
  Require(size.TileWidth <= 0 || !isTileLarge, path, ": tile size: found ", number(size.TileWidth),
    " x ", number(size.TileHeight), with, ", expected at most ",
    number(std::floor(BlockTexels / weight)), " texels");
  Require((texels * weight - BlockTexels) / format.TexelsPerByte <= double(fileSize), path, found,
    with, ", more than a file of ", fileSize, " bytes can hold");
}

//------------------------------------------------------------------------------
int CheckStoredSize(const std::string& path, const ImageFormat& format, std::uintmax_t fileSize)
{
  Peek file(path);
  ImageSize size;
  if (format.Is(Jpeg.Reader) || format.Is(Bitmap.Reader))
  {
    size = format.Is(Jpeg.Reader) ? PeekJpeg(file, fileSize) : PeekBitmap(file);
    CheckImageSize(path, format, size, fileSize);
  }
  return size.Orientation;
}
} // namespace measuredbrdf
