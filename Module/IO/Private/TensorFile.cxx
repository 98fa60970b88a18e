// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The RGL-EPFL database's "tensor_file" (Dupuy and Jakob 2018; layout after the authors' loader
 * github.com/rgl-epfl/brdf-loader): 12 bytes of magic, version 1.0, then named fields with type,
 * shape and the offset of their data. Both forms are read: NAME_rgb.bsdf, and NAME_spec.bsdf, whose
 * field "spectra" has one f cos(theta_o) for each of the field "wavelengths" (nm). Spectra become
 * RGB as SpectralColor.h says: sums over the CIE 1931 color-matching functions under D65.
 */

#include "Floats.h"
#include "MaterialFormat.h"
#include "NumberText.h"
#include "SpectralColor.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr const char* TensorFormatName = "RGL tensor file";
constexpr const char TensorMagic[] = "tensor_file"; // with its terminating zero

enum DataType : int
{
  UInt8 = 1,
  Int8 = 2,
  Float32 = 10,
  Float64 = 11
};
// u8, i8, u16, i16, u32, i32, u64, i64, f16, f32, f64; 0 is no type.
constexpr std::array<std::uint64_t, 12> TypeSizes = { 0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8 };
constexpr int MaximumRank = 16;

struct Field
{
  int Type = 0;
  std::vector<std::uint64_t> Shape;
  std::uint64_t Offset = 0;
  std::uint64_t Bytes = 0;
  const char* Data = nullptr;
};
using Fields = std::map<std::string, Field>;

std::string ToField(const std::string& name) { return "field " + Quote(name); }

//------------------------------------------------------------------------------
Fields ReadFields(ByteReader& reader)
{
  const std::string magic(reader.Take(sizeof(TensorMagic), "magic"), sizeof(TensorMagic));
  if (magic != std::string(TensorMagic, sizeof(TensorMagic)))
  {
    reader.Fail("magic", "expected 'tensor_file' and a zero byte");
  }
  const int major = reader.Read<std::uint8_t>("version");
  const int minor = reader.Read<std::uint8_t>("version");
  if (major != 1 || minor != 0)
  {
    reader.Fail(
      "version", "found " + std::to_string(major) + "." + std::to_string(minor) + ", expected 1.0");
  }
  const auto count = reader.Read<std::uint32_t>("number of fields");

  Fields fields;
  for (std::uint32_t k = 0; k < count; ++k)
  {
    const std::string number = "field " + std::to_string(k + 1) + " of " + std::to_string(count);
    const auto length = reader.Read<std::uint16_t>(number + " (length of its name)");
    const std::string name(reader.Take(length, number + " (name)"), length);
    const auto rank = reader.Read<std::uint16_t>(ToField(name) + " (number of dimensions)");
    if (rank > MaximumRank)
    {
      reader.Fail(ToField(name) + " (number of dimensions)",
        "found " + std::to_string(rank) + ", expected at most " + std::to_string(MaximumRank));
    }
    Field field;
    field.Type = reader.Read<std::uint8_t>(ToField(name) + " (type)");
    if (field.Type < 1 || field.Type >= static_cast<int>(TypeSizes.size()))
    {
      reader.Fail(
        ToField(name) + " (type)", "found " + std::to_string(field.Type) + ", expected 1 to 11");
    }
    field.Offset = reader.Read<std::uint64_t>(ToField(name) + " (offset)");
    field.Bytes = TypeSizes[field.Type];
    for (int axis = 0; axis < rank; ++axis)
    {
      const auto size = reader.Read<std::uint64_t>(ToField(name) + " (shape)");
      if (size != 0 && field.Bytes > std::numeric_limits<std::uint64_t>::max() / size)
      {
        reader.Fail(ToField(name) + " (shape)", "the product of its sizes overflows (axis " +
                                                  std::to_string(axis) + " is " +
                                                  std::to_string(size) + ")");
      }
      field.Bytes *= size;
      field.Shape.push_back(size);
    }
    field.Data = reader.At(field.Offset, field.Bytes, ToField(name) + " (data)");
    if (!fields.emplace(name, std::move(field)).second)
    {
      reader.Fail(ToField(name), "appears twice");
    }
  }
  return fields;
}

