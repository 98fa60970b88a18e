// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceTable.h"

#include "LocalFrame.h"
#include "Neighbors.h"

#include <glm/gtc/type_ptr.hpp>

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

// Where a direction lies in a map of rows (poles included) x columns: its frame is the meridian's
// and the parallel's direction of growing angles.
struct MapPosition
{
  explicit MapPosition(const glm::dvec3& d)
  {
    // The harmonics' frame is the environment's (z, x, y).
    const double sine = std::hypot(d.z, d.x);
    const glm::dvec2 azimuth = sine > 1e-7 ? glm::dvec2(d.z, d.x) / sine : glm::dvec2(1.0, 0.0);
    this->Azimuth = std::atan2(azimuth.y, azimuth.x) / (2.0 * Pi);
    this->Polar = std::atan2(sine, d.y) / Pi;
    this->Along = glm::dvec3(azimuth.y * d.y, -sine, azimuth.x * d.y);
    this->Across = glm::dvec3(azimuth.x, 0.0, -azimuth.y);
  }
  double Azimuth; // in turns
  double Polar;   // in half turns
  glm::dvec3 Along;
  glm::dvec3 Across;
};
glm::dvec3 GetTexel(const std::vector<float>& data, int index)
{
  return glm::dvec3(glm::make_vec3(&data[3 * static_cast<std::size_t>(index)]));
}

// Bilinear in a map that begins at the given texel.
glm::dvec3 GetMapValue(const std::vector<float>& data, int rows, int columns,
  std::size_t firstTexel, const MapPosition& at)
{
  const Neighbors x = PeriodicNeighbors(at.Azimuth + 0.5 / columns, columns);
  const double exact = at.Polar * (rows - 1);
  const int low = std::min(static_cast<int>(exact), rows - 2);
  const auto row = [&](int k)
  {
    const int first = static_cast<int>(firstTexel) + columns * k;
    return glm::mix(GetTexel(data, first + x.First), GetTexel(data, first + x.Second), x.Weight);
  };
  return glm::mix(row(low), row(low + 1), exact - low);
}
}

glm::dvec3 RadianceTable::GetProfile(int row, double u) const
{
  const double exact = u * (ProfileSize - 1);
  const int low = std::min(static_cast<int>(exact), ProfileSize - 2);
  return glm::mix(GetTexel(this->Profile, ProfileSize * row + low),
    GetTexel(this->Profile, ProfileSize * row + low + 1), exact - low);
}

glm::dvec3 RadianceTable::Evaluate(
  const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const
{
  const Frame frame = FrameAbout(n, t);
  const glm::dvec3 view = LiftView(ToLocal(frame, o));
  const double sine = std::hypot(view.x, view.y);
  const double u =
    1.0 - std::sqrt(std::max(1.0 - std::atan2(sine, view.z) / LobeViews::GetLastAngle(), 0.0));
  const glm::dvec3 axis = this->GetProfile(0, u);
  const glm::dvec2 azimuth = sine > 1e-6 ? glm::dvec2(view) / sine : glm::dvec2(1.0, 0.0);
  const glm::dvec3 across = frame[0] * azimuth.x + frame[1] * azimuth.y;
  const glm::dvec3 d = glm::normalize(axis.y * frame[2] - axis.z * across);
  const glm::dvec3 along = axis.y * across + axis.z * frame[2];

  const MapPosition at(d);
  const double psi = std::atan2(glm::dot(along, at.Across), glm::dot(along, at.Along)) / (2.0 * Pi);
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
  sum *= this->GetProfile(1, u);
  if (this->HasFloor)
  {
    sum += this->GetProfile(2, u) * GetMapValue(*this->Irradiance, IrradianceRows,
                                      IrradianceColumns, 0, MapPosition(frame[2]));
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
