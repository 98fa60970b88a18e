// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFile.h"

#include "FileBytes.h"

#include <OpenImageIO/imageio.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace measuredbrdf
{
namespace
{
using vtksys::SystemTools;

// OpenImageIO reports errors by the line.
std::string ToLine(std::string text)
{
  text.erase(text.find_last_not_of("\r\n ") + 1);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

//------------------------------------------------------------------------------
bool SaysLinear(const OIIO::ImageSpec& spec)
{
  const std::string space =
    SystemTools::LowerCase(std::string(spec.get_string_attribute("oiio:ColorSpace")));
  return space == "linear" || space == "scene_linear" || space.compare(0, 4, "lin_") == 0;
}

//------------------------------------------------------------------------------
// Blocks of rows are read, so that memory follows what the file holds and not what its header
// promises.
void ReadPixels(const ImageSource& source, OIIO::ImageInput& input, const OIIO::ImageSpec& spec,
  int channels, DecodedImage& image)
{
  int rows =
    std::max(static_cast<int>(BlockTexels / GetTexelWeight(spec.nchannels) / spec.width), 1);
  if (spec.tile_width > 0)
  {
    const int tile = std::max(spec.tile_height, 1);
    rows = std::max(rows / tile, 1) * tile;
  }
  std::vector<float> block;
  for (int y = 0; y < spec.height; y += rows)
  {
    const int end = std::min(y + rows, spec.height);
    block.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(end - y) *
                 static_cast<std::size_t>(channels));
    const bool read =
      spec.tile_width > 0
        ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
            spec.z + 1, 0, channels, OIIO::TypeDesc::FLOAT, block.data())
        : input.read_scanlines(0, 0, spec.y + y, spec.y + end, spec.z, 0, channels,
            OIIO::TypeDesc::FLOAT, block.data());
    if (!read)
    {
      const std::string reason = ToLine(input.geterror());
      throw FileError(source.Path, ": image pixels: ", reason,
        reason.empty()
          ? Concat("rows ", y, " to ", end - 1, " could not be read; the file may be cut short")
          : std::string());
    }
    for (auto texel = block.begin(); texel != block.end(); texel += channels)
    {
      image.AddTexel(&*texel);
    }
  }
}
}

//------------------------------------------------------------------------------
DecodedImage DecodeImage(const ImageSource& source)
{
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1); // where alpha is dropped, it must not darken
  // By the format's name: by the file's name, OpenImageIO tries all of its readers.
  auto input = OIIO::ImageInput::create(source.Format->Reader);
  OIIO::ImageSpec spec;
  const bool isOpen = input && input->open(source.Path, spec, config);
  Require(isOpen, source.Path,
    ": image header: ", ToLine(!isOpen && input ? input->geterror() : OIIO::geterror()));
  Require(
    spec.depth <= 1, source.Path, ": image size: found ", spec.depth, " slices, expected one");
  CheckImageSize(source.Path, *source.Format,
    { double(spec.width), double(spec.height), double(spec.nchannels), double(spec.tile_width),
      double(spec.tile_height) },
    source.FileSize);

  // Colors, or gray, are the first channels. Offsets, as PNG's oFFs, say where the image lies on a
  // page.
  const int colors = spec.nchannels >= 3 ? 3 : 1;
  DecodedImage image(source, spec.width, spec.height, colors == 1, spec.alpha_channel == colors);
  if (input->seek_subimage(1, 0))
  {
    image.Notes.push_back(SeveralImagesNote);
    input->seek_subimage(0, 0);
  }
  static_cast<void>(input->geterror()); // of looking for another one
  image.Orientation = spec.get_int_attribute("Orientation", 1);
  image.IsInteger = !spec.format.is_floating_point();
  image.IsEncoded = image.IsInteger && !SaysLinear(spec);
  image.HasBytes = spec.format.basetype == OIIO::TypeDesc::UINT8;
  ReadPixels(source, *input, spec, colors + (image.HasAlpha ? 1 : 0), image);
  return image;
}
} // namespace measuredbrdf

#ifdef vtkMeasuredBRDFImages_EXPORTS // CMake's, where this is the plugin
#if defined(_WIN32)
#define IMAGE_PLUGIN_EXPORT __declspec(dllexport)
#else
#define IMAGE_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif
extern "C" IMAGE_PLUGIN_EXPORT measuredbrdf::DecodeImageInPlugin vtkMeasuredBRDFDecodeImage;

//------------------------------------------------------------------------------
// Exceptions stay on their side of the border.
bool vtkMeasuredBRDFDecodeImage(
  const measuredbrdf::ImageSource& source, measuredbrdf::DecodedImage& image, std::string& error)
{
  try
  {
    image = measuredbrdf::DecodeImage(source);
    return true;
  }
  catch (const measuredbrdf::FileError& e)
  {
    error = e.what();
  }
  catch (const std::exception& e) // out of memory, say
  {
    error = source.Path + ": " + e.what();
  }
  return false;
}
#endif
