// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Small valid files of the formats that are not written here, for tests and fuzz targets.
 */

#ifndef SmallFiles_h
#define SmallFiles_h

#include "vtkAdaptiveWarpBRDF.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace testio
{
/// A value's bytes at the end (the machines that run these tests are little-endian).
template <typename T>
void Append(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

constexpr const char* SmallFit =
  "# a comment\n"
  "plain = Aggregate(Lambertian(albedo = [0.1, 0.2, 0.3]),\n"
  "  LowAshikhminShirley(sharpness = 20, fresnelReflectance = 1.5, albedo = [0.4, 0.5, 0.6]))\n";

/// MERL file of the given sizes; values grow with the cell, one cell is invalid.
inline std::string MakeMerl(int nThetaH, int nThetaD, int nPhiD)
{
  std::string bytes;
  Append<std::int32_t>(bytes, nThetaH);
  Append<std::int32_t>(bytes, nThetaD);
  Append<std::int32_t>(bytes, nPhiD);
  const int cells = nThetaH * nThetaD * nPhiD;
  for (int channel = 0; channel < 3; ++channel)
  {
    for (int cell = 0; cell < cells; ++cell)
    {
      Append<double>(bytes, cell == cells - 1 ? -1.0 : 100.0 + cell + 1000.0 * channel);
    }
  }
  return bytes;
}

inline std::string MakeMbsdf(bool color, int nTheta, int nPhi, bool transmission = false)
{
  std::string bytes = "NVIDIA ARC MBSDF V1\ncomment=\"made by a test\"\n";
  for (int block = 0; block < (transmission ? 2 : 1); ++block)
  {
    bytes += block == 0 ? "MBSDF_DATA_REFLECTION=\n" : "MBSDF_DATA_TRANSMISSION=\n";
    Append<std::uint32_t>(bytes, color ? 1 : 0);
    Append<std::uint32_t>(bytes, std::uint32_t(nTheta));
    Append<std::uint32_t>(bytes, std::uint32_t(nPhi));
    const int count = nTheta * nTheta * nPhi * (color ? 3 : 1);
    for (int k = 0; k < count; ++k)
    {
      Append<float>(bytes, k == 1 ? -0.5f : 0.25f + 0.01f * float(k));
    }
  }
  return bytes;
}

/// Small, valid tables of an isotropic warp.
inline vtkAdaptiveWarpBRDF::Tables MakeTables()
{
  const auto fill = [](std::vector<int> shape, float start)
  {
    vtkAdaptiveWarpBRDF::Table table;
    const int count = std::accumulate(shape.begin(), shape.end(), 1, std::multiplies<int>());
    table.Shape = std::move(shape);
    for (int k = 0; k < count; ++k)
    {
      table.Values.push_back(start + 0.125f * float((7 * k) % 11));
    }
    return table;
  };
  vtkAdaptiveWarpBRDF::Tables tables;
  tables.ThetaI = { 0.0f, 0.7f, 1.4f };
  tables.PhiI = { 0.0f };
  tables.Ndf = fill({ 2, 8 }, 0.5f);
  tables.Sigma = fill({ 2, 8 }, 0.5f);
  tables.Vndf = fill({ 1, 3, 8, 8 }, 0.25f);
  tables.Luminance = fill({ 1, 3, 4, 4 }, 0.25f);
  tables.Rgb = fill({ 1, 3, 3, 4, 4 }, -0.1f);
  return tables;
}

struct TensorField
{
  std::string Name;
  std::uint8_t Type;
  std::vector<std::uint64_t> Shape;
  std::string Data;
};

/// The field of this name, which must be there.
inline TensorField& FieldOf(std::vector<TensorField>& fields, const std::string& name)
{
  return *std::find_if(
    fields.begin(), fields.end(), [&](const TensorField& f) { return f.Name == name; });
}

inline std::vector<TensorField> MakeTensorFields(const vtkAdaptiveWarpBRDF::Tables& tables)
{
  const auto field = [](const std::string& name, const vtkAdaptiveWarpBRDF::Table& table)
  {
    return TensorField{ name, 10, { table.Shape.begin(), table.Shape.end() },
      std::string(
        reinterpret_cast<const char*>(table.Values.data()), table.Values.size() * sizeof(float)) };
  };
  const auto axis = [](const std::vector<float>& values) {
    return vtkAdaptiveWarpBRDF::Table{ { int(values.size()) }, values };
  };
  return { { "description", 1, { 6 }, "sample" }, field("phi_i", axis(tables.PhiI)),
    field("theta_i", axis(tables.ThetaI)), field("sigma", tables.Sigma), field("ndf", tables.Ndf),
    field("vndf", tables.Vndf), field("luminance", tables.Luminance), field("rgb", tables.Rgb),
    { "jacobian", 1, { 1 }, "\x01" } };
}

inline std::string MakeTensor(const std::vector<TensorField>& fields)
{
  std::string bytes("tensor_file\0\x01\0", 14);
  Append<std::uint32_t>(bytes, std::uint32_t(fields.size()));
  std::uint64_t offset = bytes.size();
  for (const TensorField& field : fields)
  {
    offset += 2 + field.Name.size() + 2 + 1 + 8 + 8 * field.Shape.size();
  }
  std::string data;
  for (const TensorField& field : fields)
  {
    Append<std::uint16_t>(bytes, std::uint16_t(field.Name.size()));
    bytes += field.Name;
    Append<std::uint16_t>(bytes, std::uint16_t(field.Shape.size()));
    Append<std::uint8_t>(bytes, field.Type);
    Append<std::uint64_t>(bytes, offset + data.size());
    for (const std::uint64_t size : field.Shape)
    {
      Append<std::uint64_t>(bytes, size);
    }
    data += field.Data;
  }
  return bytes + data;
}
} // namespace testio

#endif
