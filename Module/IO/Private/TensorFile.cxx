// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The RGL-EPFL database's "tensor_file" (Dupuy and Jakob 2018; layout after the authors' loader
 * github.com/rgl-epfl/brdf-loader): 12 bytes of magic, version 1.0, then named fields with type,
 * shape and the offset of their data. Both forms are read: NAME_rgb.bsdf, and NAME_spec.bsdf, whose
 * field "spectra" has one f cos(theta_o) for each of the field "wavelengths" (nm). Spectra become
 * RGB as SpectralColor.cxx says: sums over the CIE 1931 color-matching functions under D65.
 */

#include "Floats.h"
#include "MaterialFormat.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkSmartPointer.h"

#include <Eigen/Core>

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
constexpr std::string_view TensorMagic("tensor_file\0", 12);

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

std::string ToField(std::string_view name) { return "field " + Quote(name); }

template <typename Condition>
std::int64_t CountIf(const std::vector<float>& values, const Condition& condition)
{
  return std::count_if(values.begin(), values.end(), condition);
}

bool IsNegative(float value) { return value < 0.0f; }

//------------------------------------------------------------------------------
class TensorFile
{
public:
  /// Reads the names, types, shapes and places of all fields. Throws FileError, as Read does.
  explicit TensorFile(const FileBytes& file)
    : Reader(file, TensorFormatName)
  {
    const std::string_view magic(
      this->Reader.Take(TensorMagic.size(), "magic"), TensorMagic.size());
    this->Reader.Require(magic == TensorMagic, "magic", "expected 'tensor_file' and a zero byte");
    const int major = this->Reader.Read<std::uint8_t>("version");
    const int minor = this->Reader.Read<std::uint8_t>("version");
    this->Reader.Require(
      !(major != 1 || minor != 0), "version", "found ", major, ".", minor, ", expected 1.0");
    const auto count = this->Reader.Read<std::uint32_t>("number of fields");
    std::uint64_t total = 0;
    for (std::uint32_t k = 0; k < count; ++k)
    {
      const std::string number = Concat("field ", k + 1, " of ", count);
      const auto length = this->Reader.Read<std::uint16_t>(number + " (length of its name)");
      const std::string name(this->Reader.Take(length, number + " (name)"), length);
      const Field field = this->ReadField(ToField(name));
      const bool isNew = this->Fields.emplace(name, field).second;
      this->Reader.Require(isNew, ToField(name), "appears twice");
      // The fields' data may overlap in a file that lies; then they add up to more than the file.
      total += field.Bytes; // each at most the file's size, at most 2^32 of them
      this->Reader.Require(
        total <= file.GetView().size(), ToField(name), "the fields' data overlap");
    }
  }

  MaterialFile Read() const
  {
    const bool isSpectral = !this->Fields.count("rgb") && this->Fields.count("spectra");
    MaterialFile result;
    vtkAdaptiveWarpBRDF::Tables tables;
    tables.ThetaI = this->GetTable("theta_i", 1).Values;
    tables.PhiI = this->GetTable("phi_i", 1).Values;
    tables.Ndf = this->GetTable("ndf", 2);
    tables.Sigma = this->GetTable("sigma", 2);
    tables.Vndf = this->GetTable("vndf", 4);
    tables.Luminance = this->GetTable("luminance", 4);
    tables.Rgb = isSpectral ? this->GetColors(result) : this->GetTable("rgb", 5);
    this->TakeJacobian(tables);
    this->AddNotes(tables, result);
    const std::size_t values = tables.Rgb.Values.size();
    const std::int64_t negative = CountIf(tables.Rgb.Values, IsNegative);
    result.NumberOfNegativeValues += negative;
    NoteCount(negative,
      Concat(" of ", values, isSpectral ? "" : " stored",
        " color values are negative (outside sRGB): clamped at 0 after interpolation."),
      result);
    const auto material = vtkSmartPointer<vtkAdaptiveWarpBRDF>::New();
    const std::string problem = material->SetTables(std::move(tables));
    if (!problem.empty())
    {
      // It begins with the field's name.
      const std::size_t colon = std::min(problem.find(": "), problem.size());
      this->Fail(problem.substr(0, colon), problem.substr(std::min(colon + 2, problem.size())));
    }
    const std::string description = this->GetDescription();
    const std::string& path = this->Reader.GetFile().GetPath();
    material->SetName(GetFileStem(path));
    material->SetSource((description.empty() ? "" : description + "; ") +
                        "RGL-EPFL material database (Dupuy and Jakob 2018), " + GetFileTitle(path));
    result.AddNote(
      "The file holds f cos(theta_o); evaluation divides by that cosine. Not reciprocal.");
    result.BRDF = material;
    return result;
  }

private:
  // At the field's data, or where the fields end if it is not there.
  template <typename... Pieces>
  [[noreturn]] void Fail(const std::string& name, const Pieces&... what) const
  {
    const auto field = this->Fields.find(name);
    this->Reader.FailAt(
      field == this->Fields.end() ? this->Reader.GetOffset() : field->second.Offset, ToField(name),
      what...);
  }

