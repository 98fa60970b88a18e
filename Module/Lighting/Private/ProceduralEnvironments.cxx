// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ProceduralEnvironments.h"

#include "HalfVector.h" // Pi

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
double Smooth(double t)
{
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// exp(x) as a share of radiances of 0.01 and more: below exp(-60) no digit of theirs changes, and
// exp is slow where it underflows.
double GetShare(double x) { return x > -60.0 ? std::exp(x) : 0.0; }

// The hall, in metres around the viewer's eye.
constexpr double HalfWidth = 7.0, Floor = -1.6, Ceiling = 14.0, HalfLength = 24.0;
constexpr double Bay = 6.0; // from window to window

// Distance from the middle of a bay, in [-Bay/2, Bay/2].
double GetBayOffset(double z) { return z - Bay * std::floor(z / Bay + 0.5); }

// Whether a point of a wall (across, up) lies in a window with a round arch, and not on its bars.
bool IsGlass(double across, double up, double halfWidth, double sill, double springing)
{
  if (up < sill || std::abs(across) > halfWidth ||
      (up > springing && std::hypot(across, up - springing) > halfWidth))
  {
    return false;
  }
  const bool mullion = std::abs(across) < 0.06 * halfWidth + 0.03;
  const bool bar = std::abs(std::remainder(up, 1.2)) < 0.05;
  return !mullion && !bar;
}

// Courses of stone.
glm::dvec3 GetStone(double across, double up)
{
  const double course = std::floor(up / 0.6);
  const double shift = 0.5 * std::fmod(std::abs(course), 2.0);
  const double block = std::floor(across / 1.3 + shift);
  const double shade = 0.85 + 0.15 * std::sin(12.9898 * block + 78.233 * course);
  return glm::dvec3(0.050, 0.040, 0.031) * shade;
}

glm::dvec3 GetSideWall(const glm::dvec3& p)
{
  const double across = GetBayOffset(p.z);
  if (IsGlass(across, p.y, 1.0, 3.2, 9.2))
  {
    // The sun stands behind one side, the sky behind the other.
    return p.x < 0.0 ? glm::dvec3(34.0, 25.0, 15.0) : glm::dvec3(5.0, 6.5, 9.0);
  }
  const double pillar = Smooth((std::abs(across) - 2.4) / 0.3);
  return GetStone(p.z, p.y) * (1.0 - 0.6 * pillar) * (0.6 + 0.05 * (p.y - Floor));
}

glm::dvec3 GetEndWall(const glm::dvec3& p)
{
  if (p.z < 0.0) // the choir: three tall bright windows
  {
    const double across = p.x - 3.4 * std::clamp(std::round(p.x / 3.4), -1.0, 1.0);
    if (IsGlass(across, p.y, 1.1, 1.6, 8.5))
    {
      return { 22.0, 23.0, 26.0 };
    }
    return GetStone(p.x, p.y);
  }
  const double r = std::hypot(p.x, p.y - 7.0);
  const double turn = std::atan2(p.y - 7.0, p.x) / (2.0 * Pi);
  if (r < 3.6)
  {
    const bool spoke = std::abs(std::remainder(turn, 1.0 / 12.0)) * r * 2.0 * Pi < 0.09;
    const bool ring = std::abs(r - 1.2) < 0.08 || std::abs(r - 2.6) < 0.08;
    if (spoke || ring)
    {
      return { 0.02, 0.018, 0.016 };
    }
    const double petal = std::floor(turn * 12.0) + (r > 1.2 ? 1.0 : 0.0) + (r > 2.6 ? 1.0 : 0.0);
    const double phase = std::fmod(petal + 24.0, 3.0);
    return phase < 1.0 ? glm::dvec3(26.0, 7.0, 3.0)
                       : (phase < 2.0 ? glm::dvec3(4.0, 9.0, 24.0) : glm::dvec3(24.0, 19.0, 9.0));
  }
  return GetStone(p.x, p.y);
}

glm::dvec3 GetFloor(const glm::dvec3& p)
{
  const bool dark = (static_cast<long>(std::floor(p.x)) + static_cast<long>(std::floor(p.z))) & 1;
  const glm::dvec3 tile = dark ? glm::dvec3(0.045, 0.035, 0.03) : glm::dvec3(0.10, 0.085, 0.07);
  // Sunlight through the windows lies aslant on the tiles.
  const double across = GetBayOffset(p.z - 0.5 * p.x);
  const bool sunny = p.x > 1.6 && p.x < 5.6 && std::abs(across) < 0.9;
  return sunny ? tile * 14.0 : tile;
}

glm::dvec3 GetCeiling(const glm::dvec3& p)
{
  const double rib = std::min(std::abs(GetBayOffset(p.z + 0.5 * Bay)), std::abs(p.x));
  return glm::dvec3(0.030, 0.022, 0.016) * (0.6 + 0.8 * Smooth((0.4 - rib) / 0.2));
}
}

