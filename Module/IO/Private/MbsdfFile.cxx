// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * NVIDIA's `.mbsdf` (MDL specification, appendix B): a magic line, lines of key="value", then a
 * block of values over (theta_in, theta_out, phi), phi fastest. Only reflection is read.
 */

#include "MaterialFormat.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <cmath>
#include <string_view>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr std::uint32_t LargestSide = 2048; // vtkTabulatedBRDF's

constexpr const char* MbsdfFormatName = "NVIDIA MBSDF";
constexpr std::string_view Magic = "NVIDIA ARC MBSDF V1"; // a line
constexpr std::string_view TransmissionLine = "MBSDF_DATA_TRANSMISSION=";

struct Block
{
  std::size_t Channels = 1;
  int NumberOfTheta = 0;
  int NumberOfPhi = 0;
  std::size_t Values = 0;
  const char* Data = nullptr;
};

//------------------------------------------------------------------------------
// Lines may end as DOS has them.
std::string_view ReadLine(ByteReader& reader)
{
  const std::string_view line = reader.TakeUntil(
    '\n', "header line", "no end of line, and no MBSDF_DATA before the file's end");
  return line.substr(0, !line.empty() && line.back() == '\r' ? line.size() - 1 : line.size());
}

//------------------------------------------------------------------------------
int ReadSize(ByteReader& reader, const std::string& field)
{
  const auto size = reader.Read<std::uint32_t>(field);
  reader.Require(
    size >= 1 && size <= LargestSide, field, "found ", size, ", expected 1 to ", LargestSide);
  return static_cast<int>(size);
}

//------------------------------------------------------------------------------
Block ReadBlock(ByteReader& reader, const std::string& name)
{
  const auto type = reader.Read<std::uint32_t>(name + " type");
  reader.Require(type <= 1, name + " type", "found ", type, ", expected 0 (scalar) or 1 (RGB)");
  Block block;
  block.Channels = type == 1 ? 3 : 1;
  block.NumberOfTheta = ReadSize(reader, name + " number of theta");
  block.NumberOfPhi = ReadSize(reader, name + " number of phi");
  block.Values = block.Channels * block.NumberOfTheta * block.NumberOfTheta * block.NumberOfPhi;
  block.Data = reader.Take(std::uint64_t(block.Values) * sizeof(float), name + " values");
  return block;
}

//------------------------------------------------------------------------------
// Steps over the lines before the reflection; result takes them as notes.
void ReadHeader(ByteReader& reader, MaterialFile& result)
{
  reader.Require(ReadLine(reader) == Magic, "magic", "expected the line 'NVIDIA ARC MBSDF V1'");
  for (std::string_view line = ReadLine(reader);
       line != "MBSDF_DATA=" && line != "MBSDF_DATA_REFLECTION="; line = ReadLine(reader))
  {
    reader.Require(line != TransmissionLine, "MBSDF_DATA_TRANSMISSION",
      "the file holds transmission only, no reflection");
    reader.Require(line.empty() || line.find('=') != std::string_view::npos, "header line",
      "expected key=\"value\" or MBSDF_DATA_REFLECTION=");
    if (!line.empty())
    {
      result.AddNote("File header: " + std::string(line));
    }
  }
}

//------------------------------------------------------------------------------
// What follows the reflection: transmission, padding or nothing.
void ReadRest(ByteReader& reader, MaterialFile& result)
{
  if (!reader.IsPadding())
  {
    reader.Require(ReadLine(reader) == TransmissionLine, "end",
      "expected the file's end or MBSDF_DATA_TRANSMISSION=");
    ReadBlock(reader, "transmission");
    reader.Require(
      reader.IsPadding(), "end", reader.GetRemaining(), " bytes follow the transmission values");
    result.AddNote("The file's transmission is left out.");
  }
  NotePadding(reader, result);
}

//------------------------------------------------------------------------------
// RGB of each cell. result counts values as they are stored: a scalar once.
std::vector<float> GetRGB(const Block& block, MaterialFile& result)
{
  std::vector<float> stored(block.Values);
  ByteReader::Copy(stored.data(), block.Data, stored.size());
  for (const float value : stored)
  {
    result.NumberOfNegativeValues += std::isfinite(value) && value < 0.0f;
    result.NumberOfInvalidValues += !std::isfinite(value);
  }
  NoteCount(result.NumberOfInvalidValues,
    " values are not finite: their cells are invalid, interpolation skips them.", result);
  NoteCount(result.NumberOfNegativeValues,
    Concat(" of ", block.Values, " values are negative: kept, clamped at 0 after interpolation."),
    result);
  std::vector<float> rgb;
  for (std::size_t k = 0; k < 3 * stored.size() / block.Channels; ++k)
  {
    rgb.push_back(block.Channels == 3 ? stored[k] : stored[k / 3]);
  }
  return rgb;
}

//------------------------------------------------------------------------------
MaterialFile ReadMbsdf(const FileBytes& file, const std::string&)
{
  ByteReader reader(file, MbsdfFormatName);
  MaterialFile result;
  ReadHeader(reader, result);
  const Block block = ReadBlock(reader, "reflection");
  ReadRest(reader, result);
  std::vector<float> rgb = GetRGB(block, result);
  result.AddNote("Samples are taken to lie at the centers of their cells, theta over [0, pi/2], "
                 "delta phi over [0, pi] (mirror-symmetric).");
  const int dimensions[3] = { block.NumberOfPhi, block.NumberOfTheta, block.NumberOfTheta };
  vtkNew<vtkTabulatedBRDF> table;
  reader.Require(table->SetVolume(vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::HALF_TURN,
                   dimensions, std::move(rgb)),
    "reflection values", "the table was refused");
  result.BRDF = table;
  NameAfterFile(result, file, MbsdfFormatName);
  return result;
}
}

const MaterialFormat MbsdfFormat = { MbsdfFormatName, "NVIDIA .mbsdf", ".mbsdf",
  [](const vtkBRDFFormat::File& file) { return HasMagic(file, Magic); }, ReadMbsdf };
} // namespace measuredbrdf