  template <typename... Pieces>
  void Require(bool condition, const std::string& name, const Pieces&... what) const
  {
    if (!condition)
    {
      this->Fail(name, what...);
    }
  }

  // What follows a field's name.
  Field ReadField(const std::string& place)
  {
    const int rank = this->Reader.Read<std::uint16_t>(place + " (number of dimensions)");
    this->Reader.Require(rank <= MaximumRank, place + " (number of dimensions)", "found ", rank,
      ", expected at most ", MaximumRank);
    Field field;
    field.Type = this->Reader.Read<std::uint8_t>(place + " (type)");
    this->Reader.Require(field.Type >= 1 && field.Type < static_cast<int>(TypeSizes.size()),
      place + " (type)", "found ", field.Type, ", expected 1 to 11");
    field.Offset = this->Reader.Read<std::uint64_t>(place + " (offset)");
    field.Bytes = TypeSizes[static_cast<std::size_t>(field.Type)];
    for (int axis = 0; axis < rank; ++axis)
    {
      const auto size = this->Reader.Read<std::uint64_t>(place + " (shape)");
      const bool fits =
        size == 0 || field.Bytes <= std::numeric_limits<std::uint64_t>::max() / size;
      this->Reader.Require(fits, place + " (shape)", "the product of its sizes overflows (axis ",
        axis, " is ", size, ")");
      field.Bytes *= size;
      field.Shape.push_back(size);
    }
    field.Data = this->Reader.At(field.Offset, field.Bytes, place + " (data)");
    return field;
  }

