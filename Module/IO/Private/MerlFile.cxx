// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * MERL `.binary` (Matusik et al. 2003; layout: the database's BRDFRead.cpp): int32 n_theta_h,
 * n_theta_d, n_phi_d, then float64, three planes R, G, B with phi_d fastest and theta_h slowest.
 * Values are scaled by (1, 1.15, 1.66)/1500; a cell with a negative channel was not measured.
 */

#include "MaterialFormat.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr const char* MerlFormatName = "MERL binary";
constexpr int MaximumSize = 2048; // vtkTabulatedBRDF's

// The database's BRDFRead.cpp: RED_SCALE, GREEN_SCALE, BLUE_SCALE.
constexpr std::array<double, 3> Scale = { 1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0 };

// What rounding leaves of a stored 0. Cells that were not measured hold -1 or less.
constexpr double Noise = 1e-6;

// The database's tables, along phi_d, theta_d, theta_h (Matusik et al. 2003).
constexpr std::array<int, 3> DatabaseSize = { 180, 90, 90 };

// Order in the file; vtkTabulatedBRDF counts them from the fastest.
constexpr std::array<const char*, 3> SizeNames = { "n_theta_h", "n_theta_d", "n_phi_d" };

//------------------------------------------------------------------------------
// RGB of each cell, NaN where it was not measured. result counts what is negative or not finite,
// and notes what was repaired.
std::vector<float> ScaleValues(const char* bytes, std::size_t count, MaterialFile& result)
{
  std::vector<float> values(3 * count);
  vtkIdType invalid = 0; // cells
  vtkIdType rounded = 0;
  for (std::size_t cell = 0; cell < count; ++cell)
  {
    float* rgb = &values[3 * cell];
    bool valid = true;
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      double stored;
      ByteReader::Copy(&stored, bytes + (channel * count + cell) * sizeof(double), 1);
      const auto value = static_cast<float>(stored * Scale[channel]);
      const bool finite = std::isfinite(value);
      const bool negative = stored < 0.0;
      const bool noise = negative && stored >= -Noise;
      result.NumberOfInvalidValues += !finite;
      result.NumberOfNegativeValues += negative && finite;
      rounded += noise;
      valid = valid && finite && (!negative || noise);
      rgb[channel] = noise ? 0.0f : value;
    }
    if (!valid)
    {
      std::fill_n(rgb, 3, std::numeric_limits<float>::quiet_NaN());
      ++invalid;
    }
  }
  NoteCount(rounded, " values are negative by rounding: taken as 0.", result);
  NoteCount(invalid,
    Concat(" of ", count,
      " cells are invalid (a negative or non-finite channel): interpolation skips them."),
    result);
  return values;
}

//------------------------------------------------------------------------------
// Whether the first twelve bytes could be the three sizes; these need not match the file's.
bool CanReadMerl(const vtkBRDFFormat::File& file)
{
  if (file.Bytes.size() < 12)
  {
    return false;
  }
  std::array<std::int32_t, 3> sizes;
  ByteReader::Copy(sizes.data(), file.Bytes.data(), 3);
  return std::all_of(
    sizes.begin(), sizes.end(), [](std::int32_t size) { return size >= 1 && size <= MaximumSize; });
}

//------------------------------------------------------------------------------
MaterialFile ReadMerl(const FileBytes& file, const std::string&)
{
  ByteReader reader(file, MerlFormatName);
  int sizes[3];
  std::size_t count = 1;
  for (int axis = 2; axis >= 0; --axis) // the slowest comes first
  {
    const char* name = SizeNames[2 - axis];
    sizes[axis] = reader.Read<std::int32_t>(name);
    reader.Require(sizes[axis] >= 1 && sizes[axis] <= MaximumSize, name, "found ", sizes[axis],
      ", expected 1 to ", MaximumSize);
    count *= static_cast<std::size_t>(sizes[axis]);
  }
  const char* bytes = reader.TakeRest(std::uint64_t(count) * 3 * sizeof(double),
    Concat(sizes[2], " x ", sizes[1], " x ", sizes[0], " RGB values"));
  MaterialFile result;
  result.AddNote("R, G, B were multiplied by 1/1500, 1.15/1500, 1.66/1500, the format's scale.");
  vtkNew<vtkTabulatedBRDF> table;
  reader.Require(table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN,
                   sizes, ScaleValues(bytes, count, result)),
    "values", "the table was refused");
  NotePadding(reader, result);
  result.BRDF = table;
  NameAfterFile(result, file, MerlFormatName);
  return result;
}

