// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * This project's material format: an OpenEXR file whose first part's string attribute
 * "measuredBRDF" holds JSON (names, model, numbers; vtkBRDFData), and whose parts hold
 * the tables as 32-bit or 16-bit floats, ZIP-compressed (lossless). Part "volume" or, in term 1 of
 * a sum, "1.volume": width = fastest axis, height = product of the others, channels R, G, B or Y. A
 * material without tables has one part "header" of one texel.
 */

#include "BoundedJson.h"
#include "MaterialFormat.h"
#include "vtkBRDFData.h"
#include "vtkBRDFModels.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <half.h> // Imath, of OpenEXR
#include <limits>
#include <numeric>

namespace measuredbrdf
{
namespace
{
using nlohmann::json;

constexpr const char* ExrFormatName = "OpenEXR material";
constexpr const char* AttributeName = "measuredBRDF";
constexpr const char* JsonFormat = "measured-brdf";
constexpr int JsonVersion = 1;
constexpr int MaximumDepth = 16; // of terms in terms

// ZIP (deflate) shrinks by 1032 at most; what a header promises beyond that is a lie.
constexpr double MaximumCompression = 1032.0;

const std::array<const char*, 3> ColorChannels = { "R", "G", "B" };
const char* const GrayChannel = "Y";

const char* GetChannelName(int channels, int channel)
{
  return channels == 3 ? ColorChannels[channel] : GrayChannel;
}

//------------------------------------------------------------------------------
// A file in memory as OpenEXR reads it.
class ExrStream : public Imf::IStream
{
public:
  explicit ExrStream(const FileBytes& file)
    : Imf::IStream(file.GetPath().c_str())
    , File(file)
  {
  }

