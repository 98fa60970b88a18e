// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ConservativeRemap.h"

#include "HalfVector.h" // for Pi
#include "ProjectionMaps.h"
#include "vtkEnvironmentProjection.h"

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
// ... whose centre is carried no farther from the corners' mean than this part of the outline's
// breadth (area over longer diagonal), or of a texel. Seams, poles, rims and edges of cubes fail
// that: there, texels are quartered this often, down to points.
constexpr double Straightness = 0.05;
constexpr int Depth = 5;
// Corners are drawn in by this part of their cell, so that those on a seam fall on the cell's side.
constexpr double Inset = 1e-7;
}

//------------------------------------------------------------------------------
// In texels of the source; convex but for the last digits.
struct ConservativeRemap::Polygon
{
  std::array<glm::dvec2, 20> Points; // a quadrilateral cut by four lines: 8, were it not convex 19
  int Size = 0;

  void Add(const glm::dvec2& point)
  {
    this->Points[static_cast<std::size_t>(this->Size++)] = point;
  }
  const glm::dvec2& At(int k) const { return this->Points[static_cast<std::size_t>(k)]; }

  // The part where sign * (coordinate - bound) >= 0 (Sutherland and Hodgman 1974).
  Polygon Clip(int axis, double bound, double sign) const
  {
    Polygon result;
    for (int k = 0; k < this->Size; ++k)
    {
      const glm::dvec2& p = this->At(k);
      const glm::dvec2& q = this->At((k + 1) % this->Size);
      const double fromP = sign * (p[axis] - bound);
      const double fromQ = sign * (q[axis] - bound);
      if (fromP >= 0.0)
      {
        result.Add(p);
      }
      if ((fromP >= 0.0) != (fromQ >= 0.0))
      {
        result.Add(p + fromP / (fromP - fromQ) * (q - p));
      }
    }
    return result;
  }

  double GetArea(glm::dvec2& centroid) const
  {
    double area = 0.0;
    glm::dvec2 moment(0.0);
    for (int k = 1; k + 1 < this->Size; ++k)
    {
      const glm::dvec2 a = this->At(k) - this->At(0);
      const glm::dvec2 b = this->At(k + 1) - this->At(0);
      const double part = 0.5 * (a.x * b.y - a.y * b.x);
      area += part;
      moment += part / 3.0 * (a + b);
    }
    centroid = area != 0.0 ? this->At(0) + moment / area : this->At(0);
    return std::abs(area);
  }

  void GetBounds(glm::dvec2& low, glm::dvec2& high) const
  {
    low = high = this->At(0);
    for (int k = 1; k < this->Size; ++k)
    {
      low = glm::min(low, this->At(k));
      high = glm::max(high, this->At(k));
    }
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

  glm::dvec2 GetCentre() const { return 0.5 * (this->Low + this->High); }
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
  if (target.Projection == vtkEnvironmentProjection::LAT_LONG)
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
  const glm::dvec2 centre = cell.GetCentre();
  if (depth <= 0 && small)
  {
    glm::dvec3 direction;
    if (MapToDirection(this->Target.Projection, centre, direction))
    {
      const glm::dvec2 at = MapToImage(this->Projection, direction) *
                            glm::dvec2(static_cast<double>(this->Width), this->Height);
      const int x = std::clamp(static_cast<int>(at.x), 0, this->Width - 1);
      const int y = std::clamp(static_cast<int>(at.y), 0, this->Height - 1);
      const glm::dvec2 size = cell.High - cell.Low;
      this->AddTexel(x, y, size.x * size.y * GetDensity(this->Target.Projection, centre), sum);
    }
    return;
  }
  const int next = depth - 1;
  this->AddCell({ cell.Low, centre }, next, sum);
  this->AddCell({ { centre.x, cell.Low.y }, { cell.High.x, centre.y } }, next, sum);
  this->AddCell({ { cell.Low.x, centre.y }, { centre.x, cell.High.y } }, next, sum);
  this->AddCell({ centre, cell.High }, next, sum);
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
  const glm::dvec3 centre = direction;
  glm::dvec2 mean(0.0);
  for (const glm::ivec2& corner :
    { glm::ivec2(0, 0), glm::ivec2(2, 0), glm::ivec2(2, 2), glm::ivec2(0, 2) })
  {
    if (!this->GetDirection(cell, corner.x, corner.y, direction))
    {
      return false;
    }
    small = small && glm::distance(direction, centre) <= LargestRadius;
    outline.Add(MapToImage(this->Projection, direction) * size);
    mean += 0.25 * outline.At(outline.Size - 1);
  }
  if (!small)
  {
    return false;
  }
  glm::dvec2 ignored;
  const double area = outline.GetArea(ignored);
  const double diagonal = std::max(
    glm::distance(outline.At(0), outline.At(2)), glm::distance(outline.At(1), outline.At(3)));
  const double off = glm::distance(MapToImage(this->Projection, centre) * size, mean);
  return off * diagonal <= Straightness * std::max(area, diagonal);
}

//------------------------------------------------------------------------------
void ConservativeRemap::AddPolygon(const Polygon& polygon, Sum& sum) const
{
  const glm::dvec2 size(this->Width, this->Height);
  glm::dvec2 low;
  glm::dvec2 high;
  polygon.GetBounds(low, high);
  const int y0 = std::clamp(static_cast<int>(low.y), 0, this->Height - 1);
  const int y1 = std::clamp(static_cast<int>(high.y), 0, this->Height - 1);
  for (int y = y0; y <= y1; ++y)
  {
    Polygon row = y > y0 ? polygon.Clip(1, y, 1.0) : polygon;
    row = y < y1 ? row.Clip(1, y + 1.0, -1.0) : row;
    if (row.Size < 3)
    {
      continue;
    }
    row.GetBounds(low, high);
    const int x0 = std::clamp(static_cast<int>(low.x), 0, this->Width - 1);
    const int x1 = std::clamp(static_cast<int>(high.x), 0, this->Width - 1);
    for (int x = x0; x <= x1; ++x)
    {
      Polygon part = x > x0 ? row.Clip(0, x, 1.0) : row;
      part = x < x1 ? part.Clip(0, x + 1.0, -1.0) : part;
      if (part.Size >= 3)
      {
        glm::dvec2 centroid;
        const double area = part.GetArea(centroid) / (size.x * size.y);
        this->AddTexel(x, y, area * GetDensity(this->Projection, centroid / size), sum);
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