//------------------------------------------------------------------------------
void WriteMerl(vtkBRDF* brdf, const std::string& path, bool halfFloats)
{
  Require(!halfFloats, path, ": a MERL table holds 64-bit floats; 16-bit ones need .exr");
  auto* table = vtkTabulatedBRDF::SafeDownCast(brdf);
  Require(table && table->IsReciprocal(), // half/difference over half a turn, without cosine
    path,
    ": MERL binary holds tables over half and difference angles with phi_d over half a turn only, "
    "without cosine weight; resample with vtkBRDFResampler (Reciprocal on) first, or write .exr");
  const std::vector<float>& rgb = table->GetVolume();
  const std::size_t cells = rgb.size() / 3;
  Require(cells > 0, path, ": the table holds no cells");
  std::vector<double> planes(3 * cells);
  std::size_t refused = 0;
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    const float* values = &rgb[3 * cell];
    const bool valid = !std::isnan(values[0]) && !std::isnan(values[1]) && !std::isnan(values[2]);
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      // Dividing in double and multiplying when reading gives the same float back.
      planes[channel * cells + cell] =
        valid ? static_cast<double>(values[channel]) / Scale[channel] : -1.0;
      refused += valid && values[channel] < 0.0f;
    }
  }
  Require(refused == 0, path, ": MERL binary marks what was not measured by negative values, and ",
    refused, " values of this table are negative; write .exr");

  int dimensions[3];
  table->GetDimensions(dimensions);
  std::array<std::int32_t, 3> sizes = { dimensions[2], dimensions[1], dimensions[0] };
  vtkByteSwap::SwapLERange(sizes.data(), sizes.size());
  vtkByteSwap::SwapLERange(planes.data(), planes.size());
  std::string bytes(reinterpret_cast<const char*>(sizes.data()), sizeof(sizes));
  bytes.append(reinterpret_cast<const char*>(planes.data()), planes.size() * sizeof(double));
  WriteFile(path, bytes);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> ConvertToMerl(vtkBRDF* brdf, std::string& error)
{
  auto* table = vtkTabulatedBRDF::SafeDownCast(brdf);
  if (table && table->GetParameterization() == vtkTabulatedBRDF::HALF_DIFFERENCE &&
      table->GetAzimuthRange() == vtkTabulatedBRDF::HALF_TURN &&
      std::equal(DatabaseSize.begin(), DatabaseSize.end(), table->GetDimensions()))
  {
    return brdf;
  }
  if (!brdf->IsIsotropic())
  {
    error = "is anisotropic, which a MERL table can't hold; write .exr, which keeps everything";
    return nullptr;
  }
  vtkNew<vtkBRDFResampler> resampler;
  resampler->SetInput(brdf);
  resampler->ReciprocalOn();
  resampler->ResampleTo(DatabaseSize[0], DatabaseSize[1], DatabaseSize[2]);
  vtkSmartPointer<vtkTabulatedBRDF> resampled = resampler->GetOutput();
  resampled->SetName(brdf->GetName());
  resampled->SetSource(brdf->GetSource());
  return resampled;
}
}

const MaterialFormat MerlFormat = { MerlFormatName, "MERL .binary", ".binary", CanReadMerl,
  ReadMerl, nullptr, WriteMerl, ConvertToMerl };
} // namespace measuredbrdf