//------------------------------------------------------------------------------
vtkAdaptiveWarpBRDF::Table GetTable(
  const ByteReader& reader, const Fields& fields, const std::string& name, std::size_t rank)
{
  const auto found = fields.find(name);
  if (found == fields.end())
  {
    reader.Fail(ToField(name), "is missing");
  }
  const Field& field = found->second;
  if (field.Type != Float32 && field.Type != Float64)
  {
    reader.Fail(ToField(name),
      "found type " + std::to_string(field.Type) + ", expected 10 (32-bit floating point)");
  }
  if (field.Shape.size() != rank)
  {
    reader.Fail(ToField(name), "found " + std::to_string(field.Shape.size()) +
                                 " dimensions, expected " + std::to_string(rank));
  }
  vtkAdaptiveWarpBRDF::Table table;
  for (const std::uint64_t size : field.Shape)
  {
    // Only a shape with a zero in it could hold a size that the file's length does not bound.
    if (size < 1 || size > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    {
      reader.Fail(ToField(name), "found size " + std::to_string(size) + ", expected at least 1");
    }
    table.Shape.push_back(static_cast<int>(size));
  }
  if (field.Type == Float64)
  {
    std::vector<double> values(field.Bytes / sizeof(double));
    ByteReader::Copy(values.data(), field.Data, values.size());
    table.Values.assign(values.begin(), values.end());
    return table;
  }
  table.Values.resize(field.Bytes / sizeof(float));
  ByteReader::Copy(table.Values.data(), field.Data, table.Values.size());
  return table;
}

//------------------------------------------------------------------------------
// vtkAdaptiveWarpBRDF takes what rounding explains; the reader counts and reports it.
void CountNoise(const std::vector<float>& values, const std::string& name, MaterialFile& result)
{
  const float floor = GetNoiseFloor(values);
  const auto isNoise = [floor](float value) { return value < 0.0f && value >= floor; };
  const auto count = std::count_if(values.begin(), values.end(), isNoise);
  if (count > 0)
  {
    TextStream note;
    note << count << " of " << values.size() << " values of " << name
         << " are negative by rounding (the least "
         << *std::min_element(values.begin(), values.end()) << ", the largest value "
         << *std::max_element(values.begin(), values.end()) << "): taken as 0.";
    result.AddNote(note.str());
    result.NumberOfNegativeValues += count;
  }
}

void CheckAngles(const std::vector<float>& angles, const std::string& name, MaterialFile& result)
{
  if (std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<float>()) != angles.end())
  {
    result.AddNote("Angles of " + name + " were rounded onto each other: set apart.");
  }
}

//------------------------------------------------------------------------------
void CheckFields(const ByteReader& reader, const Fields& fields)
{
  // The fields' data may overlap in a file that lies; then they add up to more than the file.
  std::uint64_t total = 0;
  for (const auto& field : fields)
  {
    total += field.second.Bytes; // each at most the file's size, at most 2^32 of them
    if (total > reader.GetFile().GetSize())
    {
      reader.Fail(ToField(field.first), "the fields' data overlap");
    }
  }
}

//------------------------------------------------------------------------------
bool IsSpectral(const Fields& fields) { return !fields.count("rgb") && fields.count("spectra"); }

// nm.
std::vector<double> GetWavelengths(const ByteReader& reader, const Fields& fields)
{
  const std::vector<float> stored = GetTable(reader, fields, "wavelengths", 1).Values;
  const std::vector<double> wavelengths(stored.begin(), stored.end());
  const std::uint64_t offset = fields.at("wavelengths").Offset;
  for (std::size_t k = 0; k < wavelengths.size(); ++k)
  {
    // Also false where it is not a number.
    if (!(wavelengths[k] > (k == 0 ? 0.0 : wavelengths[k - 1])) || !std::isfinite(wavelengths[k]))
    {
      reader.FailAt(offset, ToField("wavelengths"),
        "number " + std::to_string(k) + " is " + std::to_string(wavelengths[k]) +
          ", expected ascending ones, in nm");
    }
  }
  if (wavelengths.front() > LastVisible || wavelengths.back() < FirstVisible)
  {
    reader.FailAt(offset, ToField("wavelengths"),
      "found " + std::to_string(wavelengths.front()) + " to " + std::to_string(wavelengths.back()) +
        ", expected visible ones, in nm");
  }
  return wavelengths;
}

