// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceTable.h"

#include "HalfVector.h" // for Pi
#include "LobePlacement.h"
#include "TableBytes.h"
#include "TableLamps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
glm::dvec3 RadianceTable::Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t,
  const FilterWeights& filter, const TableLamps* lamps) const
{
  const LobePlacement place(n, o, t);
  const double u = place.U;
  const glm::dvec3 axis = GetProfileValue(this->Profile, 0, u);
  const glm::dvec2 delta = GetAxisTurn(axis);
  const glm::dvec3 d = place.GetAxis(delta.x, delta.y);
  const MapPosition at(d);
  const glm::dvec2 around = place.GetTurn(delta.x, delta.y, at);
  const double psi = std::atan2(around.y, around.x) / (2.0 * Pi);
  const Neighbors turn = PeriodicNeighbors(psi + 0.5 / this->Azimuths, this->Azimuths);
  const double w = std::clamp(axis.x, 0.0, this->Angles - 1.0);
  const int angle = std::min(static_cast<int>(w), this->Angles - 2);
  const auto value = [&](int azimuth, int k)
  {
    return GetMapValue(
      this->Radiance, this->Rows, this->Columns, this->GetMap(k, azimuth), at, filter);
  };
  const auto between = [&](int k)
  { return glm::mix(value(turn.First, k), value(turn.Second, k), filter.Round(turn.Weight)); };
  glm::dvec3 sum = glm::mix(between(angle), between(angle + 1), w - angle);
  sum *= GetProfileValue(this->Profile, 1, u);
  const glm::dvec3 lambert =
    this->HasFloor ? GetProfileValue(this->Profile, 2, u) : glm::dvec3(0.0);
  if (this->HasFloor)
  {
    sum += lambert * GetOctahedralValue(*this->Irradiance, IrradianceSide, n, filter);
  }
  if (lamps)
  {
    sum += lamps->Sum(place.Local, place.View, d, lambert);
  }
  return glm::max(sum, glm::dvec3(0.0));
}

std::vector<std::uint64_t> RadianceTable::GetSizes() const
{
  return { static_cast<std::uint64_t>(this->Rows), static_cast<std::uint64_t>(this->Angles),
    static_cast<std::uint64_t>(this->Azimuths) };
}

std::string RadianceTable::GetBytes() const
{
  const Texels none;
  return WriteTableBytes(this->GetSizes(), { &this->Profile },
    { &this->Radiance, this->HasFloor ? this->Irradiance.get() : &none });
}

bool RadianceTable::TakeBytes(const std::string& bytes)
{
  TableParts parts;
  if (!ReadTableBytes(bytes, parts) || parts.Numbers != this->GetSizes() ||
      parts.Arrays.size() != 1 || parts.Arrays[0].size() != 3 * 3 * ProfileSize ||
      parts.Texels.size() != 2 || parts.Texels[0].size() != this->GetMap(this->Angles, 0) ||
      !IsIrradiance(parts.Texels[1]))
  {
    return false;
  }
  this->Profile = std::move(parts.Arrays[0]);
  this->Radiance = std::move(parts.Texels[0]);
  this->HasFloor = !parts.Texels[1].empty();
  this->Irradiance = std::make_shared<Texels>(std::move(parts.Texels[1]));
  return true;
}

bool RadianceTable::IsIrradiance(const Texels& values)
{
  return values.empty() || values.size() == 1u * IrradianceSide * IrradianceSide;
}
} // namespace measuredbrdf
