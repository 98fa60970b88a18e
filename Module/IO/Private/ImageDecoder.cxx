// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFile.h"

#include "FileBytes.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <numeric>

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
// A layer of an image: which part (sub-image) it is in, and its channels.
struct ImageLayer
{
  int Part = 0;
  std::string PartName;
  std::string ChannelPrefix;
  std::string Name; // of both
  // Red, green, blue, alpha, gray; -1: none.
  int Channels[5] = { -1, -1, -1, -1, -1 };

  bool IsRGB() const { return std::min({ Channels[0], Channels[1], Channels[2] }) >= 0; }

  std::string Describe() const
  {
    return this->Name.empty() ? "the one without a name" : Quote(this->Name);
  }
};

// "LAYER" and "R" of "LAYER.R".
std::pair<std::string, std::string> SplitName(const std::string& name)
{
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? std::make_pair(std::string(), name)
                                  : std::make_pair(name.substr(0, dot), name.substr(dot + 1));
}

//------------------------------------------------------------------------------
// OpenEXR names a channel "LAYER.R", "R" without a layer; parts have names of their own. "Y" is
// gray. Layers of other channels, such as depth, are none here.
std::vector<ImageLayer> FindLayers(OIIO::ImageInput& input)
{
  static const std::map<std::string, int> places = { { "r", 0 }, { "red", 0 }, { "g", 1 },
    { "green", 1 }, { "b", 2 }, { "blue", 2 }, { "a", 3 }, { "alpha", 3 }, { "y", 4 } };
  std::vector<ImageLayer> found;
  const bool hasParts = input.seek_subimage(1, 0);
  for (int part = 0; input.seek_subimage(part, 0); ++part)
  {
    const OIIO::ImageSpec& spec = input.spec();
    const std::string name(spec.get_string_attribute("oiio:subimagename"));
    std::map<std::string, ImageLayer> layers; // by their prefixes
    for (int channel = 0; channel < spec.nchannels && !spec.deep; ++channel)
    {
      const auto [prefix, color] = SplitName(spec.channelnames[static_cast<std::size_t>(channel)]);
      const auto place = places.find(SystemTools::LowerCase(color));
      if (place != places.end())
      {
        layers[prefix].Channels[place->second] = channel;
      }
    }
    for (auto& [prefix, layer] : layers)
    {
      if (layer.IsRGB() || layer.Channels[4] >= 0)
      {
        layer.Part = part;
        layer.PartName = !hasParts ? "" : name.empty() ? "part " + std::to_string(part) : name;
        layer.ChannelPrefix = prefix;
        const bool hasBoth = !layer.PartName.empty() && !prefix.empty();
        layer.Name = layer.PartName + (hasBoth ? "." : "") + prefix;
        found.push_back(layer);
      }
    }
  }
  input.seek_subimage(0, 0);
  static_cast<void>(input.geterror()); // of looking for another part
  return found;
}

//------------------------------------------------------------------------------
// Less is better. Blender names what a picture shows "Combined".
int GetRank(const ImageLayer& layer)
{
  const bool isCombined = SystemTools::LowerCase(SplitName(layer.Name).second) == "combined";
  return (isCombined ? 0 : layer.ChannelPrefix.empty() ? 1 : 2) + (layer.IsRGB() ? 0 : 3);
}

//------------------------------------------------------------------------------
std::string ListNames(const std::vector<ImageLayer>& layers)
{
  constexpr std::size_t most = 12;
  std::string list;
  for (std::size_t k = 0; k < std::min(layers.size(), most); ++k)
  {
    list += (k == 0 ? "" : ", ") + layers[k].Describe();
  }
  return list.empty() ? "none" : list + (layers.size() > most ? ", ..." : "");
}

//------------------------------------------------------------------------------
ImageLayer ChooseLayer(const ImageSource& source, OIIO::ImageInput& input, ImageFile& image)
{
  const bool isExr = source.Format->Is("openexr");
  const std::vector<ImageLayer> layers = isExr ? FindLayers(input) : std::vector<ImageLayer>();
  if (!source.Layer.empty())
  {
    const auto found = std::find_if(layers.begin(), layers.end(),
      [&source](const ImageLayer& one)
      {
        return one.Name == source.Layer || one.PartName == source.Layer ||
               one.ChannelPrefix == source.Layer;
      });
    Require(found != layers.end(), source.Path, ": layer: found ", ListNames(layers), ", expected ",
      Quote(source.Layer));
    return *found;
  }
  if (!layers.empty())
  {
    const auto best = std::min_element(layers.begin(), layers.end(),
      [](const ImageLayer& a, const ImageLayer& b) { return GetRank(a) < GetRank(b); });
    if (layers.size() > 1)
    {
      image.Notes.push_back(
        "Of the layers " + ListNames(layers) + ": " + best->Describe() + " was taken.");
    }
    return *best;
  }
  // Formats without layers: colors, or gray, are the first channels.
  const OIIO::ImageSpec& spec = input.spec();
  ImageLayer only;
  only.Channels[4] = 0;
  if (isExr && spec.nchannels > 1)
  {
    image.Notes.push_back(
      "No channels named R, G and B: " + Quote(spec.channelnames.front()) + " was taken as gray.");
    return only;
  }
  const int colors = spec.nchannels >= 3 ? 3 : 1;
  std::iota(only.Channels, only.Channels + (colors == 3 ? 3 : 0), 0);
  only.Channels[3] = spec.alpha_channel == colors ? colors : -1;
  if (input.seek_subimage(1, 0))
  {
    image.Notes.push_back("The file holds several images: the first one was taken.");
    input.seek_subimage(0, 0);
  }
  static_cast<void>(input.geterror());
  return only;
}

