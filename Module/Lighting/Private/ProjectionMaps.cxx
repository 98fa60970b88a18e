// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ProjectionMaps.h"

#include "HalfVector.h" // for Pi
#include "Projections.h"
#include "vtkEnvironment.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{

//------------------------------------------------------------------------------
// Point (a,b) in [-1,1]^2 of an upright face, a to the right, b down -> environment direction, of
// length sqrt(1 + a^2 + b^2). OpenGL 3.2, table 3.19, with its z turned round.
glm::dvec3 GetFacePoint(int face, double a, double b)
{
  switch (face)
  {
    case 0:
      return { 1.0, -b, a };
    case 1:
      return { -1.0, -b, -a };
    case 2:
      return { a, 1.0, -b };
    case 3:
      return { a, -1.0, b };
    case 4:
      return { a, -b, -1.0 };
    default:
      return { -a, -b, 1.0 };
  }
}

//------------------------------------------------------------------------------
// The face that a direction hits, and where.
int GetFace(const glm::dvec3& d, double& a, double& b)
{
  const glm::dvec3 m = glm::abs(d);
  if (m.x >= m.y && m.x >= m.z)
  {
    a = (d.x > 0.0 ? d.z : -d.z) / m.x;
    b = -d.y / m.x;
    return d.x > 0.0 ? 0 : 1;
  }
  if (m.y >= m.z)
  {
    a = d.x / m.y;
    b = (d.y > 0.0 ? -d.z : d.z) / m.y;
    return d.y > 0.0 ? 2 : 3;
  }
  a = (d.z < 0.0 ? d.x : -d.x) / m.z;
  b = -d.y / m.z;
  return d.z < 0.0 ? 4 : 5;
}

//------------------------------------------------------------------------------
// The face that shows at (u,v), and where; -1 beside the faces.
int FindFace(const CubeLayout& layout, const glm::dvec2& uv, double& a, double& b)
{
  const double x = uv.x * layout.Columns;
  const double y = (1.0 - uv.y) * layout.Rows;
  const int column = std::clamp(static_cast<int>(x), 0, layout.Columns - 1);
  const int row = std::clamp(static_cast<int>(y), 0, layout.Rows - 1);
  for (int face = 0; face < 6; ++face)
  {
    if (layout.Cells[face] == glm::ivec2(column, row))
    {
      const double sign = face == 5 && layout.TurnedBack ? -1.0 : 1.0;
      a = sign * (2.0 * (x - column) - 1.0);
      b = sign * (2.0 * (y - row) - 1.0);
      return face;
    }
  }
  return -1;
}

//------------------------------------------------------------------------------
// 1 - cos of the angle between the direction at radius r and the disc's middle: the solid angle
// within that radius, over 2 pi.
double GetCap(int projection, double r)
{
  if (r >= 1.0)
  {
    return 2.0;
  }
  const double s = projection == Projections::MIRROR_BALL ? r : std::sin(0.5 * Pi * r);
  return 2.0 * s * s;
}

//------------------------------------------------------------------------------
// Integral of GetCap over the azimuth along a piece of a straight line that the rim does not cut.
double IntegrateCap(int projection, const glm::dvec2& p, const glm::dvec2& q)
{
  const double cross = p.x * q.y - p.y * q.x;
  const glm::dvec2 middle = 0.5 * (p + q);
  if (glm::dot(middle, middle) >= 1.0)
  {
    return 2.0 * std::atan2(cross, glm::dot(p, q));
  }
  // Gauss-Legendre, 8 points; dphi = (x dy - y dx)/r^2 has the constant numerator `cross`.
  const double nodes[4] = { 0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
    0.9602898564975363 };
  const double weights[4] = { 0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
    0.1012285362903763 };
  double sum = 0.0;
  for (int k = 0; k < 8; ++k)
  {
    const double t = (k < 4 ? 0.5 : -0.5) * nodes[k % 4];
    const glm::dvec2 at = middle + t * (q - p);
    const double square = std::max(glm::dot(at, at), 1e-300);
    sum += 0.5 * weights[k % 4] * GetCap(projection, std::sqrt(square)) / square;
  }
  return sum * cross;
}