  bool read(char out[], int count) override
  {
    const std::uint64_t left = this->File.GetView().size() - this->Place;
    if (count < 0 || static_cast<std::uint64_t>(count) > left)
    {
      throw Iex::InputExc("byte " + std::to_string(this->Place) + ": " + std::to_string(count) +
                          " bytes were expected, but the file ends after " + std::to_string(left));
    }
    std::memcpy(out, this->File.GetView().data() + this->Place, static_cast<std::size_t>(count));
    this->Place += static_cast<std::uint64_t>(count);
    return this->Place < this->File.GetView().size();
  }
  std::uint64_t tellg() override { return this->Place; }
  void seekg(std::uint64_t place) override
  {
    if (place > this->File.GetView().size())
    {
      throw Iex::InputExc("an offset points to byte " + std::to_string(place) +
                          ", but the file ends at " + std::to_string(this->File.GetView().size()));
    }
    this->Place = place;
  }

private:
  const FileBytes& File;
  std::uint64_t Place = 0;
};

// A part's channels, interleaved, the top row first.
void ReadPixels(Imf::MultiPartInputFile& input, int index, int channels, std::vector<float>& values)
{
  Imf::InputPart part(input, index);
  const Imath::Box2i window = part.header().dataWindow();
  const std::size_t width = std::size_t(window.max.x) - std::size_t(window.min.x) + 1;
  const std::size_t height = std::size_t(window.max.y) - std::size_t(window.min.y) + 1;
  const std::size_t texel = std::size_t(channels);
  values.resize(texel * width * height);
  Imf::FrameBuffer buffer;
  for (int k = 0; k < channels; ++k)
  {
    buffer.insert(
      GetChannelName(channels, k), Imf::Slice::Make(Imf::FLOAT, &values[std::size_t(k)], window,
                                     sizeof(float) * texel, sizeof(float) * texel * width));
  }
  part.setFrameBuffer(buffer);
  part.readPixels(window.min.y, window.max.y);
}

//------------------------------------------------------------------------------
// The pixels of the part that holds an array; an empty box where OpenEXR has no such image.
Imath::Box2i GetWindow(const std::vector<int>& shape)
{
  constexpr double most = std::numeric_limits<int>::max() / 2;
  double rows = 1.0;
  double width = 1.0;
  bool fits = true;
  for (const int size : shape)
  {
    rows *= width;
    width = size;
    fits = fits && size >= 1;
  }
  return fits && rows <= most && width <= most
           ? Imath::Box2i({ 0, 0 }, { static_cast<int>(width) - 1, static_cast<int>(rows) - 1 })
           : Imath::Box2i();
}

//------------------------------------------------------------------------------
struct Part
{
  std::string Name;
  const vtkBRDFData::Array* Array;
};

json ToJson(const vtkBRDFData& data, const std::string& prefix, std::vector<Part>& parts)
{
  json object;
  object["representation"] = data.Model;
  object["name"] = data.Name;
  object["source"] = data.Source;
  object["options"] = data.Options;
  object["numbers"] = data.Numbers;
  object["arrays"] = json::object();
  for (const auto& array : data.Arrays)
  {
    parts.push_back({ prefix + array.first, &array.second });
    object["arrays"][array.first] = { { "shape", array.second.Shape },
      { "channels", array.second.Channels } };
  }
  object["terms"] = json::array();
  for (std::size_t k = 0; k < data.Terms.size(); ++k)
  {
    object["terms"].push_back(ToJson(data.Terms[k], prefix + std::to_string(k) + ".", parts));
  }
  return object;
}

//------------------------------------------------------------------------------
// Invalid cells (NaN) stay invalid.
std::vector<half> RoundToHalf(const vtkBRDFData::Array& array, const std::string& name)
{
  std::vector<half> rounded;
  rounded.reserve(array.Values.size());
  for (const float value : array.Values)
  {
    rounded.emplace_back(value);
    const bool isTooLarge = std::isfinite(value) && !rounded.back().isFinite();
    Require(!isTooLarge, "array '", name, "': ", value,
      " is too large for a 16-bit float; write 32-bit floats");
  }
  return rounded;
}

//------------------------------------------------------------------------------
// One per part. All must share one display window: the smallest that covers all.
std::vector<Imf::Header> MakeHeaders(const std::vector<Part>& parts, Imf::PixelType type)
{
  Imath::Box2i display(Imath::V2i(0, 0), Imath::V2i(0, 0));
  std::vector<Imf::Header> headers;
  for (const Part& part : parts)
  {
    const Imath::Box2i window = GetWindow(part.Array->Shape);
    Require(!window.isEmpty(), "array ", Quote(part.Name), " is too large for an image");
    display.extendBy(window);
    Imf::Header& exr = headers.emplace_back(window, window);
    exr.compression() = Imf::ZIP_COMPRESSION;
    exr.setName(part.Name);
    exr.setType(Imf::SCANLINEIMAGE);
    for (int k = 0; k < part.Array->Channels; ++k)
    {
      exr.channels().insert(GetChannelName(part.Array->Channels, k), Imf::Channel(type));
    }
  }
  for (Imf::Header& exr : headers)
  {
    exr.displayWindow() = display;
  }
  return headers;
}

//------------------------------------------------------------------------------
void WritePart(Imf::MultiPartOutputFile& output, int index, const Part& part,
  const Imath::Box2i& window, bool halfFloats)
{
  const vtkBRDFData::Array& array = *part.Array;
  const std::vector<half> rounded =
    halfFloats ? RoundToHalf(array, part.Name) : std::vector<half>();
  const char* values = halfFloats ? reinterpret_cast<const char*>(rounded.data())
                                  : reinterpret_cast<const char*>(array.Values.data());
  const std::size_t size = halfFloats ? sizeof(half) : sizeof(float);
  const std::size_t texel = size * array.Channels;
  Imf::FrameBuffer buffer;
  for (int channel = 0; channel < array.Channels; ++channel)
  {
    buffer.insert(GetChannelName(array.Channels, channel),
      Imf::Slice(halfFloats ? Imf::HALF : Imf::FLOAT, const_cast<char*>(values) + size * channel,
        texel, texel * (window.max.x + 1)));
  }
  Imf::OutputPart out(output, index);
  out.setFrameBuffer(buffer);
  out.writePixels(window.max.y + 1);
}

//------------------------------------------------------------------------------
// Reads parts by name; every size is checked before anything is allocated.
class PartReader
{
public:
  PartReader(Imf::MultiPartInputFile& input, std::size_t fileSize)
    : Input(input)
    , BytesLeft(double(fileSize) * MaximumCompression)
  {
    for (int k = 0; k < input.parts(); ++k)
    {
      if (input.header(k).hasName())
      {
        this->Parts[input.header(k).name()] = k;
      }
    }
  }

