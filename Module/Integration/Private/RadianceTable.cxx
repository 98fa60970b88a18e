// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceTable.h"

#include "LobePlacement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace measuredbrdf
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
}

glm::dvec3 RadianceTable::Evaluate(
  const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const
{
  const LobePlacement place(n, o, t);
  const double u = place.U;
  const glm::dvec3 axis = GetProfileValue(this->Profile, 0, u);
  const MapPosition at(place.GetAxis(axis.y, axis.z));
  const glm::dvec2 around = place.GetTurn(axis.y, axis.z, at);
  const double psi = std::atan2(around.y, around.x) / (2.0 * Pi);
  const Neighbors turn = PeriodicNeighbors(psi + 0.5 / this->Azimuths, this->Azimuths);
  const std::size_t texels =
    static_cast<std::size_t>(this->Columns) * static_cast<std::size_t>(this->Rows);
  const double w = std::clamp(axis.x, 0.0, this->Angles - 1.0);
  const int angle = std::min(static_cast<int>(w), this->Angles - 2);
  const auto value = [&](int azimuth, int k)
  {
    return GetMapValue(this->Radiance, this->Rows, this->Columns,
      static_cast<std::size_t>(k * (this->Azimuths + 1) + azimuth) * texels, at);
  };
  const auto between = [&](int k)
  { return glm::mix(value(turn.First, k), value(turn.Second, k), turn.Weight); };
  glm::dvec3 sum = glm::mix(between(angle), between(angle + 1), w - angle);
  sum *= GetProfileValue(this->Profile, 1, u);
  if (this->HasFloor)
  {
    sum += GetProfileValue(this->Profile, 2, u) *
           GetMapValue(*this->Irradiance, IrradianceRows, IrradianceColumns, 0, MapPosition(n));
  }
  return glm::max(sum, glm::dvec3(0.0));
}

std::string RadianceTable::GetBytes() const
{
  std::string bytes;
  const std::vector<float> none;
  const std::vector<float>& irradiance = this->HasFloor ? *this->Irradiance : none;
  const auto put = [&bytes](const void* data, std::size_t size)
  { bytes.append(static_cast<const char*>(data), size); };
  const std::uint64_t header[] = { static_cast<std::uint64_t>(this->Rows),
    static_cast<std::uint64_t>(this->Angles), static_cast<std::uint64_t>(this->Azimuths),
    this->Profile.size(), this->Radiance.size(), irradiance.size() };
  put(header, sizeof(header));
  put(&this->Scale, sizeof(this->Scale));
  for (const std::vector<float>* values : { &this->Profile, &this->Radiance, &irradiance })
  {
    put(values->data(), values->size() * sizeof(float));
  }
  return bytes;
}

bool RadianceTable::TakeBytes(const std::string& bytes)
{
  std::uint64_t header[6];
  std::size_t at = sizeof(header) + sizeof(this->Scale);
  if (bytes.size() < at)
  {
    return false;
  }
  std::memcpy(header, bytes.data(), sizeof(header));
  std::memcpy(&this->Scale, bytes.data() + sizeof(header), sizeof(this->Scale));
  const std::uint64_t radiance =
    3ull * static_cast<std::uint64_t>(this->Rows) * static_cast<std::uint64_t>(this->Columns) *
    static_cast<std::uint64_t>(this->Angles) * static_cast<std::uint64_t>(this->Azimuths + 1);
  const std::uint64_t irradiance = 3ull * IrradianceColumns * IrradianceRows;
  const std::uint64_t expected[] = { static_cast<std::uint64_t>(this->Rows),
    static_cast<std::uint64_t>(this->Angles), static_cast<std::uint64_t>(this->Azimuths),
    3ull * 3 * ProfileSize, radiance, header[5] == 0 ? 0 : irradiance };
  if (!std::equal(header, header + 6, expected) ||
      bytes.size() != at + sizeof(float) * (header[3] + header[4] + header[5]))
  {
    return false;
  }
  this->HasFloor = header[5] != 0;
  int part = 3;
  auto irradianceMap = std::make_shared<std::vector<float>>();
  for (std::vector<float>* values : { &this->Profile, &this->Radiance, irradianceMap.get() })
  {
    values->resize(static_cast<std::size_t>(header[part++]));
    std::memcpy(values->data(), bytes.data() + at, values->size() * sizeof(float));
    at += values->size() * sizeof(float);
    if (!std::all_of(values->begin(), values->end(), [](float v) { return std::isfinite(v); }))
    {
      return false;
    }
  }
  this->Irradiance = irradianceMap;
  return true;
}

} // namespace measuredbrdf