//------------------------------------------------------------------------------
// The same along any piece: cut at the rim first.
double IntegrateEdge(int projection, const glm::dvec2& p, const glm::dvec2& q)
{
  // |p + t (q - p)| = 1.
  const glm::dvec2 d = q - p;
  const double a = glm::dot(d, d);
  const double b = glm::dot(p, d);
  const double root = std::sqrt(std::max(b * b - a * (glm::dot(p, p) - 1.0), 0.0));
  const double cuts[4] = { 0.0, std::clamp((-b - root) / a, 0.0, 1.0),
    std::clamp((-b + root) / a, 0.0, 1.0), 1.0 };
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    if (cuts[k] < cuts[k + 1])
    {
      sum += IntegrateCap(projection, p + cuts[k] * d, p + cuts[k + 1] * d);
    }
  }
  return sum;
}

//------------------------------------------------------------------------------
// Solid angle of [x0,x1] x [y0,y1] on the face of a cube at distance 1 (corner formula: the
// rectangle [0,x] x [0,y] covers atan(x y / sqrt(1 + x^2 + y^2))).
double GetFaceSolidAngle(double x0, double x1, double y0, double y1)
{
  const auto corner = [](double x, double y)
  { return std::atan2(x * y, std::sqrt(1.0 + x * x + y * y)); };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}
} // namespace

//------------------------------------------------------------------------------
const CubeLayout* GetCubeLayout(int projection)
{
  static const CubeLayout horizontalCross = { 4, 3,
    { { 2, 1 }, { 0, 1 }, { 1, 0 }, { 1, 2 }, { 1, 1 }, { 3, 1 } }, false };
  static const CubeLayout verticalCross = { 3, 4,
    { { 2, 1 }, { 0, 1 }, { 1, 0 }, { 1, 2 }, { 1, 1 }, { 1, 3 } }, true };
  static const CubeLayout horizontalStrip = { 6, 1,
    { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 4, 0 }, { 5, 0 } }, false };
  static const CubeLayout verticalStrip = { 1, 6,
    { { 0, 0 }, { 0, 1 }, { 0, 2 }, { 0, 3 }, { 0, 4 }, { 0, 5 } }, false };
  switch (projection)
  {
    case Projections::CUBE_HORIZONTAL_CROSS:
      return &horizontalCross;
    case Projections::CUBE_VERTICAL_CROSS:
      return &verticalCross;
    case Projections::CUBE_HORIZONTAL_STRIP:
      return &horizontalStrip;
    case Projections::CUBE_VERTICAL_STRIP:
      return &verticalStrip;
    default:
      return nullptr;
  }
}

//------------------------------------------------------------------------------
bool IsDisc(int projection)
{
  return projection == Projections::ANGULAR_MAP || projection == Projections::MIRROR_BALL;
}

//------------------------------------------------------------------------------
bool MapToDirection(int projection, const glm::dvec2& uv, glm::dvec3& direction)
{
  if (projection == Projections::LAT_LONG)
  {
    vtkEnvironment::GetDirection(uv.x, uv.y, &direction.x);
    return true;
  }
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    double a;
    double b;
    const int face = FindFace(*layout, uv, a, b);
    direction = face < 0 ? glm::dvec3(0.0) : glm::normalize(GetFacePoint(face, a, b));
    return face >= 0;
  }
  const glm::dvec2 p = 2.0 * uv - 1.0;
  const double square = glm::dot(p, p);
  direction = glm::dvec3(0.0);
  if (square > 1.0)
  {
    return false;
  }
  if (projection == Projections::MIRROR_BALL)
  {
    // The line of sight mirrored at the normal (X, Y, sqrt(1 - r^2)).
    const double z = std::sqrt(1.0 - square);
    direction = glm::dvec3(2.0 * z * p, 1.0 - 2.0 * square);
    return true;
  }
  const double r = std::sqrt(square);
  const double scale = r > 0.0 ? std::sin(Pi * r) / r : Pi;
  direction = glm::dvec3(scale * p, -std::cos(Pi * r));
  return true;
}