// The spectra's RGB, as the file's RGB form has it: a color for each texel.
vtkAdaptiveWarpBRDF::Table GetColors(const ByteReader& reader, const Fields& fields)
{
  const std::vector<double> wavelengths = GetWavelengths(reader, fields);
  vtkAdaptiveWarpBRDF::Table spectra = GetTable(reader, fields, "spectra", 5);
  if (static_cast<std::size_t>(spectra.Shape[2]) != wavelengths.size())
  {
    reader.FailAt(fields.at("spectra").Offset, ToField("spectra"),
      "found " + std::to_string(spectra.Shape[2]) + " wavelengths, expected the " +
        std::to_string(wavelengths.size()) + " of field 'wavelengths'");
  }
  const auto bad = std::find_if(spectra.Values.begin(), spectra.Values.end(),
    [](float value) { return !std::isfinite(value); });
  if (bad != spectra.Values.end())
  {
    reader.FailAt(fields.at("spectra").Offset, ToField("spectra"),
      "value " + std::to_string(bad - spectra.Values.begin()) + " is not finite");
  }
  const std::vector<std::array<double, 3>> weights = GetSpectralWeights(wavelengths);
  const std::size_t texels = std::size_t(spectra.Shape[3]) * std::size_t(spectra.Shape[4]);
  const std::size_t directions = spectra.Values.size() / texels / wavelengths.size();
  vtkAdaptiveWarpBRDF::Table colors;
  colors.Shape = spectra.Shape;
  colors.Shape[2] = 3;
  colors.Values.reserve(3 * directions * texels);
  for (std::size_t direction = 0; direction < directions; ++direction)
  {
    const float* first = &spectra.Values[direction * wavelengths.size() * texels];
    for (std::size_t c = 0; c < 3; ++c)
    {
      for (std::size_t texel = 0; texel < texels; ++texel)
      {
        double sum = 0.0;
        for (std::size_t k = 0; k < wavelengths.size(); ++k)
        {
          sum += weights[k][c] * first[k * texels + texel];
        }
        colors.Values.push_back(static_cast<float>(sum));
      }
    }
  }
  return colors;
}

//------------------------------------------------------------------------------
vtkAdaptiveWarpBRDF::Tables GetTables(const ByteReader& reader, const Fields& fields)
{
  vtkAdaptiveWarpBRDF::Tables tables;
  tables.ThetaI = GetTable(reader, fields, "theta_i", 1).Values;
  tables.PhiI = GetTable(reader, fields, "phi_i", 1).Values;
  tables.Ndf = GetTable(reader, fields, "ndf", 2);
  tables.Sigma = GetTable(reader, fields, "sigma", 2);
  tables.Vndf = GetTable(reader, fields, "vndf", 4);
  tables.Luminance = GetTable(reader, fields, "luminance", 4);
  tables.Rgb = IsSpectral(fields) ? GetColors(reader, fields) : GetTable(reader, fields, "rgb", 5);

  const auto jacobian = fields.find("jacobian");
  if (jacobian != fields.end())
  {
    const Field& field = jacobian->second;
    if ((field.Type != UInt8 && field.Type != Int8) || field.Bytes != 1 ||
        (*field.Data != 0 && *field.Data != 1))
    {
      reader.FailAt(field.Offset, ToField("jacobian"), "expected one byte of value 0 or 1");
    }
    tables.Jacobian = *field.Data == 1;
  }
  return tables;
}

//------------------------------------------------------------------------------
bool IsNegative(float value) { return value < 0.0f; }

