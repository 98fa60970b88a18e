// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Chromaticities.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
// What rounding in headers leaves: Radiance's own primaries differ by 0.01.
constexpr double HeaderRounding = 1e-3;
constexpr double LeastDeterminant = 1e-6;

//------------------------------------------------------------------------------
glm::dvec3 ToXyz(double x, double y) { return glm::dvec3(x, y, 1.0 - x - y); }

//------------------------------------------------------------------------------
glm::dmat3 GetPrimaries(const Chromaticities& c)
{
  return glm::dmat3(ToXyz(c[0], c[1]), ToXyz(c[2], c[3]), ToXyz(c[4], c[5])); // columns
}

//------------------------------------------------------------------------------
glm::dvec3 GetWhite(const Chromaticities& c) { return ToXyz(c[6], c[7]) / c[7]; }

//------------------------------------------------------------------------------
// SMPTE RP 177-1993, 3.3: the primaries' columns scaled so that (1, 1, 1) is the white of Y = 1.
glm::dmat3 GetToXyz(const Chromaticities& c)
{
  const glm::dmat3 primaries = GetPrimaries(c);
  const glm::dvec3 scale = glm::inverse(primaries) * GetWhite(c);
  return glm::dmat3(primaries[0] * scale[0], primaries[1] * scale[1], primaries[2] * scale[2]);
}

//------------------------------------------------------------------------------
// The linear Bradford transform (Lam 1985; ICC.1:2022, E.3): from XYZ seen under one white to XYZ
// seen under another.
glm::dmat3 GetAdaptation(const glm::dvec3& from, const glm::dvec3& to)
{
  const glm::dmat3 cones = glm::transpose(
    glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296)); // rows
  const glm::dvec3 gain = (cones * to) / (cones * from);
  const glm::dmat3 scale(gain.x, 0.0, 0.0, 0.0, gain.y, 0.0, 0.0, 0.0, gain.z);
  return glm::inverse(cones) * scale * cones;
}
}

//------------------------------------------------------------------------------
bool IsRec709(const Chromaticities& chromaticities)
{
  return std::equal(chromaticities.begin(), chromaticities.end(), Rec709.begin(),
    [](double a, double b) { return std::abs(a - b) <= HeaderRounding; });
}

//------------------------------------------------------------------------------
bool SpanColors(const Chromaticities& chromaticities)
{
  if (!std::all_of(chromaticities.begin(), chromaticities.end(),
        [](double value) { return std::isfinite(value) && std::abs(value) < 1e3; }) ||
      chromaticities[7] < HeaderRounding ||
      std::abs(glm::determinant(GetPrimaries(chromaticities))) < LeastDeterminant)
  {
    return false;
  }
  const glm::dvec3 shares = glm::inverse(GetPrimaries(chromaticities)) * GetWhite(chromaticities);
  return shares.x > 0.0 && shares.y > 0.0 && shares.z > 0.0;
}

//------------------------------------------------------------------------------
glm::dmat3 GetToRec709(const Chromaticities& from)
{
  return glm::inverse(GetToXyz(Rec709)) * GetAdaptation(GetWhite(from), GetWhite(Rec709)) *
         GetToXyz(from);
}
} // namespace measuredbrdf