//------------------------------------------------------------------------------
glm::dvec3 GetSkyRadiance(const glm::dvec3& d)
{
  // L(d) = s (zenith + (horizon - zenith) exp(-5 d.y) + sun + glow) + (1 - s) ground, s = 1 above
  // the horizon; sun and glow are lobes a exp(k (d.sun - 1)) of integral 2 pi a/k (Fisher 1953):
  // the sun gives an irradiance of about 6, the blue sky about 1.4.
  const glm::dvec3 zenith(0.16, 0.32, 0.72);
  const glm::dvec3 horizon(0.72, 0.84, 1.0);
  const glm::dvec3 ground(0.21, 0.18, 0.15);
  const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.5, 0.65, 0.6));
  const glm::dvec3 sun = 1430.0 * glm::dvec3(1.0, 0.93, 0.82);
  const glm::dvec3 glow = 0.9 * glm::dvec3(1.0, 0.9, 0.75);
  const double sunSharpness = 1500.0;
  const double glowSharpness = 14.0;
  const double fromSun = glm::dot(d, toSun) - 1.0;
  const glm::dvec3 sky = glm::mix(zenith, horizon, std::exp(-5.0 * std::max(d.y, 0.0))) +
                         sun * GetShare(sunSharpness * fromSun) +
                         glow * std::exp(glowSharpness * fromSun);
  // Sky and ground meet over this much of d.y; a hard edge would alias.
  return glm::mix(ground, sky, Smooth(0.5 + d.y / 0.04));
}

//------------------------------------------------------------------------------
glm::dvec3 GetHallRadiance(const glm::dvec3& d)
{
  const auto reach = [](double component, double low, double high)
  { return component > 1e-12 ? high / component : (component < -1e-12 ? low / component : 1e30); };
  const double x = reach(d.x, -HalfWidth, HalfWidth);
  const double y = reach(d.y, Floor, Ceiling);
  const double z = reach(d.z, -HalfLength, HalfLength);
  const double t = std::min({ x, y, z });
  const glm::dvec3 p = t * d;
  glm::dvec3 radiance =
    t == y ? (d.y < 0.0 ? GetFloor(p) : GetCeiling(p)) : (t == x ? GetSideWall(p) : GetEndWall(p));
  // Lamps under the vault.
  static const glm::dvec3 lamps[] = { glm::normalize(glm::dvec3(0.8, 5.5, -12.0)),
    glm::normalize(glm::dvec3(0.8, 5.5, -5.0)), glm::normalize(glm::dvec3(0.8, 5.5, 6.0)),
    glm::normalize(glm::dvec3(0.8, 5.5, 13.0)) };
  for (const glm::dvec3& lamp : lamps)
  {
    radiance += glm::dvec3(900.0, 620.0, 330.0) * GetShare(6000.0 * (glm::dot(d, lamp) - 1.0));
  }
  return radiance;
}
} // namespace measuredbrdf
