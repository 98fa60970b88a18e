// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightProbe.h"

#include "HalfVector.h" // for Pi
#include "ParallelFor.h"
#include "TexelTree.h"
#include "vtkEnvironment.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Names, and the sizes that images have.
constexpr const char* ProjectionTexts[][2] = { { "lat-long", "any size" },
  { "angular map", "as many columns as rows" }, { "mirror ball", "as many columns as rows" },
  { "horizontal cross", "4 square faces wide, 3 high" },
  { "vertical cross", "3 square faces wide, 4 high" },
  { "horizontal strip", "6 square faces wide, 1 high" },
  { "vertical strip", "1 square face wide, 6 high" } };

// How the faces of a cube lie in an image; columns and rows in faces, from the upper left.
struct CubeLayout
{
  glm::ivec2 Size;
  glm::ivec2 Cells[6]; // of +x -x +y -y +z -z
  bool TurnedBack;     // -z is upside down

  double GetSign(int face) const { return face == 5 && this->TurnedBack ? -1.0 : 1.0; }
};

// Null for projections that are not cubes.
const CubeLayout* GetCubeLayout(Projection projection)
{
  static const CubeLayout layouts[] = {
    { { 4, 3 }, { { 2, 1 }, { 0, 1 }, { 1, 0 }, { 1, 2 }, { 1, 1 }, { 3, 1 } }, false },
    { { 3, 4 }, { { 2, 1 }, { 0, 1 }, { 1, 0 }, { 1, 2 }, { 1, 1 }, { 1, 3 } }, true },
    { { 6, 1 }, { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 4, 0 }, { 5, 0 } }, false },
    { { 1, 6 }, { { 0, 0 }, { 0, 1 }, { 0, 2 }, { 0, 3 }, { 0, 4 }, { 0, 5 } }, false }
  };
  return projection >= Projection::HorizontalCross
           ? &layouts[static_cast<int>(projection) - static_cast<int>(Projection::HorizontalCross)]
           : nullptr;
}

bool IsDisc(Projection projection)
{
  return projection == Projection::AngularMap || projection == Projection::MirrorBall;
}

// An upright face: its middle, and where its a (to the right) and b (down) in [-1,1] lead. OpenGL
// 3.2, table 3.19, with its z turned round.
struct CubeFace
{
  glm::dvec3 Middle, Right, Down;
};
const CubeFace CubeFaces[6] = {
  { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } },
  { { -1, 0, 0 }, { 0, 0, -1 }, { 0, -1, 0 } },
  { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } },
  { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } },
  { { 0, 0, -1 }, { 1, 0, 0 }, { 0, -1, 0 } },
  { { 0, 0, 1 }, { -1, 0, 0 }, { 0, -1, 0 } },
};

// The face that a direction hits, and where.
int GetFace(const glm::dvec3& d, glm::dvec2& at)
{
  const glm::dvec3 m = glm::abs(d);
  const int face = m.x >= m.y && m.x >= m.z ? (d.x > 0.0 ? 0 : 1)
                   : m.y >= m.z             ? (d.y > 0.0 ? 2 : 3)
                                            : (d.z < 0.0 ? 4 : 5);
  at = glm::dvec2(glm::dot(d, CubeFaces[face].Right), glm::dot(d, CubeFaces[face].Down)) /
       glm::dot(d, CubeFaces[face].Middle);
  return face;
}

// The face that shows at (u,v), and where; -1 beside the faces.
int FindFace(const CubeLayout& layout, const glm::dvec2& uv, glm::dvec2& at)
{
  const glm::dvec2 place = glm::dvec2(uv.x, 1.0 - uv.y) * glm::dvec2(layout.Size);
  const glm::ivec2 cell = glm::clamp(glm::ivec2(place), glm::ivec2(0), layout.Size - 1);
  const auto* found = std::find(std::begin(layout.Cells), std::end(layout.Cells), cell);
  const int face = static_cast<int>(found - layout.Cells);
  at = layout.GetSign(face) * (2.0 * (place - glm::dvec2(cell)) - 1.0);
  return face < 6 ? face : -1;
}

// Points a side at which a texel of the environment is looked up in the probe, and a texel of the
// probe for its solid angle.
constexpr int PartsOfTexel = 8;
constexpr int PartsOfLargeMap = 4;
constexpr int PartsOfProbe = 4;
constexpr int LargeProbe = 1 << 18; // texels, of which each is one point
constexpr int LargeMap = 1 << 20;

/// A probe's image.
class Probe
{
public:
  Probe(Projection projection, int width, int height, const std::vector<float>& rgb)
    : Source(projection)
    , Size(width, height)
    , Pixels(rgb)
  {
  }

  /// The nearest texel's radiance. Of discs, only texels whose center the disc holds count.
  glm::dvec3 Look(glm::dvec2 uv) const
  {
    if (IsDisc(this->Source))
    {
      const glm::dvec2 p = 2.0 * uv - 1.0;
      const double r = glm::length(p);
      const double limit = std::max(1.0 - std::sqrt(2.0) / this->Size.x, 0.0); // half a diagonal
      uv = r > limit ? 0.5 + 0.5 * limit / r * p : uv;
    }
    const glm::ivec2 at =
      glm::clamp(glm::ivec2(uv * glm::dvec2(this->Size)), glm::ivec2(0), this->Size - 1);
    return glm::make_vec3(
      &this->Pixels[3 * (static_cast<std::size_t>(at.y) * this->Size.x + at.x)]);
  }