//------------------------------------------------------------------------------
void CheckSpec(const ImageSource& source, const OIIO::ImageSpec& spec)
{
  Require(
    spec.depth <= 1, source.Path, ": image size: found ", spec.depth, " slices, expected one");
  Require(
    !spec.deep, source.Path, ": image type: found deep samples, expected one value per texel");
  CheckImageSize(source.Path, *source.Format,
    { double(spec.width), double(spec.height), double(spec.nchannels), double(spec.tile_width),
      double(spec.tile_height) },
    source.FileSize);
}

//------------------------------------------------------------------------------
// The given channels as the first of a texel's values. Blocks of rows are read, so that memory
// follows what the file holds and not what its header promises.
void ReadPixels(const ImageSource& source, OIIO::ImageInput& input, int part,
  const OIIO::ImageSpec& spec, const std::vector<int>& channels, ImageFile& image)
{
  const auto width = static_cast<std::size_t>(spec.width);
  const auto values = static_cast<std::size_t>(image.ValuesPerTexel);
  const auto [first, last] = std::minmax_element(channels.begin(), channels.end());
  const auto span = static_cast<std::size_t>(*last - *first + 1); // read at once
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
    block.resize(width * static_cast<std::size_t>(end - y) * span);
    const bool read =
      spec.tile_width > 0
        ? input.read_tiles(part, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
            spec.z + 1, *first, *last + 1, OIIO::TypeDesc::FLOAT, block.data())
        : input.read_scanlines(part, 0, spec.y + y, spec.y + end, spec.z, *first, *last + 1,
            OIIO::TypeDesc::FLOAT, block.data());
    if (!read)
    {
      const std::string reason = ToLine(input.geterror());
      throw FileError(source.Path, ": image pixels: ", reason,
        reason.empty()
          ? Concat("rows ", y, " to ", end - 1, " could not be read; the file may be cut short")
          : std::string());
    }
    std::size_t at = image.Pixels.size();
    image.Pixels.resize(at + block.size() / span * values);
    for (std::size_t texel = 0; texel < block.size(); texel += span, at += values)
    {
      for (std::size_t k = 0; k < channels.size(); ++k)
      {
        image.Pixels[at + k] = block[texel + static_cast<std::size_t>(channels[k] - *first)];
      }
    }
  }
}

//------------------------------------------------------------------------------
void TakeHeader(const OIIO::ImageSpec& spec, const ImageFormat& format, DecodedImage& image)
{
  const std::string kind(spec.get_string_attribute("textureformat"));
  image.Envmap = kind == "LatLong Environment"    ? ImageEnvmap::LatLong
                 : kind == "CubeFace Environment" ? ImageEnvmap::Cube
                                                  : ImageEnvmap::None;
  image.DisplayWidth = image.Width = spec.width;
  image.DisplayHeight = image.Height = spec.height;
  // Other formats' offsets, as PNG's oFFs, say where the image lies on a page; ImfEnvmap.h maps
  // directions to the data window.
  if (image.Envmap == ImageEnvmap::None && format.Is("openexr"))
  {
    image.Left = spec.x - spec.full_x;
    image.Top = spec.y - spec.full_y;
    image.DisplayWidth = spec.full_width;
    image.DisplayHeight = spec.full_height;
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
  const bool isOpen = input && input->open(source.Path, first, config);
  Require(isOpen, source.Path,
    ": image header: ", ToLine(!isOpen && input ? input->geterror() : OIIO::geterror()));
  CheckSpec(source, first);

  DecodedImage image;
  const ImageLayer layer = ChooseLayer(source, *input, image);
  const bool isFound = input->seek_subimage(layer.Part, 0);
  Require(isFound, source.Path, ": image header: ", ToLine(input->geterror()));
  const OIIO::ImageSpec spec = input->spec();
  CheckSpec(source, spec);
  TakeHeader(spec, *source.Format, image);
  std::vector<int> channels(3, layer.Channels[4]);
  if (layer.IsRGB())
  {
    channels.assign(layer.Channels, layer.Channels + 3);
  }
  const OIIO::TypeDesc type = spec.channelformat(channels[0]);
  image.IsGray = !layer.IsRGB();
  image.ValuesPerTexel = source.Alpha ? 4 : 3;
  image.HasAlpha = source.Alpha && layer.Channels[3] >= 0;
  image.IsInteger = !type.is_floating_point();
  image.IsEncoded = image.IsInteger && !SaysLinear(spec);
  image.HasBytes = type.basetype == OIIO::TypeDesc::UINT8;
  if (image.HasAlpha)
  {
    channels.push_back(layer.Channels[3]);
  }
  ReadPixels(source, *input, layer.Part, spec, channels, image);
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
