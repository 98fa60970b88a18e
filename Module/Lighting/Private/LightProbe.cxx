// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightProbe.h"

#include "HalfVector.h" // for Pi
#include "ParallelFor.h"
#include "vtkEnvironment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
struct ProjectionText
{
  const char* Name;
  const char* Size;
};
constexpr ProjectionText ProjectionTexts[] = {
  { "lat-long", "any size" },
  { "angular map", "as many columns as rows" },
  { "mirror ball", "as many columns as rows" },
  { "horizontal cross", "4 square faces wide, 3 high" },
  { "vertical cross", "3 square faces wide, 4 high" },
  { "horizontal strip", "6 square faces wide, 1 high" },
  { "vertical strip", "1 square face wide, 6 high" },
};

// How the faces of a cube lie in an image; columns and rows in faces, from the upper left.
struct CubeLayout
{
  int Columns;
  int Rows;
  glm::ivec2 Cells[6]; // of +x -x +y -y +z -z
  bool TurnedBack;     // -z is upside down
};

// Null for projections that are not cubes.
const CubeLayout* GetCubeLayout(Projection projection)
{
  static const CubeLayout layouts[] = {
    { 4, 3, { { 2, 1 }, { 0, 1 }, { 1, 0 }, { 1, 2 }, { 1, 1 }, { 3, 1 } }, false },
    { 3, 4, { { 2, 1 }, { 0, 1 }, { 1, 0 }, { 1, 2 }, { 1, 1 }, { 1, 3 } }, true },
    { 6, 1, { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 4, 0 }, { 5, 0 } }, false },
    { 1, 6, { { 0, 0 }, { 0, 1 }, { 0, 2 }, { 0, 3 }, { 0, 4 }, { 0, 5 } }, false }
  };
  return projection >= Projection::HorizontalCross
           ? &layouts[static_cast<int>(projection) - static_cast<int>(Projection::HorizontalCross)]
           : nullptr;
}

bool IsDisc(Projection projection)
{
  return projection == Projection::AngularMap || projection == Projection::MirrorBall;
}

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

// Outlines are carried over as straight lines: from cells no larger than this (radius, in
// radians)...
constexpr double LargestRadius = 0.04;
// ... whose center is carried no farther from the corners' mean than this part of the outline's
// breadth (area over longer diagonal), or of a texel. Seams, poles, rims and edges of cubes fail
// that: there, texels are quartered this often, down to points.
constexpr double Straightness = 0.05;
constexpr int Quarterings = 5;
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

// A stretch of columns or rows of a lat-long image: where it lies in [0,1], and cosine and sine of
// its azimuths or latitudes at its low side, middle and high side, both sides drawn in.
struct Stretch
{
  Stretch(double low, double high, double range)
    : Low(low)
    , High(high)
  {
    const double places[3] = { Inset, 0.5, 1.0 - Inset };
    for (int k = 0; k < 3; ++k)
    {
      const double angle = range * (low + places[k] * (high - low) - 0.5);
      this->Angles[k] = glm::dvec2(std::cos(angle), std::sin(angle));
    }
  }

  double Low;
  double High;
  glm::dvec2 Angles[3];
};

std::vector<Stretch> SplitEvenly(int count, double range)
{
  std::vector<Stretch> result;
  for (int k = 0; k < count; ++k)
  {
    result.emplace_back(static_cast<double>(k) / count, (k + 1.0) / count, range);
  }
  return result;
}

// Means of a probe over the texels of a lat-long image.
class ConservativeRemap
{
public:
  ConservativeRemap(
    Projection projection, int width, int height, const std::vector<float>& rgb, int rows)
    : Source(projection)
    , Width(width)
    , Height(height)
    , Pixels(rgb.data())
    , Columns(SplitEvenly(2 * rows, 2.0 * Pi))
    , Rows(SplitEvenly(rows, Pi))
  {
  }

