// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sky in squares of 2 x 2, 4 x 4, ... texels of an environment and in parts of texels, for
 * integrals that look closely only where they have to.
 */

#ifndef TexelTree_h
#define TexelTree_h

#include "vtkEnvironment.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// Directions of the middles of a lat-long image's texels, or of a grid of other squares, from one
/// sine and cosine per column and per row.
struct TexelDirections
{
  TexelDirections(int width, int height)
    : TexelDirections(width, height, width, height)
  {
  }

  /// Squares, so many, of which an image has acrossImage and upImage; those that the image's edge
  /// cuts off have their middle on the image.
  TexelDirections(int width, int height, double acrossImage, double upImage)
  {
    glm::dvec3 d;
    for (int x = 0; x < width; ++x)
    {
      vtkEnvironment::GetDirection(std::min((x + 0.5) / acrossImage, 1.0), 0.5, &d.x);
      this->Columns.emplace_back(d.x, d.z);
    }
    for (int y = 0; y < height; ++y)
    {
      vtkEnvironment::GetDirection(0.5, std::min((y + 0.5) / upImage, 1.0), &d.x);
      this->Rows.emplace_back(d.x, d.y);
    }
  }

  glm::dvec3 Get(int x, int y) const
  {
    const glm::dvec2& column = this->Columns[x];
    const glm::dvec2& row = this->Rows[y];
    return glm::dvec3(row.x * column.x, row.y, row.x * column.y);
  }

  std::vector<glm::dvec2> Columns; // cosine, sine of the azimuth
  std::vector<glm::dvec2> Rows;    // cosine, sine of the latitude
};

class TexelTree
{
public:
  /// What a square sends.
  struct Light
  {
    glm::dvec3 Irradiance; // on a surface that faces it: the sum of radiance times solid angle
    glm::dvec3 Direction;  // unit: the mean, weighted by luminance
    /// Summing over the four squares of half the size instead of this one leaves this much of what
    /// it changes to do, for an integrand of second order: the share of the variance of directions
    /// that remains in them. A third where radiance is constant, and of squares of level 0 and
    /// less.
    double Rest;
  };

  /// From an environment that is not empty; the caller has asked it for GetSubdivided.
  explicit TexelTree(vtkEnvironment* environment);

  ///@{
  /// Squares of level 0 are texels; on each level up, width and height are half as large (rounded
  /// up). Those of negative levels are parts of texels, 2 x 2, 4 x 4, ..., down to 0.01 degrees.
  int GetHighestLevel() const { return this->Lowest + static_cast<int>(this->Levels.size()) - 1; }
  int GetLowestLevel() const { return this->Lowest; }
  int GetWidth(int level) const { return this->At(level).Width; }
  int GetHeight(int level) const { return this->At(level).Height; }
  ///@}

  /// Half the diagonal of a square at the equator, in rad: an upper bound.
  double GetLargestRadius(int level) const { return this->At(level).Scale * this->Radius; }

  /// A square's middle, of its area and not of its light, and half its diagonal.
  glm::dvec3 GetMiddle(int level, int x, int y, double& radius) const;

  /// In the environment's frame. Black outside the map.
  Light Get(int level, int x, int y) const;

  /// Directions and irradiances of a square's quarters, left to right, then down: x, y and z, red,
  /// green and blue, of four each. Of a level above the lowest one.
  void GetQuarters(
    int level, int x, int y, float* const directions[3], float* const irradiances[3]) const;

  /// Light::Rest.
  float GetRest(int level, int x, int y) const
  {
    return level > 0 ? this->GetBlock(level, x, y).Rests[2 * (y % 2) + x % 2] : SmoothRest;
  }

  static constexpr float SmoothRest = 1.0f / 3.0f; // of constant radiance

private:
  /// Two by two squares, left to right, then down, in two lines of a processor's cache: what
  /// adaptive sums ask for at a time. Single precision is enough for what only says where to look.
  /// Squares beyond the map's edge are black.
  struct alignas(64) Block
  {
    float Directions[3][4] = { {}, { 1.0f, 1.0f, 1.0f, 1.0f }, {} };
    float Irradiances[3][4] = {};
    float Rests[4] = {};
  };
  struct Level
  {
    int Width;
    int Height;
    double Scale;              // 2 to the level
    TexelDirections Middles;   // of the squares
    double StripArea;          // solid angle of a square on the equator
    std::vector<Block> Blocks; // of levels above 0
  };

  void AddLevel(int level);
  void AverageTexels();
  void SumQuarters(Level& level, std::vector<glm::dvec4>& moments);
  const Level& At(int level) const { return this->Levels[level - this->Lowest]; }
  const Block& GetBlock(int level, int x, int y) const
  {
    const Level& at = this->At(level);
    return at.Blocks[static_cast<std::size_t>(y / 2) * ((at.Width + 1) / 2) + x / 2];
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  std::vector<glm::vec3> Texels; // the mean radiance of each one's area
  int Lowest = 0;
  std::vector<Level> Levels; // the lowest first
  double Radius = 0.0;       // of a texel on the equator
};
} // namespace measuredbrdf

#endif
