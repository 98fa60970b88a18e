// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ColorDifference.h"

#include "SRGB.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr double Degree = 3.14159265358979323846 / 180.0;

//------------------------------------------------------------------------------
Color Multiply(const double matrix[3][3], const Color& v)
{
  return v * glm::make_mat3(&matrix[0][0]); // by rows
}

const Color White = Multiply(RGBToXYZ, Color(1.0));

//------------------------------------------------------------------------------
// Hue in [0,360), 0 of grays.
double GetHue(double a, double b)
{
  const double hue = a == 0.0 && b == 0.0 ? 0.0 : std::atan2(b, a) / Degree;
  return hue < 0.0 ? hue + 360.0 : hue;
}

//------------------------------------------------------------------------------
// c^7 / (c^7 + 25^7), which tells grays from colors.
double GetChromaShare(double c)
{
  const double c7 = std::pow(c, 7.0);
  return c7 / (c7 + std::pow(25.0, 7.0));
}
}

//------------------------------------------------------------------------------
Color ToRelativeXYZ(const Color& linear) { return Multiply(RGBToXYZ, linear) / White; }

//------------------------------------------------------------------------------
Color FromRelativeXYZ(const Color& xyz) { return Multiply(XYZToRGB, White * xyz); }

//------------------------------------------------------------------------------
Color ToLab(const Color& relativeXYZ)
{
  constexpr double delta = 6.0 / 29.0;
  Color t;
  for (int c = 0; c < 3; ++c)
  {
    const double value = relativeXYZ[c];
    t[c] =
      value > delta * delta * delta ? std::cbrt(value) : value / (3.0 * delta * delta) + 4.0 / 29.0;
  }
  return { 116.0 * t[1] - 16.0, 500.0 * (t[0] - t[1]), 200.0 * (t[1] - t[2]) };
}

//------------------------------------------------------------------------------
double GetDeltaE2000(const Color& lab1, const Color& lab2)
{
  // Grays' a* is stretched: a' = (1 + G) a*.
  const double share =
    GetChromaShare(0.5 * (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2])));
  const double stretch = 1.0 + 0.5 * (1.0 - std::sqrt(share));
  const double c1 = std::hypot(stretch * lab1[1], lab1[2]);
  const double c2 = std::hypot(stretch * lab2[1], lab2[2]);
  const double h1 = GetHue(stretch * lab1[1], lab1[2]);
  const double h2 = GetHue(stretch * lab2[1], lab2[2]);

  // The shorter way round from hue 1 to hue 2, and the hue half-way; a gray has none of its own.
  const bool gray = c1 * c2 == 0.0;
  double turn = gray ? 0.0 : h2 - h1;
  turn += turn > 180.0 ? -360.0 : turn < -180.0 ? 360.0 : 0.0;
  double hue = h1 + h2;
  if (!gray)
  {
    const bool around = std::abs(h1 - h2) > 180.0;
    hue = 0.5 * (hue + (!around ? 0.0 : hue < 360.0 ? 360.0 : -360.0));
  }

  const double dL = lab2[0] - lab1[0];
  const double dC = c2 - c1;
  const double dH = 2.0 * std::sqrt(c1 * c2) * std::sin(0.5 * turn * Degree);
  const double chroma = 0.5 * (c1 + c2);
  const double t =
    1.0 - 0.17 * std::cos((hue - 30.0) * Degree) + 0.24 * std::cos(2.0 * hue * Degree) +
    0.32 * std::cos((3.0 * hue + 6.0) * Degree) - 0.20 * std::cos((4.0 * hue - 63.0) * Degree);
  const double l50 = 0.5 * (lab1[0] + lab2[0]) - 50.0;
  const double sL = 1.0 + 0.015 * l50 * l50 / std::sqrt(20.0 + l50 * l50);
  const double sC = 1.0 + 0.045 * chroma;
  const double sH = 1.0 + 0.015 * chroma * t;
  // Blues: chroma and hue are turned against each other.
  const double bump = (hue - 275.0) / 25.0;
  const double rotation =
    -2.0 * std::sqrt(GetChromaShare(chroma)) * std::sin(60.0 * std::exp(-bump * bump) * Degree);
  const double l = dL / sL;
  const double c = dC / sC;
  const double h = dH / sH;
  return std::sqrt(std::max(l * l + c * c + h * h + rotation * c * h, 0.0));
}
} // namespace measuredbrdf
