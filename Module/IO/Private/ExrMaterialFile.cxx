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
#include "ExrStream.h"
#include "FileBytes.h"
#include "MaterialFormat.h"
#include "NumberText.h"
#include "vtkBRDFData.h"
#include "vtkBRDFModels.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <algorithm>
#include <array>
#include <cmath>
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
class MemoryOutput : public Imf::OStream
{
public:
  MemoryOutput()
    : Imf::OStream("memory")
  {
  }

  void write(const char bytes[], int count) override
  {
    const std::size_t end = this->Place + static_cast<std::size_t>(count);
    if (end > this->Bytes.size())
    {
      this->Bytes.resize(end);
    }
    std::memcpy(&this->Bytes[this->Place], bytes, static_cast<std::size_t>(count));
    this->Place = end;
  }
  std::uint64_t tellp() override { return this->Place; }
  void seekp(std::uint64_t place) override { this->Place = static_cast<std::size_t>(place); }

  const std::string& GetBytes() const { return this->Bytes; }

private:
  std::string Bytes;
  std::size_t Place = 0;
};

//------------------------------------------------------------------------------
// The pixels of the part that holds an array; an empty box where OpenEXR has no such image.
Imath::Box2i GetWindow(const std::vector<int>& shape)
{
  constexpr double most = std::numeric_limits<int>::max() / 2;
  double rows = 1.0;
  double width = 1.0;
  double least = 1.0;
  for (const int size : shape)
  {
    rows *= width;
    width = size;
    least = std::min(least, width);
  }
  if (least < 1.0 || rows > most || width > most)
  {
    return {};
  }
  return { Imath::V2i(0, 0), Imath::V2i(static_cast<int>(width) - 1, static_cast<int>(rows) - 1) };
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
    if (std::isfinite(value) && !rounded.back().isFinite())
    {
      throw std::runtime_error("array '" + name + "': " + std::to_string(value) +
                               " is too large for a 16-bit float; write 32-bit floats");
    }
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
    if (window.isEmpty())
    {
      throw std::runtime_error("array " + Quote(part.Name) + " is too large for an image");
    }
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
    const auto fail = [&name](const std::string& what)
    { throw std::runtime_error("part " + Quote(name) + what); };
    const auto found = this->Parts.find(name);
    if (found == this->Parts.end())
    {
      fail(" is missing");
    }
    const Imf::Header& header = this->Input.header(found->second);
    const Imath::Box2i window = GetWindow(array.Shape);
    if (window.isEmpty() || header.dataWindow() != window)
    {
      fail(std::string(": its data window does not hold the shape that attribute '") +
           AttributeName + "' gives");
    }
    if (header.hasType() && header.type() != Imf::SCANLINEIMAGE)
    {
      fail(": found type " + Quote(header.type()) + ", expected " + Imf::SCANLINEIMAGE);
    }
    int channels = 0;
    double texelBytes = 0.0; // in the file
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
    {
      const Imf::Channel& channel = it.channel();
      ++channels;
      texelBytes += channel.type == Imf::HALF ? sizeof(half) : sizeof(float);
      if ((channel.type != Imf::FLOAT && channel.type != Imf::HALF) || channel.xSampling != 1 ||
          channel.ySampling != 1)
      {
        fail(
          ", channel " + Quote(it.name()) + ": expected 32-bit or 16-bit floats, not subsampled");
      }
    }
    if (channels != array.Channels)
    {
      fail(": found " + std::to_string(channels) + " channels, expected " +
           std::to_string(array.Channels));
    }
    const int height = window.max.y + 1;
    const std::size_t row = std::size_t(window.max.x + 1) * std::size_t(array.Channels);
    this->BytesLeft -= (window.max.x + 1.0) * height * texelBytes;
    if (this->BytesLeft < 0.0)
    {
      fail(": its size is more than a file of this length can hold");
    }
    array.Values.resize(row * std::size_t(height));
    Imf::FrameBuffer buffer;
    for (int k = 0; k < array.Channels; ++k)
    {
      const char* channel = GetChannelName(array.Channels, k);
      if (!header.channels().findChannel(channel))
      {
        fail(std::string(": channel ") + channel + " is missing");
      }
      buffer.insert(channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&array.Values[k]),
                               sizeof(float) * array.Channels, sizeof(float) * row));
    }
    try
    {
      Imf::InputPart part(this->Input, found->second);
      part.setFrameBuffer(buffer);
      part.readPixels(0, height - 1);
    }
    catch (const std::exception& e)
    {
      fail(std::string(": ") + e.what());
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
  if (values > most)
  {
    throw std::runtime_error(model + ": an array has " + NumberText(values) +
                             " values, expected at most " + std::to_string(std::llround(most)));
  }
}

