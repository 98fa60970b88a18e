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
std::array<int, 3> ReadSizes(ByteReader& reader)
{
  std::array<int, 3> sizes;
  for (int k = 0; k < 3; ++k)
  {
    sizes[k] = reader.Read<std::int32_t>(SizeNames[k]);
    if (sizes[k] < 1 || sizes[k] > MaximumSize)
    {
      reader.Fail(SizeNames[k],
        "found " + std::to_string(sizes[k]) + ", expected 1 to " + std::to_string(MaximumSize));
    }
  }
  return sizes;
}

//------------------------------------------------------------------------------
struct Cells
{
  std::vector<float> RGB;
  vtkIdType Invalid = 0;
  vtkIdType Rounded = 0; // values
};

// result counts what is negative or not finite.
Cells ScaleValues(const char* bytes, std::size_t count, MaterialFile& result)
{
  Cells cells;
  cells.RGB.resize(count * 3);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t cell = 0; cell < count; ++cell)
  {
    float* rgb = &cells.RGB[3 * cell];
    bool valid = true;
    for (int channel = 0; channel < 3; ++channel)
    {
      double stored;
      ByteReader::Copy(&stored, bytes + (channel * count + cell) * sizeof(double), 1);
      const float value = static_cast<float>(stored * Scale[channel]);
      const bool finite = std::isfinite(value);
      const bool negative = stored < 0.0;
      const bool noise = negative && stored >= -Noise;
      result.NumberOfInvalidValues += !finite;
      result.NumberOfNegativeValues += negative && finite;
      cells.Rounded += noise;
      valid = valid && finite && (!negative || noise);
      rgb[channel] = noise ? 0.0f : value;
    }
    if (!valid)
    {
      rgb[0] = rgb[1] = rgb[2] = nan;
      ++cells.Invalid;
    }
  }
  return cells;
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
  const std::array<int, 3> sizes = ReadSizes(reader);
  const std::size_t count = std::size_t(sizes[0]) * sizes[1] * sizes[2];
  const char* bytes = reader.TakeRest(std::uint64_t(count) * 3 * sizeof(double),
    std::to_string(sizes[0]) + " x " + std::to_string(sizes[1]) + " x " + std::to_string(sizes[2]) +
      " RGB values");
  MaterialFile result;
  Cells cells = ScaleValues(bytes, count, result);

  const int dimensions[3] = { sizes[2], sizes[1], sizes[0] };
  vtkNew<vtkTabulatedBRDF> table;
  if (!table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions,
        std::move(cells.RGB)))
  {
    reader.Fail("values", "the table was refused");
  }
  table->SetName(GetFileStem(file.GetPath()));
  table->SetSource("MERL binary file " + GetFileTitle(file.GetPath()));
  result.AddNote("R, G, B were multiplied by 1/1500, 1.15/1500, 1.66/1500, the format's scale.");
  if (cells.Rounded > 0)
  {
    result.AddNote(std::to_string(cells.Rounded) + " values are negative by rounding: taken as 0.");
  }
  NotePadding(reader, result);
  if (cells.Invalid > 0)
  {
    result.AddNote(
      std::to_string(cells.Invalid) + " of " + std::to_string(count) +
      " cells are invalid (a negative or non-finite channel): interpolation skips them.");
  }
  result.BRDF = table;
  return result;
}

//------------------------------------------------------------------------------
void WriteMerl(vtkBRDF* brdf, const std::string& path, bool halfFloats)
{
  if (halfFloats)
  {
    throw FileError(path + ": a MERL table holds 64-bit floats; 16-bit ones need .exr");
  }
  auto* table = vtkTabulatedBRDF::SafeDownCast(brdf);
  if (!table || !table->IsReciprocal()) // half/difference over half a turn, without cosine
  {
    throw FileError(
      path +
      ": MERL binary holds tables over half and difference angles with phi_d over half a turn "
      "only, without cosine weight; resample with vtkBRDFResampler (Reciprocal on) first, or "
      "write .exr");
  }
  const std::vector<float>& rgb = table->GetVolume();
  const std::size_t cells = rgb.size() / 3;
  if (cells == 0)
  {
    throw FileError(path + ": the table holds no cells");
  }

  std::vector<double> planes(3 * cells);
  std::size_t refused = 0;
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    const float* values = &rgb[3 * cell];
    const bool valid = !std::isnan(values[0]) && !std::isnan(values[1]) && !std::isnan(values[2]);
    for (int channel = 0; channel < 3; ++channel)
    {
      // Dividing in double and multiplying when reading gives the same float back.
      planes[channel * cells + cell] =
        valid ? static_cast<double>(values[channel]) / Scale[channel] : -1.0;
      refused += valid && values[channel] < 0.0f;
    }
  }
  if (refused > 0)
  {
    throw FileError(path + ": MERL binary marks what was not measured by negative values, and " +
                    std::to_string(refused) + " values of this table are negative; write .exr");
  }

  int dimensions[3];
  table->GetDimensions(dimensions);
  std::array<std::int32_t, 3> sizes = { dimensions[2], dimensions[1], dimensions[0] };
  vtkByteSwap::SwapLERange(sizes.data(), sizes.size());
  vtkByteSwap::SwapLERange(planes.data(), planes.size());
  std::string bytes;
  bytes.reserve(sizeof(sizes) + planes.size() * sizeof(double));
  bytes.append(reinterpret_cast<const char*>(sizes.data()), sizeof(sizes));
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
