// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ConservativeRemap.h"

#include "HalfVector.h" // for Pi
#include "ProjectionMaps.h"
#include "Projections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
// Outlines are carried over as straight lines: from cells no larger than this (radius, in
// radians)...
constexpr double LargestRadius = 0.04;
// ... whose center is carried no farther from the corners' mean than this part of the outline's
// breadth (area over longer diagonal), or of a texel. Seams, poles, rims and edges of cubes fail
// that: there, texels are quartered this often, down to points.
constexpr double Straightness = 0.05;
constexpr int Depth = 5;
// Corners are drawn in by this part of their cell, so that those on a seam fall on the cell's side.
constexpr double Inset = 1e-7;
// Parts of a texel that are rounding.
constexpr double LeastArea = 1e-13;

// The part of one row to the right of a side that goes from x = a to b >= a over a height.
void AddSide(double a, double b, double height, double* differences)
{
  int x = static_cast<int>(a);
  const int last = static_cast<int>(b);
  double* out = differences + x;
  if (x == last)
  {
    const double before = height * (0.5 * (a + b) - x);
    out[0] += height - before;
    out[1] += before;
    return;
  }
  const double rate = height / (b - a);
  for (double from = a; x <= last; ++x, ++out)
  {
    const double to = std::min(b, x + 1.0);
    const double part = rate * (to - from);
    const double before = part * (0.5 * (from + to) - x);
    out[0] += part - before;
    out[1] += before;
    from = to;
  }
}
}

//------------------------------------------------------------------------------
// In texels of the source.
struct ConservativeRemap::Polygon
{
  std::array<glm::dvec2, 4> Points;

  double GetArea() const
  {
    const glm::dvec2 a = this->Points[2] - this->Points[0];
    const glm::dvec2 b = this->Points[3] - this->Points[1];
    return 0.5 * std::abs(a.x * b.y - a.y * b.x);
  }
};

//------------------------------------------------------------------------------
// A rectangle of the target's (u,v).
struct ConservativeRemap::Cell
{
  glm::dvec2 Low;
  glm::dvec2 High;
  const Angles* Azimuth = nullptr; // of a whole texel of a lat-long target
  const Angles* Latitude = nullptr;

  glm::dvec2 GetCenter() const { return 0.5 * (this->Low + this->High); }
};

//------------------------------------------------------------------------------
ConservativeRemap::ConservativeRemap(
  const Image& source, const std::vector<float>& rgb, const Image& target)
  : Projection(source.Projection)
  , Width(source.Width)
  , Height(source.Height)
  , Target(target)
  , Pixels(rgb.data())
{
  if (target.Projection == Projections::LAT_LONG)
  {
    this->Columns = Tabulate(target.Width, 2.0 * Pi);
    this->Rows = Tabulate(target.Height, Pi);
  }
}

//------------------------------------------------------------------------------
std::vector<ConservativeRemap::Angles> ConservativeRemap::Tabulate(int count, double range)
{
  std::vector<Angles> result;
  for (int k = 0; k < count; ++k)
  {
    Angles angles;
    const double places[3] = { k + Inset, k + 0.5, k + 1.0 - Inset };
    for (std::size_t part = 0; part < 3; ++part)
    {
      const double angle = range * (places[part] / count - 0.5);
      angles[part] = glm::dvec2(std::cos(angle), std::sin(angle));
    }
    result.push_back(angles);
  }
  return result;
}

//------------------------------------------------------------------------------
glm::dvec3 ConservativeRemap::GetMean(int x, int y) const
{
  const glm::dvec2 size(this->Target.Width, this->Target.Height);
  const glm::dvec2 corner(x, y);
  Cell cell{ corner / size, (corner + 1.0) / size };
  if (!this->Columns.empty())
  {
    cell.Azimuth = &this->Columns[static_cast<std::size_t>(x)];
    cell.Latitude = &this->Rows[static_cast<std::size_t>(y)];
  }
  Sum sum;
  this->AddCell(cell, Depth, sum);
  return sum.SolidAngle > 0.0 ? sum.Radiance / sum.SolidAngle : glm::dvec3(0.0);
}

//------------------------------------------------------------------------------
// At a cell's low side (0), middle (1) or high side (2), both sides drawn in; false where nothing
// is shown.
bool ConservativeRemap::GetDirection(
  const Cell& cell, int across, int up, glm::dvec3& direction) const
{
  if (cell.Azimuth)
  {
    const glm::dvec2& azimuth = (*cell.Azimuth)[static_cast<std::size_t>(across)];
    const glm::dvec2& latitude = (*cell.Latitude)[static_cast<std::size_t>(up)];
    direction = glm::dvec3(latitude.x * azimuth.x, latitude.y, latitude.x * azimuth.y);
    return true;
  }
  const double places[3] = { Inset, 0.5, 1.0 - Inset };
  const glm::dvec2 at(places[across], places[up]);
  return MapToDirection(this->Target.Projection, cell.Low + at * (cell.High - cell.Low), direction);
}