// Notes of what is taken otherwise than it is stored, colors aside.
void AddNotes(const Fields& fields, const vtkAdaptiveWarpBRDF::Tables& tables, MaterialFile& result)
{
  for (const auto& [name, field] : fields)
  {
    if (field.Type == Float64 && name != "wavelengths")
    {
      result.AddNote(ToField(name) + " holds 64-bit values: rounded to 32 bits.");
    }
  }
  CheckAngles(tables.ThetaI, "theta_i", result);
  CheckAngles(tables.PhiI, "phi_i", result);
  CountNoise(tables.Vndf.Values, "vndf", result);
  CountNoise(tables.Luminance.Values, "luminance", result);
  const auto dark = std::count_if(tables.Ndf.Values.begin(), tables.Ndf.Values.end(), IsNegative) +
                    std::count_if(tables.Sigma.Values.begin(), tables.Sigma.Values.end(),
                      [](float value) { return value <= 0.0f; });
  if (dark > 0)
  {
    result.AddNote(std::to_string(dark) +
                   " values of ndf are negative or of sigma not positive: the material is black "
                   "there.");
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAdaptiveWarpBRDF> MakeMaterial(
  const ByteReader& reader, const Fields& fields, vtkAdaptiveWarpBRDF::Tables tables)
{
  auto material = vtkSmartPointer<vtkAdaptiveWarpBRDF>::New();
  const std::string problem = material->SetTables(std::move(tables));
  if (!problem.empty())
  {
    // It begins with the field's name.
    const std::size_t colon = std::min(problem.find(": "), problem.size());
    const auto field = fields.find(problem.substr(0, colon));
    if (field == fields.end())
    {
      reader.Fail("tables", problem);
    }
    reader.FailAt(field->second.Offset, ToField(field->first), problem.substr(colon + 2));
  }
  return material;
}

//------------------------------------------------------------------------------
std::string GetDescription(const Fields& fields)
{
  std::string description;
  const auto text = fields.find("description");
  if (text != fields.end() && text->second.Type == UInt8)
  {
    description.assign(text->second.Data, text->second.Bytes);
    // Arrays of characters are often padded.
    description.erase(description.find_last_not_of(std::string(" \t\r\n\0", 5)) + 1);
  }
  return description;
}
//------------------------------------------------------------------------------
MaterialFile ReadTensor(const FileBytes& file, const std::string&)
{
  ByteReader reader(file, TensorFormatName);
  const Fields fields = ReadFields(reader);
  CheckFields(reader, fields);
  vtkAdaptiveWarpBRDF::Tables tables = GetTables(reader, fields);

  MaterialFile result;
  AddNotes(fields, tables, result);
  const std::size_t values = tables.Rgb.Values.size();
  const auto negative =
    std::count_if(tables.Rgb.Values.begin(), tables.Rgb.Values.end(), IsNegative);
  result.NumberOfNegativeValues += negative;

  if (IsSpectral(fields))
  {
    const std::vector<double> wavelengths = GetWavelengths(reader, fields);
    TextStream note;
    note << "Spectra at " << wavelengths.size() << " wavelengths, " << wavelengths.front() << " to "
         << wavelengths.back()
         << " nm: summed over the CIE 1931 color-matching functions under D65.";
    if (wavelengths.front() > FirstVisible || wavelengths.back() < LastVisible)
    {
      note << " Constant beyond, to " << FirstVisible << " and " << LastVisible << " nm.";
    }
    result.AddNote(note.str());
  }
  const auto material = MakeMaterial(reader, fields, std::move(tables));
  const std::string description = GetDescription(fields);
  material->SetName(GetFileStem(file.GetPath()));
  material->SetSource((description.empty() ? "" : description + "; ") +
                      "RGL-EPFL material database (Dupuy and Jakob 2018), " +
                      GetFileTitle(file.GetPath()));
  result.AddNote(
    "The file holds f cos(theta_o); evaluation divides by that cosine. Not reciprocal.");
  if (negative > 0)
  {
    result.AddNote(std::to_string(negative) + " of " + std::to_string(values) +
                   (IsSpectral(fields) ? "" : " stored") +
                   " color values are negative (outside sRGB): clamped at 0 after interpolation.");
  }
  result.BRDF = material;
  return result;
}

}

const MaterialFormat TensorFormat = { TensorFormatName, "RGL .bsdf (RGB or spectral)", ".bsdf",
  [](const vtkBRDFFormat::File& file)
  { return HasMagic(file, std::string_view(TensorMagic, sizeof(TensorMagic))); }, // its zero, too
  ReadTensor };
} // namespace measuredbrdf
