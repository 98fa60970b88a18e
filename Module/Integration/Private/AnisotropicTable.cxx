// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnisotropicTable.h"

#include "HalfVector.h" // for Pi
#include "LobePlacement.h"
#include "TableBytes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
// u: as profiles over theta_o are read; period: of the view's azimuth, in [0,1].
glm::dvec3 AnisotropicTable::GetProfile(
  int layer, double u, double period, const FilterWeights& filter) const
{
  constexpr int angles = AnisotropicViews::Angles;
  constexpr int azimuths = AnisotropicViews::Azimuths;
  const double exact = u * (angles - 1);
  const int low = std::min(static_cast<int>(exact), angles - 2);
  return MixTexels(this->Profile, angles,
    static_cast<std::size_t>(layer) * static_cast<std::size_t>(angles * azimuths),
    { low, low + 1, exact - low }, PeriodicNeighbors(period + 0.5 / azimuths, azimuths), filter);
}

glm::dvec3 AnisotropicTable::Evaluate(
  const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t, const FilterWeights& filter) const
{
  Frame frame = FrameAbout(n, t);
  glm::dvec3 view = LiftView(ToLocal(frame, o));
  if (this->Periods == 2 && view.y < 0.0) // the same after half a turn
  {
    frame[0] = -frame[0];
    frame[1] = -frame[1];
    view = glm::dvec3(-view.x, -view.y, view.z);
  }
  const double sine = std::hypot(view.x, view.y);
  const glm::dvec2 azimuth = sine > 1e-6 ? glm::dvec2(view) / sine : glm::dvec2(1.0, 0.0);
  double phi = std::atan2(azimuth.y, azimuth.x) / (2.0 * Pi);
  phi = this->Periods * (phi - std::floor(phi));
  const double u = GetProfilePosition(std::atan2(sine, view.z));

  // The axis, and the tangent carried there by the smallest rotation.
  const glm::dvec3 parts = this->GetProfile(0, u, phi, filter);
  const glm::dvec2 level(
    parts.x * azimuth.x - parts.y * azimuth.y, parts.x * azimuth.y + parts.y * azimuth.x);
  const double up = std::sqrt(std::max(1.0 - glm::dot(level, level), 0.0));
  const glm::dvec3 axis = glm::normalize(frame * glm::dvec3(level, up));
  const glm::dvec3 along = frame * glm::dvec3(1.0 - level.x * level.x / (1.0 + up),
                                     -level.x * level.y / (1.0 + up), -level.x);
  const MapPosition at(axis);
  const double psi = std::atan2(glm::dot(along, at.Across), glm::dot(along, at.Along)) / (2.0 * Pi);

  const double w = std::clamp(parts.z, 0.0, this->Angles - 1.0);
  const int angle = std::min(static_cast<int>(w), this->Angles - 2);
  const double p = phi * this->ViewAzimuths;
  const int first = std::min(static_cast<int>(p), this->ViewAzimuths - 1);
  const auto value = [&](int k, int viewAzimuth)
  {
    // After the last azimuth the first one comes again, in a frame that is turned by the period.
    const bool again = viewAzimuth == this->ViewAzimuths;
    const Neighbors turn = PeriodicNeighbors(
      psi + (again ? 1.0 / this->Periods : 0.0) + 0.5 / this->Azimuths, this->Azimuths);
    const auto map = [&](int psiIndex)
    { return this->GetMap(k, psiIndex, again ? 0 : viewAzimuth); };
    return MixTexels(this->Radiance, this->Columns, { map(turn.First), map(turn.Second) },
      GetMapColumns(this->Columns, at), GetMapRows(this->Rows, at), turn.Weight, filter);
  };
  const auto between = [&](int k)
  { return glm::mix(value(k, first), value(k, first + 1), p - first); };
  glm::dvec3 sum = glm::mix(between(angle), between(angle + 1), w - angle);
  sum *= this->GetProfile(1, u, phi, filter);
  if (this->HasFloor)
  {
    sum += this->GetProfile(2, u, phi, filter) *
           RadianceTable::GetIrradiance(*this->Irradiance, n, filter);
  }
  return glm::max(sum, glm::dvec3(0.0));
}

std::vector<std::uint64_t> AnisotropicTable::GetSizes() const
{
  return { static_cast<std::uint64_t>(this->Rows), static_cast<std::uint64_t>(this->Angles),
    static_cast<std::uint64_t>(this->Azimuths), static_cast<std::uint64_t>(this->ViewAzimuths) };
}

// Last of the numbers: the periods.
std::string AnisotropicTable::GetBytes() const
{
  const ScaledTexels none;
  const ScaledTexels& irradiance = this->HasFloor ? *this->Irradiance : none;
  const std::vector<float> scale = RadianceTable::GetScale(irradiance);
  std::vector<std::uint64_t> numbers = this->GetSizes();
  numbers.push_back(static_cast<std::uint64_t>(this->Periods));
  return WriteTableBytes(
    numbers, { &this->Profile, &scale }, { &this->Radiance, &irradiance.Texels });
}

bool AnisotropicTable::TakeBytes(const std::string& bytes)
{
  constexpr std::size_t profile = 3 * 3 * AnisotropicViews::Angles * AnisotropicViews::Azimuths;
  TableParts parts;
  if (!ReadTableBytes(bytes, parts) || parts.Numbers.empty())
  {
    return false;
  }
  const std::uint64_t periods = parts.Numbers.back();
  parts.Numbers.pop_back();
  if (parts.Numbers != this->GetSizes() || (periods != 1 && periods != 2) ||
      parts.Arrays.size() != 2 || parts.Arrays[0].size() != profile || parts.Texels.size() != 2 ||
      parts.Texels[0].size() != this->GetMap(this->Angles, 0, 0))
  {
    return false;
  }
  const auto irradiance =
    RadianceTable::TakeIrradiance(std::move(parts.Texels[1]), parts.Arrays[1]);
  if (!irradiance)
  {
    return false;
  }
  this->Periods = static_cast<int>(periods);
  this->Profile = std::move(parts.Arrays[0]);
  this->Radiance = std::move(parts.Texels[0]);
  this->HasFloor = !irradiance->Texels.empty();
  this->Irradiance = irradiance;
  return true;
}
} // namespace measuredbrdf