  // Thread safe.
  glm::dvec3 GetMean(std::size_t x, std::size_t y) const
  {
    Sum sum;
    this->AddCell(this->Columns[x], this->Rows[y], Quarterings, sum);
    return sum.SolidAngle > 0.0 ? sum.Radiance / sum.SolidAngle : glm::dvec3(0.0);
  }

private:
  using Outline = std::array<glm::dvec2, 4>; // in texels of the probe

  // The solid angle that has been covered so far, and the integral of radiance over it.
  struct Sum
  {
    double SolidAngle = 0.0;
    glm::dvec3 Radiance = glm::dvec3(0.0);
  };

  static glm::dvec3 GetDirection(const glm::dvec2& azimuth, const glm::dvec2& latitude)
  {
    return { latitude.x * azimuth.x, latitude.y, latitude.x * azimuth.y };
  }

  glm::dvec2 MapToTexels(const glm::dvec3& direction) const
  {
    return MapToImage(this->Source, direction) *
           glm::dvec2(static_cast<double>(this->Width), this->Height);
  }

  void AddCell(const Stretch& columns, const Stretch& rows, int depth, Sum& sum) const
  {
    Outline outline;
    bool small = true;
    if (this->MapOutline(columns, rows, outline, small))
    {
      this->AddOutline(outline, sum);
      return;
    }
    if (depth <= 0 && small)
    {
      const glm::dvec2 at = this->MapToTexels(GetDirection(columns.Angles[1], rows.Angles[1]));
      const double solidAngle =
        2.0 * Pi * Pi * (columns.High - columns.Low) * (rows.High - rows.Low) * rows.Angles[1].x;
      this->AddTexel(std::clamp(static_cast<int>(at.x), 0, this->Width - 1),
        std::clamp(static_cast<int>(at.y), 0, this->Height - 1), solidAngle, sum);
      return;
    }
    const double middle = 0.5 * (columns.Low + columns.High);
    const double center = 0.5 * (rows.Low + rows.High);
    for (const Stretch& row : { Stretch(rows.Low, center, Pi), Stretch(center, rows.High, Pi) })
    {
      this->AddCell(Stretch(columns.Low, middle, 2.0 * Pi), row, depth - 1, sum);
      this->AddCell(Stretch(middle, columns.High, 2.0 * Pi), row, depth - 1, sum);
    }
  }

  // The cell's outline in the probe; false where straight lines between its corners will not do,
  // with `small` false where that is for its size.
  bool MapOutline(const Stretch& columns, const Stretch& rows, Outline& points, bool& small) const
  {
    const glm::dvec3 middle = GetDirection(columns.Angles[1], rows.Angles[1]);
    glm::dvec2 mean(0.0);
    for (std::size_t k = 0; k < 4; ++k)
    {
      const glm::dvec3 direction =
        GetDirection(columns.Angles[k == 1 || k == 2 ? 2 : 0], rows.Angles[k < 2 ? 0 : 2]);
      small = small && glm::distance(direction, middle) <= LargestRadius;
      points[k] = this->MapToTexels(direction);
      mean += 0.25 * points[k];
    }
    if (!small)
    {
      return false;
    }
    const glm::dvec2 a = points[2] - points[0];
    const glm::dvec2 b = points[3] - points[1];
    const double area = 0.5 * std::abs(a.x * b.y - a.y * b.x);
    const double diagonal = std::max(glm::length(a), glm::length(b));
    const double off = glm::distance(this->MapToTexels(middle), mean);
    return off * diagonal <= Straightness * std::max(area, diagonal);
  }

