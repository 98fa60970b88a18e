// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// glTF 2.0 (Khronos 2021): one material on one ball.
#include "ExportFiles.h"

#include "Lobes.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>

using nlohmann::ordered_json;

namespace tool
{
namespace
{
constexpr int Columns = 64; // quads about the axis
constexpr int Rows = 32;

//------------------------------------------------------------------------------
template <typename T>
void Append(std::string& bytes, T value)
{
  // The format is little-endian, as all machines are that this is built for.
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

//------------------------------------------------------------------------------
/// A unit sphere as a buffer and what describes it.
struct Ball
{
  std::string Bytes;
  ordered_json Views = ordered_json::array();
  ordered_json Accessors = ordered_json::array();

  Ball()
  {
    std::string positions;
    std::string tangents;
    for (int row = 0; row <= Rows; ++row)
    {
      for (int column = 0; column <= Columns; ++column)
      {
        const double theta = Pi * row / Rows;
        const double phi = 2.0 * Pi * column / Columns;
        // Azimuth from +z to +x about +y: the tangent (n.z, 0, -n.x) leads along it.
        for (const double value :
          { std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi) })
        {
          Append(positions, static_cast<float>(value));
        }
        for (const double value : { std::cos(phi), 0.0, -std::sin(phi), 1.0 })
        {
          Append(tangents, static_cast<float>(value));
        }
      }
    }
    std::string indices;
    for (int row = 0; row < Rows; ++row)
    {
      for (int column = 0; column < Columns; ++column)
      {
        const int corner = row * (Columns + 1) + column;
        const int below = corner + Columns + 1;
        for (const int index : { corner, below, below + 1, corner, below + 1, corner + 1 })
        {
          Append(indices, static_cast<std::uint16_t>(index));
        }
      }
    }
    constexpr int vertices = (Rows + 1) * (Columns + 1);
    constexpr int arrayBuffer = 34962;
    constexpr int elementBuffer = 34963;
    constexpr int single = 5126;
    constexpr int unsignedShort = 5123;
    this->Add(positions, arrayBuffer, single, vertices, "VEC3");
    this->Accessors.back()["min"] = { -1.0, -1.0, -1.0 };
    this->Accessors.back()["max"] = { 1.0, 1.0, 1.0 };
    this->Add(positions, arrayBuffer, single, vertices, "VEC3"); // a unit sphere's normals
    this->Add(tangents, arrayBuffer, single, vertices, "VEC4");
    this->Add(indices, elementBuffer, unsignedShort, 6 * Rows * Columns, "SCALAR");
  }

  void Add(const std::string& data, int target, int type, int count, const char* kind)
  {
    this->Views.push_back({ { "buffer", 0 }, { "byteOffset", this->Bytes.size() },
      { "byteLength", data.size() }, { "target", target } });
    this->Accessors.push_back({ { "bufferView", this->Views.size() - 1 }, { "componentType", type },
      { "count", count }, { "type", kind } });
    this->Bytes += data; // all lengths are multiples of 4
  }
};

//------------------------------------------------------------------------------
ordered_json MakeMaterial(const ModelFit& fit, const std::string& name, ordered_json& used)
{
  ordered_json material = { { "name", name } };
  const auto color = [&fit](const char* parameter)
  { return ordered_json(fit.Model->GetColor(parameter)); };
  ordered_json base = color("baseColorFactor");
  base.push_back(1.0);
  material["pbrMetallicRoughness"] = { { "baseColorFactor", base },
    { "metallicFactor", fit.Model->GetNumber("metallicFactor") },
    { "roughnessFactor", fit.Model->GetNumber("roughnessFactor") } };
  for (const Feature feature : fit.Features)
  {
    const std::string extension =
      std::string("KHR_materials_") +
      (feature == Feature::Coat ? "clearcoat" : GetFeatureName(feature));
    used.push_back(extension);
    ordered_json& part = material["extensions"][extension];
    for (const ModelParameter& parameter : fit.Model->GetParameters())
    {
      if (parameter.Part == feature && parameter.Size == 3)
      {
        part[parameter.Name] = color(parameter.Name.c_str());
      }
      else if (parameter.Part == feature)
      {
        part[parameter.Name] = fit.Model->GetNumber(parameter.Name);
      }
    }
  }
  return material;
}

//------------------------------------------------------------------------------
std::string EncodeBase64(const std::string& bytes)
{
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3)
  {
    std::uint32_t word = 0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      word = (word << 8) | (k + c < bytes.size() ? static_cast<unsigned char>(bytes[k + c]) : 0u);
    }
    for (std::size_t c = 0; c < 4; ++c)
    {
      text += c <= bytes.size() - k ? digits[(word >> (18 - 6 * c)) & 63u] : '=';
    }
  }
  return text;
}

//------------------------------------------------------------------------------
// The GLB container (specification, chapter 4).
std::string MakeContainer(std::string json, const std::string& bytes)
{
  json.append((4 - json.size() % 4) % 4, ' ');
  std::string file = "glTF";
  Append(file, std::uint32_t{ 2 });
  Append(file, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + bytes.size()));
  Append(file, static_cast<std::uint32_t>(json.size()));
  file += "JSON" + json;
  Append(file, static_cast<std::uint32_t>(bytes.size()));
  file += std::string("BIN\0", 4) + bytes;
  return file;
}
}

//------------------------------------------------------------------------------
std::string MakeGltf(const ModelFit& fit, const std::string& name, bool binary)
{
  const Ball ball;
  ordered_json used = ordered_json::array();
  const ordered_json material = MakeMaterial(fit, name, used);
  ordered_json buffer = { { "byteLength", ball.Bytes.size() } };
  if (!binary)
  {
    buffer["uri"] = "data:application/octet-stream;base64," + EncodeBase64(ball.Bytes);
  }
  ordered_json file = { { "asset", { { "version", "2.0" }, { "generator", "measured-brdf" } } } };
  if (!used.empty())
  {
    file["extensionsUsed"] = used;
  }
  file["scene"] = 0;
  file["scenes"] = ordered_json::array({ { { "nodes", { 0 } } } });
  file["nodes"] = ordered_json::array({ { { "name", "ball" }, { "mesh", 0 } } });
  const ordered_json primitive = { { "attributes",
                                     { { "POSITION", 0 }, { "NORMAL", 1 }, { "TANGENT", 2 } } },
    { "indices", 3 }, { "material", 0 } };
  file["meshes"] = ordered_json::array(
    { { { "name", "ball" }, { "primitives", ordered_json::array({ primitive }) } } });
  file["materials"] = ordered_json::array({ material });
  file["accessors"] = ball.Accessors;
  file["bufferViews"] = ball.Views;
  file["buffers"] = ordered_json::array({ buffer });
  const std::string text =
    file.dump(binary ? -1 : 1, ' ', true, ordered_json::error_handler_t::replace);
  return binary ? MakeContainer(text, ball.Bytes) : text + "\n";
}
} // namespace tool
