// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnisotropicTable.h"

#include "HalfVector.h" // for Pi
#include "LobePlacement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
// u: as profiles over theta_o are read; period: of the view's azimuth, in [0,1].
glm::dvec3 AnisotropicTable::GetProfile(int layer, double u, double period) const
{
  constexpr int angles = AnisotropicViews::Angles;
  constexpr int azimuths = AnisotropicViews::Azimuths;
  const double exact = u * (angles - 1);
  const int low = std::min(static_cast<int>(exact), angles - 2);
  return MixTexels(this->Profile, angles,
    static_cast<std::size_t>(layer) * static_cast<std::size_t>(angles * azimuths),
    { low, low + 1, exact - low }, PeriodicNeighbors(period + 0.5 / azimuths, azimuths));
}

glm::dvec3 AnisotropicTable::Evaluate(
  const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const
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
  const glm::dvec3 parts = this->GetProfile(0, u, phi);
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
      GetMapColumns(this->Columns, at), GetMapRows(this->Rows, at), turn.Weight);
  };
  const auto between = [&](int k)
  { return glm::mix(value(k, first), value(k, first + 1), p - first); };
  glm::dvec3 sum = glm::mix(between(angle), between(angle + 1), w - angle);
  sum *= this->GetProfile(1, u, phi);
  if (this->HasFloor)
  {
    sum += this->GetProfile(2, u, phi) * RadianceTable::GetIrradiance(*this->Irradiance, n);
  }
  return glm::max(sum, glm::dvec3(0.0));
}
} // namespace measuredbrdf