  void Read(const std::string& name, vtkBRDFData::Array& array)
  {
    const auto require = [&name](bool condition, const auto&... what)
    { Require(condition, "part ", Quote(name), what...); };
    const auto found = this->Parts.find(name);
    require(found != this->Parts.end(), " is missing");
    const Imf::Header& header = this->Input.header(found->second);
    const Imath::Box2i window = GetWindow(array.Shape);
    require(!window.isEmpty() && header.dataWindow() == window,
      ": its data window does not hold the shape that attribute '", AttributeName, "' gives");
    require(!header.hasType() || header.type() == Imf::SCANLINEIMAGE, ": expected type ",
      Imf::SCANLINEIMAGE);
    int channels = 0;
    double texelBytes = 0.0; // in the file
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
    {
      const Imf::Channel& channel = it.channel();
      ++channels;
      texelBytes += channel.type == Imf::HALF ? sizeof(half) : sizeof(float);
      require((channel.type == Imf::FLOAT || channel.type == Imf::HALF) && channel.xSampling == 1 &&
                channel.ySampling == 1,
        ", channel ", Quote(it.name()), ": expected 32-bit or 16-bit floats, not subsampled");
    }
    require(
      channels == array.Channels, ": found ", channels, " channels, expected ", array.Channels);
    this->BytesLeft -= (window.max.x + 1.0) * (window.max.y + 1.0) * texelBytes;
    require(this->BytesLeft >= 0.0, ": its size is more than a file of this length can hold");
    for (int k = 0; k < channels; ++k)
    {
      const char* channel = GetChannelName(channels, k);
      require(
        header.channels().findChannel(channel) != nullptr, ": channel ", channel, " is missing");
    }
    try
    {
      ReadPixels(this->Input, found->second, channels, array.Values);
    }
    catch (const std::exception& e)
    {
      require(false, ": ", e.what());
    }
  }

private:
  Imf::MultiPartInputFile& Input;
  std::map<std::string, int> Parts;
  double BytesLeft;
};

//------------------------------------------------------------------------------
// Before memory is allocated for the values.
void CheckSize(const std::string& model, const vtkBRDFData::Array& array)
{
  const double values = std::accumulate(
    array.Shape.begin(), array.Shape.end(), double(array.Channels), std::multiplies<>());
  const double most = vtkBRDFModels::GetMaximumArraySize(model);
  Require(values <= most, model, ": an array has ", values, " values, expected at most ",
    std::llround(most));
}

//------------------------------------------------------------------------------
vtkBRDFData FromJson(const json& object, const std::string& prefix, PartReader& parts, int depth)
{
  Require(depth <= MaximumDepth, "terms are nested too deeply");
  vtkBRDFData data;
  object.at("representation").get_to(data.Model);
  object.at("name").get_to(data.Name);
  object.at("source").get_to(data.Source);
  object.at("options").get_to(data.Options);
  object.at("numbers").get_to(data.Numbers);
  for (const auto& item : object.at("arrays").items())
  {
    vtkBRDFData::Array& array = data.Arrays[item.key()];
    item.value().at("shape").get_to(array.Shape);
    item.value().at("channels").get_to(array.Channels);
    Require(array.Channels == 1 || array.Channels == 3, "array ", Quote(item.key()),
      ": expected 1 or 3 channels");
    CheckSize(data.Model, array);
    parts.Read(prefix + item.key(), array);
  }
  std::size_t index = 0;
  for (const json& term : object.at("terms"))
  {
    data.Terms.push_back(FromJson(term, prefix + std::to_string(index) + ".", parts, depth + 1));
    ++index;
  }
  return data;
}

//------------------------------------------------------------------------------
void CountValues(const vtkBRDFData& data, MaterialFile& result)
{
  for (const auto& array : data.Arrays)
  {
    for (const float value : array.second.Values)
    {
      result.NumberOfNegativeValues += std::isfinite(value) && value < 0.0f;
      result.NumberOfInvalidValues += !std::isfinite(value);
    }
  }
  for (const vtkBRDFData& term : data.Terms)
  {
    CountValues(term, result);
  }
}
//------------------------------------------------------------------------------
MaterialFile ReadExrMaterial(const FileBytes& file, const std::string&)
{
  CheckExrHeader(file, ExrFormatName);
  const std::string place = file.GetPath() + ": " + ExrFormatName + ", ";
  try
  {
    ExrStream stream(file);
    // Files whose table of offsets is incomplete are refused, not repaired.
    Imf::MultiPartInputFile input(stream, 0, false);
    const auto* attribute =
      input.parts() > 0 ? input.header(0).findTypedAttribute<Imf::StringAttribute>(AttributeName)
                        : nullptr;
    Require(attribute != nullptr, "string attribute '", AttributeName,
      "' is missing: an OpenEXR image, but no material of this project");
    const json header = ParseJson<json>(attribute->value());
    const std::string format = header.at("format").get<std::string>();
    const int version = header.at("version").get<int>();
    Require(!(format != JsonFormat || version != JsonVersion), "found format ", Quote(format),
      " version ", version, ", expected '", JsonFormat, "' version ", JsonVersion);
    PartReader parts(input, file.GetView().size());
    vtkBRDFData data = FromJson(header.at("material"), "", parts, 0);
    MaterialFile result;
    CountValues(data, result);
    const std::string problem = vtkBRDFModels::Load(data, result.BRDF);
    Require(problem.empty(), problem);
    return result;
  }
  catch (const json::exception& e)
  {
    throw FileError(place, "attribute '", AttributeName, "': ", ToPrintable(e.what(), 500));
  }
  catch (const Iex::BaseExc& e)
  {
    throw FileError(place, "header: ", e.what());
  }
  catch (const std::exception& e)
  {
    throw FileError(place, e.what());
  }
}

//------------------------------------------------------------------------------
// halfFloats: tables as 16-bit floats, a rounding of 2^-11; else 32-bit ones, bit by bit.
void WriteExrMaterial(vtkBRDF* brdf, const std::string& path, bool halfFloats)
{
  Imf::StdOSStream stream;
  try
  {
    vtkBRDFData data;
    const std::string problem = vtkBRDFModels::Save(brdf, data);
    Require(problem.empty(), problem);
    std::vector<Part> parts;
    json header;
    header["format"] = JsonFormat;
    header["version"] = JsonVersion;
    header["material"] = ToJson(data, "", parts);
    const vtkBRDFData::Array texel = { { 1 }, 1, { 0.0f } };
    if (parts.empty())
    {
      parts.push_back({ "header", &texel });
    }

    std::vector<Imf::Header> headers = MakeHeaders(parts, halfFloats ? Imf::HALF : Imf::FLOAT);
    // Text that is not UTF-8 gets replacement characters: JSON can't hold it.
    headers[0].insert(AttributeName,
      Imf::StringAttribute(header.dump(-1, ' ', false, json::error_handler_t::replace)));

    Imf::MultiPartOutputFile output(
      stream, headers.data(), static_cast<int>(headers.size()), false, 0);
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      WritePart(output, static_cast<int>(k), parts[k], headers[k].dataWindow(), halfFloats);
    }
  }
  catch (const std::exception& e)
  {
    throw FileError(path, ": ", ExrFormatName, ": ", e.what());
  }
  WriteFile(path, stream.str());
}
}

//------------------------------------------------------------------------------
std::vector<float> ReadExrImage(const FileBytes& file, int& width, int& height)
{
  ExrStream stream(file);
  Imf::MultiPartInputFile input(stream, 0, false);
  const Imath::V2i size = input.header(0).dataWindow().size();
  width = size.x + 1;
  height = size.y + 1;
  std::vector<float> values;
  ReadPixels(input, 0, 3, values);
  return values;
}

//------------------------------------------------------------------------------
const MaterialFormat ExrMaterialFormat = { ExrFormatName, "this project's .exr", ".exr",
  [](const vtkBRDFFormat::File& file)
  { return HasMagic(file, std::string_view(ExrMagic, sizeof(ExrMagic) - 1)); },
  ReadExrMaterial, nullptr, WriteExrMaterial };
} // namespace measuredbrdf