  vtkAdaptiveWarpBRDF::Table GetTable(const std::string& name, std::size_t rank) const
  {
    const auto found = this->Fields.find(name);
    this->Require(found != this->Fields.end(), name, "is missing");
    const Field& field = found->second;
    this->Require(field.Type == Float32 || field.Type == Float64, name, "found type ", field.Type,
      ", expected 10 (32-bit floating point)");
    this->Require(field.Shape.size() == rank, name, "found ", field.Shape.size(),
      " dimensions, expected ", rank);
    vtkAdaptiveWarpBRDF::Table table;
    for (const std::uint64_t size : field.Shape)
    {
      // Only a shape with a zero in it could hold a size that the file's length does not bound.
      this->Require(size >= 1 && size <= std::uint64_t(std::numeric_limits<int>::max()), name,
        "found size ", size, ", expected at least 1");
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

  // nm.
  std::vector<double> GetWavelengths() const
  {
    const std::vector<float> stored = this->GetTable("wavelengths", 1).Values;
    double last = 0.0;
    for (std::size_t k = 0; k < stored.size(); ++k)
    {
      this->Require(stored[k] > last && std::isfinite(stored[k]), "wavelengths", "number ", k,
        " is ", stored[k], ", expected ascending ones, in nm");
      last = stored[k];
    }
    this->Require(stored.front() <= LastVisible && last >= FirstVisible, "wavelengths", "found ",
      stored.front(), " to ", last, ", expected visible ones, in nm");
    return { stored.begin(), stored.end() };
  }

  // The spectra's RGB, as the file's RGB form has it: a color for each texel.
  vtkAdaptiveWarpBRDF::Table GetColors(MaterialFile& result) const
  {
    const std::vector<double> wavelengths = this->GetWavelengths();
    const std::size_t count = wavelengths.size();
    const vtkAdaptiveWarpBRDF::Table spectra = this->GetTable("spectra", 5);
    this->Require(static_cast<std::size_t>(spectra.Shape[2]) == count, "spectra", "found ",
      spectra.Shape[2], " wavelengths, expected the ", count, " of field 'wavelengths'");
    const auto bad = std::find_if(spectra.Values.begin(), spectra.Values.end(),
      [](float value) { return !std::isfinite(value); });
    this->Require(bad == spectra.Values.end(), "spectra", "value ", bad - spectra.Values.begin(),
      " is not finite");
    const std::vector<glm::dvec3> weights = GetSpectralWeights(wavelengths);
    const Eigen::Map<const Eigen::Matrix3Xd> toRgb(&weights[0].x, 3, Eigen::Index(count));
    const auto texels = Eigen::Index(spectra.Shape[3]) * spectra.Shape[4];
    vtkAdaptiveWarpBRDF::Table colors;
    colors.Shape = spectra.Shape;
    colors.Shape[2] = 3;
    for (std::size_t at = 0; at < spectra.Values.size(); at += count * std::size_t(texels))
    {
      // Rows are wavelengths, and then channels, of a row of texels each.
      using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      const Eigen::Map<const Rows> values(&spectra.Values[at], Eigen::Index(count), texels);
      const Rows rgb = (toRgb * values.cast<double>()).cast<float>();
      colors.Values.insert(colors.Values.end(), rgb.data(), rgb.data() + rgb.size());
    }
    std::string note = Concat("Spectra at ", count, " wavelengths, ", wavelengths.front(), " to ",
      wavelengths.back(), " nm: summed over the CIE 1931 color-matching functions under D65.");
    if (wavelengths.front() > FirstVisible || wavelengths.back() < LastVisible)
    {
      note += Concat(" Constant beyond, to ", FirstVisible, " and ", LastVisible, " nm.");
    }
    result.AddNote(note);
    return colors;
  }

  void TakeJacobian(vtkAdaptiveWarpBRDF::Tables& tables) const
  {
    const auto jacobian = this->Fields.find("jacobian");
    if (jacobian != this->Fields.end())
    {
      const Field& field = jacobian->second;
      this->Require((field.Type == UInt8 || field.Type == Int8) && field.Bytes == 1 &&
                      (*field.Data == 0 || *field.Data == 1),
        "jacobian", "expected one byte of value 0 or 1");
      tables.Jacobian = *field.Data == 1;
    }
  }

  // What is taken otherwise than it is stored, colors aside.
  void AddNotes(const vtkAdaptiveWarpBRDF::Tables& tables, MaterialFile& result) const
  {
    for (const auto& [name, field] : this->Fields)
    {
      if (field.Type == Float64 && name != "wavelengths")
      {
        result.AddNote(ToField(name) + " holds 64-bit values: rounded to 32 bits.");
      }
    }
    for (const auto& [name, angles] : std::map<std::string, const std::vector<float>*>{
           { "theta_i", &tables.ThetaI }, { "phi_i", &tables.PhiI } })
    {
      if (std::adjacent_find(angles->begin(), angles->end(), std::greater_equal<float>()) !=
          angles->end())
      {
        result.AddNote("Angles of " + name + " were rounded onto each other: set apart.");
      }
    }
    NoteNoise(tables.Vndf.Values, "vndf", result);
    NoteNoise(tables.Luminance.Values, "luminance", result);
    NoteCount(CountIf(tables.Ndf.Values, IsNegative) +
                CountIf(tables.Sigma.Values, [](float value) { return value <= 0.0f; }),
      " values of ndf are negative or of sigma not positive: the material is black there.", result);
  }

  // vtkAdaptiveWarpBRDF takes what rounding explains; the reader counts and reports it.
  static void NoteNoise(
    const std::vector<float>& values, const std::string& name, MaterialFile& result)
  {
    const float floor = GetNoiseFloor(values);
    const std::int64_t count =
      CountIf(values, [floor](float value) { return value < 0.0f && value >= floor; });
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    NoteCount(count,
      Concat(" of ", values.size(), " values of ", name, " are negative by rounding (the least ",
        *least, ", the largest value ", *largest, "): taken as 0."),
      result);
    result.NumberOfNegativeValues += count;
  }

  std::string GetDescription() const
  {
    const auto text = this->Fields.find("description");
    if (text == this->Fields.end() || text->second.Type != UInt8)
    {
      return "";
    }
    std::string description(text->second.Data, text->second.Bytes);
    // Arrays of characters are often padded.
    return description.erase(description.find_last_not_of(std::string(" \t\r\n\0", 5)) + 1);
  }

  ByteReader Reader;
  std::map<std::string, Field> Fields;
};
}

const MaterialFormat TensorFormat = { TensorFormatName, "RGL .bsdf (RGB or spectral)", ".bsdf",
  [](const vtkBRDFFormat::File& file) { return HasMagic(file, TensorMagic); },
  [](const FileBytes& file, const std::string&) { return TensorFile(file).Read(); } };
} // namespace measuredbrdf
