// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where a pair of normal and view looks into maps over the axis of a lobe: what tables of radiance
 * have in common, as vtkBRDFCommon.glsl's brdfMapPosition does it.
 */

#ifndef LobePlacement_h
#define LobePlacement_h

#include "Floats.h"
#include "LobeViews.h"
#include "LocalFrame.h"
#include "Neighbors.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace measuredbrdf
{
/// Where a direction lies in a map of rows (poles included) x columns: its frame is the meridian's
/// and the parallel's direction of growing angles.
struct MapPosition
{
  explicit MapPosition(const glm::dvec3& d)
  {
    // The harmonics' frame is the environment's (z, x, y).
    constexpr double pi = 3.14159265358979323846;
    const double sine = std::hypot(d.z, d.x);
    const glm::dvec2 azimuth = sine > 1e-7 ? glm::dvec2(d.z, d.x) / sine : glm::dvec2(1.0, 0.0);
    this->Azimuth = std::atan2(azimuth.y, azimuth.x) / (2.0 * pi);
    this->Polar = std::atan2(sine, d.y) / pi;
    this->Along = glm::dvec3(azimuth.y * d.y, -sine, azimuth.x * d.y);
    this->Across = glm::dvec3(azimuth.x, 0.0, -azimuth.y);
  }
  double Azimuth; // in turns
  double Polar;   // in half turns
  glm::dvec3 Along;
  glm::dvec3 Across;
};

///@{
/// RGB of a texel, stored as three floats or with a shared exponent.
inline glm::dvec3 GetTexel(const std::vector<float>& data, int index)
{
  return glm::dvec3(glm::make_vec3(&data[3 * index]));
}

inline glm::dvec3 GetTexel(const std::vector<std::uint32_t>& data, int index)
{
  return glm::dvec3(UnpackSharedExponent(data[index]));
}
///@}

/// Between four texels of a map that begins at the given texel.
template <typename Data>
glm::dvec3 MixTexels(
  const Data& data, int columns, std::size_t firstTexel, const Neighbors& x, const Neighbors& y)
{
  const auto inRow = [&](int row)
  {
    const int first = static_cast<int>(firstTexel) + columns * row;
    return glm::mix(GetTexel(data, first + x.First), GetTexel(data, first + x.Second), x.Weight);
  };
  return glm::mix(inRow(y.First), inRow(y.Second), y.Weight);
}

/// Between eight texels of two maps that begin at the given texels.
template <typename Data>
glm::dvec3 MixTexels(const Data& data, int columns, const std::array<std::size_t, 2>& firstTexels,
  const Neighbors& x, const Neighbors& y, double between)
{
  return glm::mix(MixTexels(data, columns, firstTexels[0], x, y),
    MixTexels(data, columns, firstTexels[1], x, y), between);
}

/// Neighbors in a map with rows at the poles (MapNodes::Poles).
///@{
inline Neighbors GetMapRows(int rows, const MapPosition& at)
{
  const double exact = at.Polar * (rows - 1);
  const int low = std::min(static_cast<int>(exact), rows - 2);
  return { low, low + 1, exact - low };
}

inline Neighbors GetMapColumns(int columns, const MapPosition& at)
{
  return PeriodicNeighbors(at.Azimuth + 0.5 / columns, columns);
}
///@}

/// Bilinear in a map with rows at the poles (MapNodes::Poles).
template <typename Data>
glm::dvec3 GetMapValue(
  const Data& data, int rows, int columns, std::size_t firstTexel, const MapPosition& at)
{
  return MixTexels(data, columns, firstTexel, GetMapColumns(columns, at), GetMapRows(rows, at));
}

/// Bilinear in a map of cells' centers (MapNodes::Centers).
inline glm::dvec3 GetCenteredValue(const std::vector<float>& data, int rows, int columns,
  std::size_t firstTexel, const MapPosition& at)
{
  return MixTexels(data, columns, firstTexel, PeriodicNeighbors(at.Azimuth, columns),
    ClampedNeighbors(at.Polar, rows));
}

/// A row of profiles over theta_o, LobeViews::NumberOfViews texels each, at u in [0,1]. Tables are
/// looked up at the nearest of many such values (RadianceTable.h).
inline glm::dvec3 GetProfileValue(const std::vector<float>& profile, int row, double u)
{
  constexpr int size = LobeViews::NumberOfViews;
  const double exact = u * (size - 1);
  const int low = std::min(static_cast<int>(exact), size - 2);
  return glm::mix(
    GetTexel(profile, size * row + low), GetTexel(profile, size * row + low + 1), exact - low);
}

/// What shaders read of profiles, and their C++ twins do: the nearest of so many values.
constexpr int ProfileTexels = 2048;

/// The position in [0,1] of the texel nearest to one.
inline double GetNearestPosition(double u)
{
  return std::floor(u * (ProfileTexels - 1.0) + 0.5) / (ProfileTexels - 1.0);
}

/// By how much the sine of the axis' angle from the normal, which profiles hold in their first row
/// (., ., sine), exceeds that of the view's at u.
inline double GetAxisExcess(const std::vector<float>& profile, double u)
{
  const double rest = (1.0 - u) * (1.0 - u);
  return GetProfileValue(profile, 0, u).z - std::sin(LobeViews::GetLastAngle() * (1.0 - rest));
}

/// Cosine and sine of the axis' angle from the normal, seen at theta_o, where profiles are read at
/// u.
inline glm::dvec2 GetAxisTurn(const std::vector<float>& profile, double theta, double u)
{
  const double sine = std::sin(theta) + GetAxisExcess(profile, u);
  return { std::sqrt(std::max(1.0 - sine * sine, 0.0)), sine };
}

///@{
/// A direction in the unit square: the octahedron about the environment's y, its lower half folded
/// out (Engelhardt, Dachsbacher 2008), as vtkBRDFCommon.glsl's brdfOctahedralPosition; and back.
inline glm::dvec2 GetOctahedralPosition(const glm::dvec3& d)
{
  const glm::dvec2 p = glm::dvec2(d.z, d.x) / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  const glm::dvec2 side(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return 0.5 + 0.5 * (d.y < 0.0 ? side * (1.0 - glm::abs(glm::dvec2(p.y, p.x))) : p);
}

inline glm::dvec3 GetOctahedralDirection(const glm::dvec2& place)
{
  const glm::dvec2 p = 2.0 * place - 1.0;
  const double y = 1.0 - std::abs(p.x) - std::abs(p.y);
  const glm::dvec2 side(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  const glm::dvec2 q = y < 0.0 ? side * (1.0 - glm::abs(glm::dvec2(p.y, p.x))) : p;
  return glm::normalize(glm::dvec3(q.y, y, q.x));
}
///@}

/// Bilinear in an octahedral map of side x side texels whose outer centers lie on the square's
/// edge: there is no seam.
template <typename Data>
glm::dvec3 GetOctahedralValue(const Data& data, int side, const glm::dvec3& d)
{
  const glm::dvec2 exact = (side - 1.0) * GetOctahedralPosition(d);
  const auto neighbors = [side](double at)
  {
    const int low = std::clamp(static_cast<int>(at), 0, side - 2);
    return Neighbors{ low, low + 1, at - low };
  };
  return MixTexels(data, side, 0, neighbors(exact.x), neighbors(exact.y));
}

/// Where profiles are read for a view angle.
inline double GetProfilePosition(double theta)
{
  return LobeViews::GetPosition(theta) / (LobeViews::NumberOfViews - 1);
}

/// A pair; and, with the lobe's angle from the normal, its axis and plane.
struct LobePlacement
{
  LobePlacement(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t)
    : Local(FrameAbout(n, t))
    , View(LiftView(ToLocal(this->Local, o)))
    , Normal(n)
  {
    const glm::dvec3& view = this->View;
    const double sine = std::hypot(view.x, view.y);
    this->Theta = std::atan2(sine, view.z);
    this->U = GetProfilePosition(this->Theta);
    const glm::dvec2 azimuth = sine > 1e-6 ? glm::dvec2(view) / sine : glm::dvec2(1.0, 0.0);
    this->Across = this->Local[0] * azimuth.x + this->Local[1] * azimuth.y;
  }

  glm::dvec3 GetAxis(double cosine, double sine) const
  {
    return glm::normalize(cosine * this->Normal - sine * this->Across);
  }

  /// Cosine and sine of psi, the azimuth of the plane of incidence about the axis.
  glm::dvec2 GetTurn(double cosine, double sine, const MapPosition& axis) const
  {
    const glm::dvec3 along = cosine * this->Across + sine * this->Normal;
    const glm::dvec2 turn(glm::dot(along, axis.Along), glm::dot(along, axis.Across));
    const double length = glm::length(turn);
    return length > 0.0 ? turn / length : glm::dvec2(1.0, 0.0);
  }

  Frame Local;     // about the normal
  glm::dvec3 View; // in that frame
  glm::dvec3 Normal;
  glm::dvec3 Across; // the view's part along the surface
  double Theta;      // the view's polar angle
  double U;          // where profiles are read
};
} // namespace measuredbrdf

#endif
