// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFormats.h"

#include "FileBytes.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string_view>

namespace measuredbrdf
{
namespace
{
constexpr std::uint64_t MaximumTexels = std::uint64_t(1) << 28;
constexpr std::int64_t MaximumSide = 1 << 16;
constexpr std::int64_t MaximumChannels = 1024;

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
std::string ListFormats()
{
  std::string list;
  const ImageFormat* last = &Beginnings[0].Format;
  for (const Beginning& beginning : Beginnings)
  {
    if (list.empty() || std::strcmp(beginning.Format.Name, last->Name) != 0)
    {
      list += (list.empty() ? "" : ", ") + std::string(beginning.Format.Name);
    }
    last = &beginning.Format;
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
// ITU-T T.81, B.2.2: the frame header's Y and X; 0 where there is none.
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
      size.Height = static_cast<std::int64_t>(file.Get(at + 5, 2, true));
      size.Width = static_cast<std::int64_t>(file.Get(at + 7, 2, true));
      return size;
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
    size.Width = static_cast<std::int64_t>(file.Get(18, 2, false));
    size.Height = static_cast<std::int64_t>(file.Get(20, 2, false));
    return size;
  }
  size.Width = static_cast<std::int32_t>(file.Get(18, 4, false));
  size.Height = static_cast<std::int32_t>(file.Get(22, 4, false));
  size.Height = size.Height < 0 ? -size.Height : size.Height;
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
  if (found == std::end(Beginnings))
  {
    throw FileError(path + ": image header: found none of the formats that images are read from (" +
                    ListFormats() + ")");
  }
  return found->Format;
}

//------------------------------------------------------------------------------
bool IsImageFormat(const ImageFormat& format, const char* reader)
{
  return std::strcmp(format.Reader, reader) == 0;
}

//------------------------------------------------------------------------------
std::uint64_t GetTexelWeight(std::int64_t channels)
{
  return static_cast<std::uint64_t>(std::max<std::int64_t>(channels, 1) + 3) / 4;
}

//------------------------------------------------------------------------------
void CheckImageSize(const std::string& path, const ImageFormat& format, const ImageSize& size,
  std::uintmax_t fileSize)
{
  const std::string found = std::to_string(size.Width) + " x " + std::to_string(size.Height);
  if (size.Width < 1 || size.Height < 1 || size.Channels < 1)
  {
    throw FileError(path + ": image size: found " + found + " with " +
                    std::to_string(size.Channels) + " channels, expected at least 1 x 1 with 1");
  }
  if (size.Width > MaximumSide || size.Height > MaximumSide)
  {
    throw FileError(path + ": image size: found " + found + ", expected sides of at most " +
                    std::to_string(MaximumSide));
  }
  const std::uint64_t texels =
    static_cast<std::uint64_t>(size.Width) * static_cast<std::uint64_t>(size.Height);
  if (texels > MaximumTexels)
  {
    throw FileError(path + ": image size: found " + found + ", expected at most " +
                    std::to_string(MaximumTexels) + " texels");
  }
  if (size.Channels > MaximumChannels)
  {
    throw FileError(path + ": image channels: found " + std::to_string(size.Channels) +
                    ", expected at most " + std::to_string(MaximumChannels));
  }
  const std::uint64_t weight = GetTexelWeight(size.Channels);
  if (size.TileWidth > 0 &&
      (size.TileWidth > MaximumSide || size.TileHeight > MaximumSide ||
        static_cast<std::uint64_t>(size.TileWidth) *
            static_cast<std::uint64_t>(std::max<std::int64_t>(size.TileHeight, 1)) * weight >
          BlockTexels))
  {
    throw FileError(path + ": tile size: found " + std::to_string(size.TileWidth) + " x " +
                    std::to_string(size.TileHeight) + " with " + std::to_string(size.Channels) +
                    " channels, expected at most " + std::to_string(BlockTexels / weight) +
                    " texels");
  }
  if (texels * weight > BlockTexels &&
      (texels * weight - BlockTexels) / format.TexelsPerByte > fileSize)
  {
    throw FileError(path + ": image size: found " + found + " with " +
                    std::to_string(size.Channels) + " channels, more than a file of " +
                    std::to_string(fileSize) + " bytes can hold");
  }
}

//------------------------------------------------------------------------------
void CheckStoredSize(const std::string& path, const ImageFormat& format, std::uintmax_t fileSize)
{
  Peek file(path);
  if (IsImageFormat(format, Jpeg.Reader))
  {
    CheckImageSize(path, format, PeekJpeg(file, fileSize), fileSize);
  }
  else if (IsImageFormat(format, Bitmap.Reader))
  {
    CheckImageSize(path, format, PeekBitmap(file), fileSize);
  }
}
} // namespace measuredbrdf