//------------------------------------------------------------------------------
void ConservativeRemap::AddCell(const Cell& cell, int depth, Sum& sum) const
{
  if (ShowsNothing(this->Target.Projection, cell.Low, cell.High))
  {
    return;
  }
  Polygon outline;
  bool small = true;
  if (this->MapOutline(cell, outline, small))
  {
    this->AddPolygon(outline, sum);
    return;
  }
  const glm::dvec2 center = cell.GetCenter();
  if (depth <= 0 && small)
  {
    glm::dvec3 direction;
    if (MapToDirection(this->Target.Projection, center, direction))
    {
      const glm::dvec2 at = MapToImage(this->Projection, direction) *
                            glm::dvec2(static_cast<double>(this->Width), this->Height);
      const int x = std::clamp(static_cast<int>(at.x), 0, this->Width - 1);
      const int y = std::clamp(static_cast<int>(at.y), 0, this->Height - 1);
      const glm::dvec2 size = cell.High - cell.Low;
      this->AddTexel(x, y, size.x * size.y * GetDensity(this->Target.Projection, center), sum);
    }
    return;
  }
  const int next = depth - 1;
  this->AddCell({ cell.Low, center }, next, sum);
  this->AddCell({ { center.x, cell.Low.y }, { cell.High.x, center.y } }, next, sum);
  this->AddCell({ { cell.Low.x, center.y }, { center.x, cell.High.y } }, next, sum);
  this->AddCell({ center, cell.High }, next, sum);
}

//------------------------------------------------------------------------------
// The cell's outline in the source; false where straight lines between its corners will not do,
// with `small` false where that is for its size.
bool ConservativeRemap::MapOutline(const Cell& cell, Polygon& outline, bool& small) const
{
  const glm::dvec2 size(this->Width, this->Height);
  glm::dvec3 direction;
  if (!this->GetDirection(cell, 1, 1, direction))
  {
    return false;
  }
  const glm::dvec3 center = direction;
  glm::dvec2 mean(0.0);
  for (std::size_t k = 0; k < 4; ++k)
  {
    if (!this->GetDirection(cell, k == 1 || k == 2 ? 2 : 0, k < 2 ? 0 : 2, direction))
    {
      return false;
    }
    small = small && glm::distance(direction, center) <= LargestRadius;
    outline.Points[k] = MapToImage(this->Projection, direction) * size;
    mean += 0.25 * outline.Points[k];
  }
  if (!small)
  {
    return false;
  }
  const std::array<glm::dvec2, 4>& points = outline.Points;
  const double area = outline.GetArea();
  const double diagonal =
    std::max(glm::distance(points[0], points[2]), glm::distance(points[1], points[3]));
  const double off = glm::distance(MapToImage(this->Projection, center) * size, mean);
  return off * diagonal <= Straightness * std::max(area, diagonal);
}

//------------------------------------------------------------------------------
// Row by row, each side adds what lies to the right of it, with its direction's sign, to
// differences along the row; their running sum is the area in each texel (as fonts are drawn).
void ConservativeRemap::AddPolygon(const Polygon& polygon, Sum& sum) const
{
  const glm::dvec2 size(this->Width, this->Height);
  std::array<glm::dvec2, 4> points = polygon.Points;
  glm::dvec2 low = size;
  glm::dvec2 high(0.0);
  for (glm::dvec2& point : points)
  {
    point = glm::clamp(point, glm::dvec2(0.0), size);
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const int x0 = std::min(static_cast<int>(low.x), this->Width - 1);
  const int x1 = std::min(static_cast<int>(high.x), this->Width - 1);
  const int y0 = std::min(static_cast<int>(low.y), this->Height - 1);
  const int y1 = std::min(static_cast<int>(high.y), this->Height - 1);
  const std::size_t count = static_cast<std::size_t>(x1 - x0) + 3;
  std::array<double, 16> few;
  std::vector<double> many(count > few.size() ? count : 0);
  double* differences = many.empty() ? few.data() : many.data();
  for (int y = y0; y <= y1; ++y)
  {
    std::fill_n(differences, count, 0.0);
    for (std::size_t k = 0; k < 4; ++k)
    {
      glm::dvec2 p = points[k];
      glm::dvec2 q = points[(k + 1) % 4];
      const double sign = p.y < q.y ? 1.0 : -1.0;
      if (p.y > q.y)
      {
        std::swap(p, q);
      }
      const double bottom = std::max(p.y, static_cast<double>(y));
      const double top = std::min(q.y, y + 1.0);
      if (bottom < top)
      {
        const double slope = (q.x - p.x) / (q.y - p.y);
        const double a = std::clamp(p.x + slope * (bottom - p.y), low.x, high.x) - x0;
        const double b = std::clamp(p.x + slope * (top - p.y), low.x, high.x) - x0;
        AddSide(std::min(a, b), std::max(a, b), sign * (top - bottom), differences);
      }
    }
    double covered = 0.0;
    const double middle = 0.5 * (std::max<double>(y, low.y) + std::min(y + 1.0, high.y));
    for (int x = x0; x <= x1; ++x)
    {
      covered += differences[x - x0];
      if (std::abs(covered) > LeastArea)
      {
        const glm::dvec2 at(0.5 * (std::max<double>(x, low.x) + std::min(x + 1.0, high.x)), middle);
        this->AddTexel(x, y,
          std::abs(covered) / (size.x * size.y) * GetDensity(this->Projection, at / size), sum);
      }
    }
  }
}

//------------------------------------------------------------------------------
void ConservativeRemap::AddTexel(int x, int y, double solidAngle, Sum& sum) const
{
  const float* rgb = this->Pixels + 3 * (static_cast<std::size_t>(y) * this->Width + x);
  sum.SolidAngle += solidAngle;
  sum.Radiance += solidAngle * glm::dvec3(rgb[0], rgb[1], rgb[2]);
}
} // namespace measuredbrdf
