// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFile.h"

#include "FileBytes.h"

#include <OpenImageIO/imageio.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>

namespace measuredbrdf
{
namespace
{
constexpr std::uint64_t MaximumTexels = std::uint64_t(1) << 28;
constexpr int MaximumSide = 1 << 16;

// Pixels are read in blocks of about this many texels, so that memory follows what the file holds
// and not what its header promises.
constexpr std::uint64_t BlockTexels = std::uint64_t(1) << 20;

// A header that promises more texels than this per byte of its file (beyond a first block) lies.
// Deflate shrinks by 1032 at most; Radiance's runs hold 127 values of a channel in 2 bytes; a
// portable bitmap has 8 texels in a byte.
std::uint64_t GetMaximumTexelsPerByte(const std::string& format)
{
  return format == "pnm" ? 8 : format == "hdr" ? 16 : 1032;
}

//------------------------------------------------------------------------------
// OpenImageIO reports errors by the line.
std::string ToLine(std::string text)
{
  text.erase(text.find_last_not_of("\r\n ") + 1);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

//------------------------------------------------------------------------------
bool IsFloatingPoint(const OIIO::TypeDesc& type)
{
  return type.basetype == OIIO::TypeDesc::HALF || type.basetype == OIIO::TypeDesc::FLOAT ||
         type.basetype == OIIO::TypeDesc::DOUBLE;
}

//------------------------------------------------------------------------------
bool SaysLinear(const OIIO::ImageSpec& spec)
{
  const std::string space =
    vtksys::SystemTools::LowerCase(std::string(spec.get_string_attribute("oiio:ColorSpace")));
  return space == "linear" || space == "scene_linear" || space.compare(0, 4, "lin_") == 0;
}

//------------------------------------------------------------------------------
void CheckSize(const std::string& path, const OIIO::ImageSpec& spec, const std::string& format,
  std::uintmax_t fileSize)
{
  const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height);
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
  {
    throw FileError(path + ": image size: found " + size + " x " + std::to_string(spec.depth) +
                    ", " + std::to_string(spec.nchannels) +
                    " channels, expected one slice of at least 1 x 1");
  }
  if (spec.deep)
  {
    throw FileError(path + ": image type: found deep samples, expected one value per texel");
  }
  if (spec.tile_width > 0 &&
      std::uint64_t(spec.tile_width) * std::uint64_t(std::max(spec.tile_height, 1)) > BlockTexels)
  {
    throw FileError(path + ": tile size: found " + std::to_string(spec.tile_width) + " x " +
                    std::to_string(spec.tile_height) + ", expected at most " +
                    std::to_string(BlockTexels) + " texels");
  }
  const std::uint64_t texels = std::uint64_t(spec.width) * std::uint64_t(spec.height);
  if (texels > MaximumTexels)
  {
    throw FileError(path + ": image size: found " + size + ", expected at most " +
                    std::to_string(MaximumTexels) + " texels");
  }
  if (spec.width > MaximumSide || spec.height > MaximumSide)
  {
    throw FileError(path + ": image size: found " + size + ", expected sides of at most " +
                    std::to_string(MaximumSide));
  }
  if (texels > BlockTexels && (texels - BlockTexels) / GetMaximumTexelsPerByte(format) > fileSize)
  {
    throw FileError(path + ": image size: found " + size + ", more than a file of " +
                    std::to_string(fileSize) + " bytes can hold");
  }
}

//------------------------------------------------------------------------------
// Channels 0 to channels - 1 as the first of a texel's values, top row first.
std::vector<float> ReadPixels(const std::string& path, OIIO::ImageInput& input,
  const OIIO::ImageSpec& spec, int channels, std::size_t values)
{
  const bool tiled = spec.tile_width > 0;
  const std::size_t row = std::size_t(spec.width) * values;
  const std::size_t total = row * spec.height;
  int rows = static_cast<int>(std::max<std::uint64_t>(16, BlockTexels / spec.width));
  if (tiled)
  {
    rows = (rows + spec.tile_height - 1) / spec.tile_height * spec.tile_height;
  }
  std::vector<float> pixels;
  for (int y = 0; y < spec.height; y += rows)
  {
    const int end = std::min(y + rows, spec.height);
    pixels.reserve(std::min(total, std::max(2 * pixels.size(), row * end)));
    pixels.resize(row * end);
    float* block = &pixels[row * y];
    const OIIO::stride_t texel = values * sizeof(float);
    const bool read =
      tiled ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
                spec.z + 1, 0, channels, OIIO::TypeDesc::FLOAT, block, texel, row * sizeof(float))
            : input.read_scanlines(0, 0, spec.y + y, spec.y + end, spec.z, 0, channels,
                OIIO::TypeDesc::FLOAT, block, texel, row * sizeof(float));
    if (!read)
    {
      const std::string reason = ToLine(input.geterror());
      throw FileError(
        path + ": image pixels: " +
        (reason.empty() ? "rows " + std::to_string(y) + " to " + std::to_string(end - 1) +
                            " could not be read; the file may be cut short"
                        : reason));
    }
  }
  return pixels;
}
}

//------------------------------------------------------------------------------
ImageFile ReadImageFile(const std::string& path, std::uintmax_t fileSize, ImageValues values)
{
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1); // where alpha is dropped, it must not darken
  auto input = OIIO::ImageInput::open(path, &config);
  if (!input)
  {
    throw FileError(path + ": image header: " + ToLine(OIIO::geterror()));
  }
  const OIIO::ImageSpec spec = input->spec(); // sub-image 0
  CheckSize(path, spec, input->format_name(), fileSize);

  ImageFile image;
  image.Width = spec.width;
  image.Height = spec.height;
  image.Channels = spec.nchannels >= 3 ? 3 : 1;
  const bool alpha = values == ImageValues::ColorAndAlpha;
  image.HasAlpha = alpha && spec.alpha_channel == image.Channels;
  image.IsInteger = !IsFloatingPoint(spec.format);
  image.IsEncoded = image.IsInteger && !SaysLinear(spec);
  image.HasBytes = spec.format.basetype == OIIO::TypeDesc::UINT8;
  image.IsWindowed = spec.full_width != spec.width || spec.full_height != spec.height;
  image.Pixels =
    ReadPixels(path, *input, spec, image.Channels + (image.HasAlpha ? 1 : 0), alpha ? 4 : 3);
  return image;
}
} // namespace measuredbrdf

#ifdef vtkMeasuredBRDFImages_EXPORTS // CMake's, where this is the plugin
#if defined(_WIN32)
#define IMAGE_PLUGIN_EXPORT __declspec(dllexport)
#else
#define IMAGE_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif
extern "C" IMAGE_PLUGIN_EXPORT measuredbrdf::ReadImageFileInPlugin vtkMeasuredBRDFReadImageFile;

//------------------------------------------------------------------------------
// Exceptions stay on their side of the border.
bool vtkMeasuredBRDFReadImageFile(const std::string& path, std::uintmax_t fileSize,
  measuredbrdf::ImageValues values, measuredbrdf::ImageFile& image, std::string& error)
{
  try
  {
    image = measuredbrdf::ReadImageFile(path, fileSize, values);
    return true;
  }
  catch (const measuredbrdf::FileError& e)
  {
    error = e.what();
  }
  catch (const std::exception& e) // out of memory, say
  {
    error = path + ": " + e.what();
  }
  return false;
}
#endif