  /// The mean over texel (x, y) of an environment, from points whose directions are given, so many
  /// a side.
  glm::dvec3 GetMean(int x, int y, const TexelDirections& points, int parts) const
  {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (int k = 0; k < parts * parts; ++k)
    {
      const int row = y * parts + k / parts;
      const double weight = points.Rows[row].x; // the latitude's cosine
      sum += weight * this->Look(MapToImage(this->Source, points.Get(x * parts + k % parts, row)));
      weights += weight;
    }
    return sum / weights;
  }

  /// The mean over the sphere.
  glm::dvec3 GetMean() const
  {
    glm::dvec4 sum(0.0);
    const glm::ivec2 points =
      (this->Size.x > LargeProbe / this->Size.y ? 1 : PartsOfProbe) * this->Size;
    for (int y = 0; y < points.y; ++y)
    {
      for (int x = 0; x < points.x; ++x)
      {
        const glm::dvec2 uv = (glm::dvec2(x, y) + 0.5) / glm::dvec2(points);
        glm::dvec3 ignored;
        if (MapToDirection(this->Source, uv, ignored))
        {
          sum += GetSolidAngleDensity(this->Source, uv) * glm::dvec4(this->Look(uv), 1.0);
        }
      }
    }
    return glm::dvec3(sum) / sum.w;
  }

private:
  Projection Source;
  glm::ivec2 Size;
  const std::vector<float>& Pixels;
};

int GetRows(Projection projection, int width, int height)
{
  const CubeLayout* layout = GetCubeLayout(projection);
  const double shown = layout ? 6.0 / (layout->Size.x * layout->Size.y) : 0.25 * Pi;
  const double texels = shown * width * height;
  return std::max(1, static_cast<int>(std::lround(std::sqrt(0.5 * texels))));
}
}

//------------------------------------------------------------------------------
std::string GetProjectionName(Projection projection)
{
  return ProjectionTexts[static_cast<int>(projection)][0];
}

//------------------------------------------------------------------------------
std::string GetExpectedSize(Projection projection)
{
  return ProjectionTexts[static_cast<int>(projection)][1];
}

//------------------------------------------------------------------------------
bool FitsProjection(Projection projection, int width, int height)
{
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    const glm::ivec2 face = glm::ivec2(width, height) / layout->Size;
    return face * layout->Size == glm::ivec2(width, height) && face.x == face.y;
  }
  return projection == Projection::LatLong || width == height;
}

//------------------------------------------------------------------------------
bool MapToDirection(Projection projection, const glm::dvec2& uv, glm::dvec3& direction)
{
  direction = glm::dvec3(0.0);
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    glm::dvec2 at;
    const int face = FindFace(*layout, uv, at);
    if (face >= 0)
    {
      direction = glm::normalize(
        CubeFaces[face].Middle + at.x * CubeFaces[face].Right + at.y * CubeFaces[face].Down);
    }
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
    glm::dvec2 at;
    const int face = GetFace(direction, at);
    const glm::dvec2 place =
      (glm::dvec2(layout->Cells[face]) + 0.5 + 0.5 * layout->GetSign(face) * at) /
      glm::dvec2(layout->Size);
    return { place.x, 1.0 - place.y };
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
    glm::dvec2 at;
    const bool isBeside = FindFace(*layout, uv, at) < 0;
    const double areas = 4.0 * layout->Size.x * layout->Size.y;
    return isBeside ? 0.0 : areas / std::pow(1.0 + glm::dot(at, at), 1.5);
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
  for (int k = 0; k < width * height; ++k) // what shows no direction counts as nothing
  {
    const glm::dvec2 center((k % width + 0.5) / width, (k / width + 0.5) / height);
    glm::dvec3 ignored;
    if (!MapToDirection(projection, center, ignored))
    {
      std::fill_n(&rgb[3 * static_cast<std::size_t>(k)], 3, 0.0f);
    }
  }
  const BadValues bad = CleanRadiance(rgb);
  const Probe probe(projection, width, height, rgb);
  rows = rows > 0 ? rows : GetRows(projection, width, height);
  const int columns = 2 * rows;
  const int parts = columns > LargeMap / rows ? PartsOfLargeMap : PartsOfTexel;
  const TexelDirections points(columns * parts, rows * parts);
  std::vector<glm::dvec3> means(static_cast<std::size_t>(columns) * rows);
  ParallelForEach(
    means.size(),
    [&](std::size_t k)
    {
      const auto texel = static_cast<int>(k);
      means[k] = probe.GetMean(texel % columns, texel / columns, points, parts);
    },
    nullptr, 0);
  // Points are taken or left by texels as wholes: no light is lost or gained over all.
  glm::dvec4 shown(0.0);
  for (std::size_t k = 0; k < means.size(); ++k)
  {
    shown +=
      std::sin(Pi * (static_cast<double>(k / columns) + 0.5) / rows) * glm::dvec4(means[k], 1.0);
  }
  const glm::dvec3 gain = probe.GetMean() / glm::max(glm::dvec3(shown) / shown.w,
                                              glm::dvec3(std::numeric_limits<double>::min()));
  std::vector<float> result;
  for (const glm::dvec3& mean : means)
  {
    const glm::vec3 value(gain * mean);
    result.insert(result.end(), &value.x, &value.x + 3);
  }
  return output->SetPixels(columns, rows, std::move(result)) ? std::optional<BadValues>(bad)
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