  // Row by row, each side adds what lies to the right of it, with its direction's sign, to
  // differences along the row; their running sum is the area in each texel (as fonts are drawn).
  void AddOutline(Outline points, Sum& sum) const
  {
    const glm::dvec2 size(this->Width, this->Height);
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
          const glm::dvec2 at(
            0.5 * (std::max<double>(x, low.x) + std::min(x + 1.0, high.x)), middle);
          this->AddTexel(x, y,
            std::abs(covered) / (size.x * size.y) * GetSolidAngleDensity(this->Source, at / size),
            sum);
        }
      }
    }
  }

  void AddTexel(int x, int y, double solidAngle, Sum& sum) const
  {
    const float* rgb = this->Pixels + 3 * (static_cast<std::size_t>(y) * this->Width + x);
    sum.SolidAngle += solidAngle;
    sum.Radiance += solidAngle * glm::dvec3(rgb[0], rgb[1], rgb[2]);
  }

  Projection Source;
  int Width;
  int Height;
  const float* Pixels;
  std::vector<Stretch> Columns;
  std::vector<Stretch> Rows;
};

// The center of the nearest texel whose center the disc holds lies in that of the returned point.
glm::dvec2 DrawIn(const glm::dvec2& uv, int size)
{
  const glm::dvec2 p = 2.0 * uv - 1.0;
  const double r = glm::length(p);
  const double limit = std::max(1.0 - std::sqrt(2.0) / size, 0.0); // half a texel's diagonal
  return r > limit ? 0.5 + 0.5 * limit / r * p : uv;
}

// use(texel, center) for all texels that show no direction at their center.
template <typename Use>
void ForHidden(Projection projection, int width, int height, const Use& use)
{
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const glm::dvec2 center((x + 0.5) / width, (y + 0.5) / height);
      glm::dvec3 ignored;
      if (!MapToDirection(projection, center, ignored))
      {
        use(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
              static_cast<std::size_t>(x),
          center);
      }
    }
  }
}

int GetRows(Projection projection, int width, int height)
{
  double texels = static_cast<double>(width) * height;
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    texels *= 6.0 / (layout->Columns * layout->Rows);
  }
  else
  {
    texels *= 0.25 * Pi;
  }
  return std::max(1, static_cast<int>(std::lround(std::sqrt(0.5 * texels))));
}
}

//------------------------------------------------------------------------------
std::string GetProjectionName(Projection projection)
{
  return ProjectionTexts[static_cast<int>(projection)].Name;
}

//------------------------------------------------------------------------------
std::string GetExpectedSize(Projection projection)
{
  return ProjectionTexts[static_cast<int>(projection)].Size;
}

//------------------------------------------------------------------------------
bool FitsProjection(Projection projection, int width, int height)
{
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    return width % layout->Columns == 0 && height % layout->Rows == 0 &&
           width / layout->Columns == height / layout->Rows;
  }
  return projection == Projection::LatLong || width == height;
}

//------------------------------------------------------------------------------
bool MapToDirection(Projection projection, const glm::dvec2& uv, glm::dvec3& direction)
{
  direction = glm::dvec3(0.0);
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    double a;
    double b;
    const int face = FindFace(*layout, uv, a, b);
    direction = face < 0 ? direction : glm::normalize(GetFacePoint(face, a, b));
    return face >= 0;
  }
  const glm::dvec2 p = 2.0 * uv - 1.0;
  const double square = glm::dot(p, p);
  if (square > 1.0)
  {
    return false;
  }
  if (projection == Projection::MirrorBall)
  {
    // The line of sight mirrored at the normal (X, Y, sqrt(1 - r^2)).
    direction = glm::dvec3(2.0 * std::sqrt(1.0 - square) * p, 1.0 - 2.0 * square);
    return true;
  }
  const double r = std::sqrt(square);
  const double scale = r > 0.0 ? std::sin(Pi * r) / r : Pi;
  direction = glm::dvec3(scale * p, -std::cos(Pi * r));
  return true;
}