//------------------------------------------------------------------------------
bool ShowsNothing(int projection, const glm::dvec2& low, const glm::dvec2& high)
{
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    double a;
    double b;
    return FindFace(*layout, 0.5 * (low + high), a, b) < 0;
  }
  const glm::dvec2 nearest = 2.0 * glm::clamp(glm::dvec2(0.5), low, high) - 1.0;
  return IsDisc(projection) && glm::dot(nearest, nearest) >= 1.0;
}

//------------------------------------------------------------------------------
glm::dvec2 MapToImage(int projection, const glm::dvec3& direction)
{
  glm::dvec2 uv;
  if (projection == Projections::LAT_LONG)
  {
    vtkEnvironment::GetCoordinates(&direction.x, uv.x, uv.y);
    return uv;
  }
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    double a;
    double b;
    const int face = GetFace(direction, a, b);
    const double sign = face == 5 && layout->TurnedBack ? -0.5 : 0.5;
    uv.x = (layout->Cells[face].x + 0.5 + sign * a) / layout->Columns;
    uv.y = 1.0 - (layout->Cells[face].y + 0.5 + sign * b) / layout->Rows;
    return uv;
  }
  const double side = std::hypot(direction.x, direction.y);
  const bool ball = projection == Projections::MIRROR_BALL;
  const double angle = std::atan2(side, ball ? direction.z : -direction.z);
  const double r = ball ? std::sin(0.5 * angle) : angle / Pi;
  const glm::dvec2 towards =
    side > 0.0 ? glm::dvec2(direction.x, direction.y) / side : glm::dvec2(1.0, 0.0);
  return 0.5 + 0.5 * r * towards;
}

//------------------------------------------------------------------------------
double GetDensity(int projection, const glm::dvec2& uv)
{
  if (projection == Projections::LAT_LONG)
  {
    return 2.0 * Pi * Pi * std::sin(Pi * uv.y);
  }
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    double a;
    double b;
    if (FindFace(*layout, uv, a, b) < 0)
    {
      return 0.0;
    }
    const double square = 1.0 + a * a + b * b;
    return 4.0 * layout->Columns * layout->Rows / (square * std::sqrt(square));
  }
  if (projection == Projections::MIRROR_BALL)
  {
    return 16.0;
  }
  const double r = glm::length(2.0 * uv - 1.0);
  return 4.0 * Pi * (r > 0.0 ? std::abs(std::sin(Pi * r)) / r : Pi);
}

//------------------------------------------------------------------------------
double GetSolidAngle(int projection, int width, int height, int x, int y)
{
  if (projection == Projections::LAT_LONG)
  {
    return 4.0 * Pi / width * std::sin(Pi / (2.0 * height)) * std::sin(Pi * (y + 0.5) / height);
  }
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    double a;
    double b;
    if (FindFace(*layout, { (x + 0.5) / width, (y + 0.5) / height }, a, b) < 0)
    {
      return 0.0;
    }
    const double da = static_cast<double>(layout->Columns) / width;
    const double db = static_cast<double>(layout->Rows) / height;
    return GetFaceSolidAngle(a - da, a + da, b - db, b + db);
  }
  // Green's theorem: the sum over the outline, counterclockwise.
  const glm::dvec2 p00(2.0 * x / width - 1.0, 2.0 * y / height - 1.0);
  const glm::dvec2 p11(2.0 * (x + 1.0) / width - 1.0, 2.0 * (y + 1.0) / height - 1.0);
  const glm::dvec2 p10(p11.x, p00.y);
  const glm::dvec2 p01(p00.x, p11.y);
  return IntegrateEdge(projection, p00, p10) + IntegrateEdge(projection, p10, p11) +
         IntegrateEdge(projection, p11, p01) + IntegrateEdge(projection, p01, p00);
}
} // namespace measuredbrdf
