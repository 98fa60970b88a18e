// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFile.h"

#include "FileBytes.h"

#include <ImfChannelList.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfTileDescription.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace measuredbrdf
{
namespace
{
using vtksys::SystemTools;

// A layer of an image: which part it is in, and its channels.
struct ImageLayer
{
  int Part = 0;
  std::string PartName;
  std::string ChannelPrefix;
  std::string Name;        // of both
  std::string Channels[5]; // red, green, blue, alpha, gray; empty: none

  bool IsRGB() const
  {
    return !Channels[0].empty() && !Channels[1].empty() && !Channels[2].empty();
  }

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

bool IsDeep(const Imf::Header& header)
{
  return header.hasType() && Imf::isDeepData(header.type());
}

//------------------------------------------------------------------------------
// OpenEXR names a channel "LAYER.R", "R" without a layer; parts have names of their own. "Y" is
// gray. Layers of other channels, such as depth, are none here.
std::vector<ImageLayer> FindLayers(const Imf::MultiPartInputFile& input)
{
  static const std::map<std::string, int> places = { { "r", 0 }, { "red", 0 }, { "g", 1 },
    { "green", 1 }, { "b", 2 }, { "blue", 2 }, { "a", 3 }, { "alpha", 3 }, { "y", 4 } };
  std::vector<ImageLayer> found;
  for (int part = 0; part < input.parts(); ++part)
  {
    const Imf::Header& header = input.header(part);
    std::map<std::string, ImageLayer> layers; // by their prefixes
    for (auto it = header.channels().begin(); !IsDeep(header) && it != header.channels().end();
         ++it)
    {
      const auto [prefix, color] = SplitName(it.name());
      const auto place = places.find(SystemTools::LowerCase(color));
      if (place != places.end())
      {
        layers[prefix].Channels[place->second] = it.name();
      }
    }
    for (auto& [prefix, layer] : layers)
    {
      if (layer.IsRGB() || !layer.Channels[4].empty())
      {
        layer.Part = part;
        layer.PartName = input.parts() == 1 ? ""
                         : header.hasName() ? header.name()
                                            : "part " + std::to_string(part);
        layer.ChannelPrefix = prefix;
        const bool hasBoth = !layer.PartName.empty() && !prefix.empty();
        layer.Name = layer.PartName + (hasBoth ? "." : "") + prefix;
        found.push_back(layer);
      }
    }
  }
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
ImageLayer ChooseLayer(
  const ImageSource& source, const Imf::MultiPartInputFile& input, std::vector<std::string>& notes)
{
  const std::vector<ImageLayer> layers = FindLayers(input);
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
      notes.push_back(
        "Of the layers " + ListNames(layers) + ": " + best->Describe() + " was taken.");
    }
    return *best;
  }
  const Imf::ChannelList& channels = input.header(0).channels();
  Require(!IsDeep(input.header(0)), source.Path,
    ": image type: found deep samples, expected one value per texel");
  Require(channels.begin() != channels.end(), source.Path, ": image channels: found none");
  ImageLayer only;
  only.Channels[4] = channels.begin().name();
  if (++channels.begin() != channels.end())
  {
    notes.push_back(
      "No channels named R, G and B: " + Quote(only.Channels[4]) + " was taken as gray.");
  }
  return only;
}

//------------------------------------------------------------------------------
// Before anything of that size is allocated.
void CheckHeader(const ImageSource& source, const Imf::Header& header)
{
  const Imath::Box2i& window = header.dataWindow();
  int channels = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it, ++channels)
  {
    const Imf::Channel& channel = it.channel();
    Require(channel.xSampling == 1 && channel.ySampling == 1, source.Path, ": image channel ",
      Quote(it.name()), ": found every ", channel.xSampling, ". by ", channel.ySampling,
      ". texel, expected all");
  }
  const bool isTiled = header.hasTileDescription();
  CheckImageSize(source.Path, *source.Format,
    { double(window.max.x) - window.min.x + 1.0, double(window.max.y) - window.min.y + 1.0,
      double(channels), isTiled ? double(header.tileDescription().xSize) : 0.0,
      isTiled ? double(header.tileDescription().ySize) : 0.0 },
    source.FileSize);
}

//------------------------------------------------------------------------------
void TakeHeader(const Imf::Header& header, DecodedImage& image)
{
  if (Imf::hasEnvmap(header)) // ImfEnvmap.h maps directions to the data window
  {
    image.Envmap =
      Imf::envmap(header) == Imf::ENVMAP_CUBE ? ImageEnvmap::Cube : ImageEnvmap::LatLong;
  }
  else
  {
    const Imath::Box2i& display = header.displayWindow();
    image.Left = header.dataWindow().min.x - display.min.x;
    image.Top = header.dataWindow().min.y - display.min.y;
    image.DisplayWidth = display.max.x - display.min.x + 1;
    image.DisplayHeight = display.max.y - display.min.y + 1;
  }
  if (const auto* orientation = header.findTypedAttribute<Imf::IntAttribute>("Orientation"))
  {
    image.Orientation = orientation->value();
  }
  if (Imf::hasChromaticities(header))
  {
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    image.Chromaticities = { c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x,
      c.white.y };
  }
}

//------------------------------------------------------------------------------
// Blocks of rows are read, so that memory follows what the file holds and not what its header
// promises.
void ReadLayer(Imf::InputPart part, const ImageLayer& layer, DecodedImage& image)
{
  const Imath::Box2i window = part.header().dataWindow();
  const auto values = static_cast<std::size_t>(image.ValuesPerTexel);
  const std::size_t row = values * static_cast<std::size_t>(image.Width);
  Imf::FrameBuffer buffer;
  const auto take = [&](const std::string& channel, std::size_t place)
  {
    buffer.insert(channel, Imf::Slice::Make(Imf::FLOAT, image.Pixels.data() + place, window,
                             sizeof(float) * values, sizeof(float) * row));
  };
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (layer.IsRGB() || k == 0)
    {
      take(layer.Channels[layer.IsRGB() ? k : 4], k);
    }
  }
  if (image.HasAlpha)
  {
    take(layer.Channels[3], 3);
  }
  part.setFrameBuffer(buffer);
  const int rows = std::max(static_cast<int>(BlockTexels) / image.Width, 1);
  for (int y = 0; y < image.Height; y += rows)
  {
    const int end = std::min(y + rows, image.Height);
    const std::size_t begin = image.Pixels.size();
    image.Pixels.resize(row * static_cast<std::size_t>(end));
    part.readPixels(window.min.y + y, window.min.y + end - 1);
    for (std::size_t at = begin; image.IsGray && at < image.Pixels.size(); at += values)
    {
      image.Pixels[at + 1] = image.Pixels[at + 2] = image.Pixels[at];
    }
  }
}
}

//------------------------------------------------------------------------------
DecodedImage DecodeExrImage(const ImageSource& source)
{
  CheckExrHeader(FileBytes(source.Path), "OpenEXR image");
  const char* place = ": image header: ";
  try
  {
    // Files whose table of offsets is incomplete are refused, not repaired.
    Imf::MultiPartInputFile input(source.Path.c_str(), 0, false);
    std::vector<std::string> notes;
    const ImageLayer layer = ChooseLayer(source, input, notes);
    const Imf::Header& header = input.header(layer.Part);
    CheckHeader(source, header);
    const Imath::V2i last = header.dataWindow().size(); // the other corner
    DecodedImage image(source, last.x + 1, last.y + 1, !layer.IsRGB(), !layer.Channels[3].empty());
    image.Notes = notes;
    TakeHeader(header, image);
    place = ": image pixels: ";
    ReadLayer(Imf::InputPart(input, layer.Part), layer, image);
    return image;
  }
  catch (const FileError&)
  {
    throw;
  }
  catch (const std::exception& e)
  {
    throw FileError(source.Path, place, e.what());
  }
}
} // namespace measuredbrdf