//------------------------------------------------------------------------------
glm::dvec2 MapToImage(Projection projection, const glm::dvec3& direction)
{
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    double a;
    double b;
    const int face = GetFace(direction, a, b);
    const double sign = face == 5 && layout->TurnedBack ? -0.5 : 0.5;
    return { (layout->Cells[face].x + 0.5 + sign * a) / layout->Columns,
      1.0 - (layout->Cells[face].y + 0.5 + sign * b) / layout->Rows };
  }
  const double side = std::hypot(direction.x, direction.y);
  const bool ball = projection == Projection::MirrorBall;
  const double angle = std::atan2(side, ball ? direction.z : -direction.z);
  const double r = ball ? std::sin(0.5 * angle) : angle / Pi;
  const glm::dvec2 towards =
    side > 0.0 ? glm::dvec2(direction.x, direction.y) / side : glm::dvec2(1.0, 0.0);
  return 0.5 + 0.5 * r * towards;
}

//------------------------------------------------------------------------------
double GetSolidAngleDensity(Projection projection, const glm::dvec2& uv)
{
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
  if (projection == Projection::MirrorBall)
  {
    return 16.0;
  }
  const double r = glm::length(2.0 * uv - 1.0);
  return 4.0 * Pi * (r > 0.0 ? std::abs(std::sin(Pi * r)) / r : Pi);
}

//------------------------------------------------------------------------------
std::optional<BadValues> ConvertProbe(Projection projection, int width, int height,
  std::vector<float> rgb, vtkEnvironment* output, int rows)
{
  const std::int64_t texels = std::int64_t(width) * height;
  if (texels < 1 || texels > MaximumProbeTexels ||
      rgb.size() != 3 * static_cast<std::size_t>(texels))
  {
    return std::nullopt;
  }
  // What shows no direction counts as nothing. Texels on a disc's rim show some though their
  // centers lie outside: they take a neighbor's value.
  ForHidden(projection, width, height,
    [&](std::size_t texel, const glm::dvec2&) { std::fill_n(&rgb[3 * texel], 3, 0.0f); });
  const BadValues bad = CleanRadiance(rgb);
  if (IsDisc(projection))
  {
    ForHidden(projection, width, height,
      [&](std::size_t texel, const glm::dvec2& center)
      {
        const glm::dvec2 uv = DrawIn(center, width);
        const std::size_t from =
          static_cast<std::size_t>(uv.y * height) * width + static_cast<std::size_t>(uv.x * width);
        std::copy_n(&rgb[3 * from], 3, &rgb[3 * texel]);
      });
  }
  rows = rows > 0 ? rows : GetRows(projection, width, height);
  const ConservativeRemap remap(projection, width, height, rgb, rows);
  std::vector<float> result(6 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(rows));
  ParallelFor(0, static_cast<vtkIdType>(result.size() / 3),
    [&](vtkIdType begin, vtkIdType end)
    {
      const auto columns = static_cast<std::size_t>(2 * rows);
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      {
        const glm::vec3 mean(remap.GetMean(k % columns, k / columns));
        std::copy_n(&mean.x, 3, &result[3 * k]);
      }
    });
  return output->SetPixels(2 * rows, rows, std::move(result)) ? std::optional<BadValues>(bad)
                                                              : std::nullopt;
}

//------------------------------------------------------------------------------
std::optional<BadValues> ConvertCubeFaces(
  int size, const std::vector<std::vector<float>>& faces, vtkEnvironment* output, int rows)
{
  const std::int64_t texels = std::int64_t(size) * size;
  const auto fits = [texels](const std::vector<float>& face)
  { return face.size() == 3 * static_cast<std::size_t>(texels); };
  if (faces.size() != 6 || texels > MaximumProbeTexels / 6 ||
      !std::all_of(faces.begin(), faces.end(), fits))
  {
    return std::nullopt;
  }
  // A vertical strip: +x at the top, -z in the first rows.
  std::vector<float> strip;
  strip.reserve(6 * faces[0].size());
  for (auto face = faces.rbegin(); face != faces.rend(); ++face)
  {
    strip.insert(strip.end(), face->begin(), face->end());
  }
  return ConvertProbe(Projection::VerticalStrip, size, 6 * size, std::move(strip), output, rows);
}
} // namespace measuredbrdf
