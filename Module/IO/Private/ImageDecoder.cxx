// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageDecoder.h"

#include "FileBytes.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>

namespace measuredbrdf
{
namespace
{
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
// A layer of an image: which part (sub-image) it is in, and its channels.
struct ImageLayer
{
  int Part = 0;
  std::string Name;
  std::string PartName;
  std::string ChannelPrefix;
  int Color[3] = { -1, -1, -1 }; // equal: gray
  int Alpha = -1;

  bool IsRGB() const { return this->Color[0] >= 0 && this->Color[1] >= 0 && this->Color[2] >= 0; }
};

//------------------------------------------------------------------------------
// Formats without layers: colors, or gray, are the first channels.
ImageLayer GetOnlyLayer(const OIIO::ImageSpec& spec)
{
  ImageLayer layer;
  for (int k = 0; k < 3; ++k)
  {
    layer.Color[k] = spec.nchannels >= 3 ? k : 0;
  }
  const int colors = layer.Color[2] + 1;
  layer.Alpha = spec.alpha_channel == colors ? colors : -1;
  return layer;
}

//------------------------------------------------------------------------------
// OpenEXR names a channel "LAYER.R", "R" without a layer; parts have names of their own. "Y" is
// gray. Layers of other channels, such as depth, are none here.
void AddLayers(int part, const std::string& partName, const OIIO::ImageSpec& spec,
  std::vector<ImageLayer>& found)
{
  static const std::map<std::string, int> places = { { "r", 0 }, { "red", 0 }, { "g", 1 },
    { "green", 1 }, { "b", 2 }, { "blue", 2 }, { "a", 3 }, { "alpha", 3 }, { "y", 4 } };
  std::vector<ImageLayer> layers;
  std::vector<int> gray;
  for (int channel = 0; channel < spec.nchannels; ++channel)
  {
    const std::string& name = spec.channelnames[static_cast<std::size_t>(channel)];
    const std::size_t dot = name.rfind('.');
    const std::string prefix = dot == std::string::npos ? "" : name.substr(0, dot);
    const auto place = places.find(
      vtksys::SystemTools::LowerCase(dot == std::string::npos ? name : name.substr(dot + 1)));
    if (place == places.end())
    {
      continue;
    }
    auto layer = std::find_if(layers.begin(), layers.end(),
      [&prefix](const ImageLayer& one) { return one.ChannelPrefix == prefix; });
    if (layer == layers.end())
    {
      ImageLayer made;
      made.Part = part;
      made.PartName = partName;
      made.ChannelPrefix = prefix;
      made.Name = partName.empty() || prefix.empty() ? partName + prefix : partName + "." + prefix;
      layer = layers.insert(layers.end(), made);
      gray.push_back(-1);
    }
    if (place->second < 3)
    {
      layer->Color[place->second] = channel;
    }
    else
    {
      (place->second == 3 ? layer->Alpha : gray[static_cast<std::size_t>(layer - layers.begin())]) =
        channel;
    }
  }
  for (std::size_t k = 0; k < layers.size(); ++k)
  {
    if (!layers[k].IsRGB())
    {
      std::fill_n(layers[k].Color, 3, gray[k]);
    }
    if (layers[k].IsRGB())
    {
      found.push_back(layers[k]);
    }
  }
}

//------------------------------------------------------------------------------
std::vector<ImageLayer> FindLayers(OIIO::ImageInput& input)
{
  std::vector<ImageLayer> layers;
  const bool hasParts = input.seek_subimage(1, 0);
  for (int part = 0; input.seek_subimage(part, 0); ++part)
  {
    const OIIO::ImageSpec& spec = input.spec();
    std::string name;
    if (hasParts)
    {
      name = std::string(spec.get_string_attribute("oiio:subimagename"));
      name = name.empty() ? "part " + std::to_string(part) : name;
    }
    if (!spec.deep)
    {
      AddLayers(part, name, spec, layers);
    }
  }
  input.seek_subimage(0, 0);
  return layers;
}

//------------------------------------------------------------------------------
// Blender's name of what a picture shows, by itself or at the end of a layer's.
bool IsCombined(const std::string& name)
{
  const std::size_t dot = name.rfind('.');
  return vtksys::SystemTools::LowerCase(dot == std::string::npos ? name : name.substr(dot + 1)) ==
         "combined";
}

//------------------------------------------------------------------------------
// Less is better.
int GetRank(const ImageLayer& layer)
{
  const bool isGray = layer.Color[0] == layer.Color[1];
  return (IsCombined(layer.Name) ? 0 : layer.ChannelPrefix.empty() ? 1 : 2) + (isGray ? 3 : 0);
}

//------------------------------------------------------------------------------
std::string ListNames(const std::vector<ImageLayer>& layers)
{
  constexpr std::size_t most = 12;
  std::string list;
  for (std::size_t k = 0; k < layers.size() && k < most; ++k)
  {
    const std::string& name = layers[k].Name;
    list += (k == 0 ? "" : ", ") + (name.empty() ? "the one without a name" : Quote(name));
  }
  return list + (layers.size() > most ? ", ..." : "");
}

//------------------------------------------------------------------------------
ImageLayer ChooseLayer(const ImageSource& source, OIIO::ImageInput& input, ImageFile& image)
{
  const bool isExr = IsImageFormat(*source.Format, "openexr");
  const std::vector<ImageLayer> layers = isExr ? FindLayers(input) : std::vector<ImageLayer>();
  if (!source.Layer.empty())
  {
    const auto found = std::find_if(layers.begin(), layers.end(),
      [&source](const ImageLayer& one)
      {
        return one.Name == source.Layer || one.PartName == source.Layer ||
               one.ChannelPrefix == source.Layer;
      });
    if (found == layers.end())
    {
      throw FileError(source.Path + ": layer: found " +
                      (layers.empty() ? "none" : ListNames(layers)) + ", expected " +
                      Quote(source.Layer));
    }
    return *found;
  }
  if (layers.empty())
  {
    if (!isExr && input.seek_subimage(1, 0))
    {
      image.Notes.push_back("The file holds several images: the first one was taken.");
      input.seek_subimage(0, 0);
    }
    ImageLayer only = GetOnlyLayer(input.spec());
    if (isExr && input.spec().nchannels > 1)
    {
      std::fill_n(only.Color, 3, 0);
      only.Alpha = -1;
      image.Notes.push_back("No channels named R, G and B: " +
                            Quote(input.spec().channelnames.front()) + " was taken as gray.");
    }
    return only;
  }
  const auto best = std::min_element(layers.begin(), layers.end(),
    [](const ImageLayer& a, const ImageLayer& b) { return GetRank(a) < GetRank(b); });
  if (layers.size() > 1)
  {
    image.Notes.push_back("Of the layers " + ListNames(layers) + ": " +
                          (best->Name.empty() ? "the one without a name" : Quote(best->Name)) +
                          " was taken.");
  }
  return *best;
}

//------------------------------------------------------------------------------
void CheckSpec(const ImageSource& source, const OIIO::ImageSpec& spec)
{
  if (spec.depth > 1)
  {
    throw FileError(
      source.Path + ": image size: found " + std::to_string(spec.depth) + " slices, expected one");
  }
  if (spec.deep)
  {
    throw FileError(source.Path + ": image type: found deep samples, expected one value per texel");
  }
  ImageSize size;
  size.Width = spec.width;
  size.Height = spec.height;
  size.Channels = spec.nchannels;
  size.TileWidth = spec.tile_width;
  size.TileHeight = spec.tile_height;
  CheckImageSize(source.Path, *source.Format, size, source.FileSize);
}

//------------------------------------------------------------------------------
// Some rows of channels that follow each other, in blocks of columns where the image has tiles.
bool ReadRows(OIIO::ImageInput& input, int part, const OIIO::ImageSpec& spec, int y, int end,
  int channel, int channels, float* block, std::size_t values)
{
  const auto texel = static_cast<OIIO::stride_t>(values * sizeof(float));
  const OIIO::stride_t row = texel * spec.width;
  const int top = spec.y;
  if (spec.tile_width < 1)
  {
    return input.read_scanlines(part, 0, top + y, top + end, spec.z, channel, channel + channels,
      OIIO::TypeDesc::FLOAT, block, texel, row);
  }
  const std::uint64_t texels = BlockTexels / GetTexelWeight(spec.nchannels);
  const auto most = static_cast<int>(texels / static_cast<std::uint64_t>(end - y));
  const int columns = std::max(most / spec.tile_width, 1) * spec.tile_width;
  for (int x = 0; x < spec.width; x += columns)
  {
    const int right = std::min(x + columns, spec.width);
    if (!input.read_tiles(part, 0, spec.x + x, spec.x + right, top + y, top + end, spec.z,
          spec.z + 1, channel, channel + channels, OIIO::TypeDesc::FLOAT,
          block + values * static_cast<std::size_t>(x), texel, row))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// The given channels as the first of a texel's values, top row first.
std::vector<float> ReadPixels(const ImageSource& source, OIIO::ImageInput& input, int part,
  const OIIO::ImageSpec& spec, const std::vector<int>& channels)
{
  const std::size_t values = source.Values == ImageValues::ColorAndAlpha ? 4 : 3;
  const std::size_t row = static_cast<std::size_t>(spec.width) * values;
  const std::size_t total = row * static_cast<std::size_t>(spec.height);
  const std::uint64_t texels = BlockTexels / GetTexelWeight(spec.nchannels);
  int rows =
    static_cast<int>(std::max<std::uint64_t>(texels / static_cast<std::uint64_t>(spec.width), 1));
  if (spec.tile_width > 0 && spec.tile_height > 0)
  {
    rows = std::max(rows / spec.tile_height, 1) * spec.tile_height;
  }
  // Channels in this order are read at once.
  bool follow = true;
  for (std::size_t k = 1; k < channels.size(); ++k)
  {
    follow = follow && channels[k] == channels[0] + static_cast<int>(k);
  }
  std::vector<float> pixels;
  for (int y = 0; y < spec.height; y += rows)
  {
    const int end = std::min(y + rows, spec.height);
    const std::size_t size = row * static_cast<std::size_t>(end);
    pixels.reserve(std::min(total, std::max(2 * pixels.size(), size)));
    pixels.resize(size);
    float* block = &pixels[row * static_cast<std::size_t>(y)];
    bool read = true;
    for (std::size_t k = 0; k < channels.size() && read; k += follow ? channels.size() : 1)
    {
      read = ReadRows(input, part, spec, y, end, channels[k],
        follow ? static_cast<int>(channels.size()) : 1, block + k, values);
    }
    if (!read)
    {
      const std::string reason = ToLine(input.geterror());
      throw FileError(
        source.Path + ": image pixels: " +
        (reason.empty() ? "rows " + std::to_string(y) + " to " + std::to_string(end - 1) +
                            " could not be read; the file may be cut short"
                        : reason));
    }
  }
  return pixels;
}

//------------------------------------------------------------------------------
void TakeHeader(const OIIO::ImageSpec& spec, const ImageFormat& format, DecodedImage& image)
{
  const std::string kind(spec.get_string_attribute("textureformat"));
  image.Envmap = kind == "LatLong Environment"    ? ImageEnvmap::LatLong
                 : kind == "CubeFace Environment" ? ImageEnvmap::Cube
                                                  : ImageEnvmap::None;
  // Other formats' offsets, as PNG's oFFs, say where the image lies on a page.
  if (image.Envmap == ImageEnvmap::None && IsImageFormat(format, "openexr"))
  {
    image.Left = spec.x - spec.full_x;
    image.Top = spec.y - spec.full_y;
    image.DisplayWidth = spec.full_width;
    image.DisplayHeight = spec.full_height;
  }
  else // ImfEnvmap.h maps directions to the data window
  {
    image.DisplayWidth = spec.width;
    image.DisplayHeight = spec.height;
  }
  image.Orientation = spec.get_int_attribute("Orientation", 1);
  const OIIO::ParamValue* found = spec.find_attribute("chromaticities");
  if (found && found->type().basetype == OIIO::TypeDesc::FLOAT && found->type().basevalues() == 8)
  {
    const float* values = static_cast<const float*>(found->data());
    image.Chromaticities.assign(values, values + 8);
  }
}
}

//------------------------------------------------------------------------------
DecodedImage DecodeImage(const ImageSource& source)
{
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1); // where alpha is dropped, it must not darken
  OIIO::Filesystem::IOMemReader bytes(source.Bytes.data(), source.Bytes.size()); // outlives input
  // By the format's name: by the file's name, OpenImageIO tries all of its readers.
  auto input = OIIO::ImageInput::create(source.Format->Reader);
  OIIO::ImageSpec first;
  if (input && !source.Bytes.empty())
  {
    input->set_ioproxy(&bytes);
  }
  if (!input || !input->open(source.Path, first, config))
  {
    throw FileError(
      source.Path + ": image header: " + ToLine(input ? input->geterror() : OIIO::geterror()));
  }
  CheckSpec(source, first);

  DecodedImage image;
  const ImageLayer layer = ChooseLayer(source, *input, image);
  static_cast<void>(input->geterror()); // of looking for another part
  if (!input->seek_subimage(layer.Part, 0))
  {
    throw FileError(source.Path + ": image header: " + ToLine(input->geterror()));
  }
  const OIIO::ImageSpec spec = input->spec();
  CheckSpec(source, spec);
  std::vector<int> channels(layer.Color, layer.Color + 3);
  if (layer.Color[0] == layer.Color[1])
  {
    channels.resize(1);
  }
  const OIIO::TypeDesc type = spec.channelformat(layer.Color[0]);
  image.Width = spec.width;
  image.Height = spec.height;
  image.Channels = static_cast<int>(channels.size());
  image.HasAlpha = source.Values == ImageValues::ColorAndAlpha && layer.Alpha >= 0;
  image.IsInteger = !IsFloatingPoint(type);
  image.IsEncoded = image.IsInteger && !SaysLinear(spec);
  image.HasBytes = type.basetype == OIIO::TypeDesc::UINT8;
  TakeHeader(spec, *source.Format, image);
  if (image.HasAlpha)
  {
    channels.push_back(layer.Alpha);
  }
  image.Pixels = ReadPixels(source, *input, layer.Part, spec, channels);
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