//------------------------------------------------------------------------------
vtkBRDFData FromJson(const json& object, const std::string& prefix, PartReader& parts, int depth)
{
  if (depth > MaximumDepth)
  {
    throw std::runtime_error("terms are nested too deeply");
  }
  vtkBRDFData data;
  data.Model = object.at("representation").get<std::string>();
  data.Name = object.at("name").get<std::string>();
  data.Source = object.at("source").get<std::string>();
  data.Options = object.at("options").get<std::map<std::string, std::string>>();
  data.Numbers = object.at("numbers").get<std::map<std::string, std::vector<double>>>();
  for (const auto& item : object.at("arrays").items())
  {
    vtkBRDFData::Array& array = data.Arrays[item.key()];
    array.Shape = item.value().at("shape").get<std::vector<int>>();
    array.Channels = item.value().at("channels").get<int>();
    if (array.Channels != 1 && array.Channels != 3)
    {
      throw std::runtime_error("array " + Quote(item.key()) + ": expected 1 or 3 channels");
    }
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
    const Imf::StringAttribute* attribute = nullptr;
    if (input.parts() > 0)
    {
      attribute = input.header(0).findTypedAttribute<Imf::StringAttribute>(AttributeName);
    }
    if (!attribute)
    {
      throw std::runtime_error(std::string("string attribute '") + AttributeName +
                               "' is missing: an OpenEXR image, but no material of this project");
    }
    const json header = ParseJson<json>(attribute->value());
    const std::string format = header.at("format").get<std::string>();
    const int version = header.at("version").get<int>();
    if (format != JsonFormat || version != JsonVersion)
    {
      throw std::runtime_error("found format " + Quote(format) + " version " +
                               std::to_string(version) + ", expected '" + JsonFormat +
                               "' version " + std::to_string(JsonVersion));
    }
    PartReader parts(input, file.GetSize());
    vtkBRDFData data = FromJson(header.at("material"), "", parts, 0);
    MaterialFile result;
    CountValues(data, result);
    const std::string problem = vtkBRDFModels::Load(data, result.BRDF);
    if (!problem.empty())
    {
      throw std::runtime_error(problem);
    }
    return result;
  }
  catch (const json::exception& e)
  {
    throw FileError(place + "attribute '" + AttributeName + "': " + ToPrintable(e.what(), 500));
  }
  catch (const Iex::BaseExc& e)
  {
    throw FileError(place + "header: " + e.what());
  }
  catch (const std::exception& e)
  {
    throw FileError(place + e.what());
  }
}

//------------------------------------------------------------------------------
// halfFloats: tables as 16-bit floats, a rounding of 2^-11; else 32-bit ones, bit by bit.
void WriteExrMaterial(vtkBRDF* brdf, const std::string& path, bool halfFloats)
{
  try
  {
    vtkBRDFData data;
    const std::string problem = vtkBRDFModels::Save(brdf, data);
    if (!problem.empty())
    {
      throw std::runtime_error(problem);
    }
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

    MemoryOutput stream;
    {
      Imf::MultiPartOutputFile output(
        stream, headers.data(), static_cast<int>(headers.size()), false, 0);
      for (std::size_t k = 0; k < parts.size(); ++k)
      {
        WritePart(output, static_cast<int>(k), parts[k], headers[k].dataWindow(), halfFloats);
      }
    }
    WriteFile(path, stream.GetBytes());
  }
  catch (const FileError&)
  {
    throw;
  }
  catch (const std::exception& e)
  {
    throw FileError(path + ": " + ExrFormatName + ": " + e.what());
  }
}

}

const MaterialFormat ExrMaterialFormat = { ExrFormatName, "this project's .exr", ".exr",
  [](const vtkBRDFFormat::File& file)
  { return HasMagic(file, std::string_view(ExrMagic, sizeof(ExrMagic) - 1)); },
  ReadExrMaterial, nullptr, WriteExrMaterial };
} // namespace measuredbrdf
