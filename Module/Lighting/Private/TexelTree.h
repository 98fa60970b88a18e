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

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// Directions of all texels of a lat-long image from one sine and cosine per column and per row.
struct TexelDirections
{
  TexelDirections(int width, int height)
  {
    for (int x = 0; x < width; ++x)
    {
      glm::dvec3 d;
      vtkEnvironment::GetDirection((x + 0.5) / width, 0.5, &d.x);
      this->Columns.emplace_back(d.x, d.z);
    }
    for (int y = 0; y < height; ++y)
    {
      glm::dvec3 d;
      vtkEnvironment::GetDirection(0.5, (y + 0.5) / height, &d.x);
      this->Rows.emplace_back(d.x, d.y);
    }
  }

  glm::dvec3 Get(int x, int y) const
  {
    const glm::dvec2& column = this->Columns[static_cast<std::size_t>(x)];
    const glm::dvec2& row = this->Rows[static_cast<std::size_t>(y)];
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
    /// that remains in them. A third where radiance is constant.
    double Rest;
  };

  /// From an environment that is not empty; the caller has asked it for GetSubdivided.
  explicit TexelTree(vtkEnvironment* environment);

  ///@{
  /// Squares of level 0 are texels; on each level up, width and height are half as large (rounded
  /// up). Those of negative levels are parts of texels, 2 x 2, 4 x 4, ..., down to 0.01 degrees.
  int GetHighestLevel() const { return static_cast<int>(this->Levels.size()) - 1; }
  int GetLowestLevel() const { return 1 - static_cast<int>(this->Parts.size()); }
  int GetWidth(int level) const;
  int GetHeight(int level) const;
  ///@}

  /// Half the diagonal of a square at the equator, in rad: an upper bound.
  double GetLargestRadius(int level) const { return this->GetScale(level) * this->Radius; }

  /// A square's middle, of its area and not of its light, and half its diagonal.
  glm::dvec3 GetMiddle(int level, int x, int y, double& radius) const;

  /// In the environment's frame. Black outside the map.
  Light Get(int level, int x, int y) const;

  /// Directions and irradiances of a square's quarters, left to right, then down: x, y and z, red,
  /// green and blue, of four each. Of a level above the lowest one.
  void GetQuarters(
    int level, int x, int y, float* const directions[3], float* const irradiances[3]) const;

  /// Light::Rest of a square of a level above 0.
  float GetRest(int level, int x, int y) const
  {
    return this->Levels[static_cast<std::size_t>(level)]
      .Blocks[this->GetBlock(level, x, y)]
      .Rests[2 * (y % 2) + x % 2];
  }

  /// Asks the processor for what GetQuarters will read soon.
  void Prefetch(int level, int x, int y) const;

  /// Light::Rest of squares of level 0 and less.
  static constexpr double SmoothRest = 1.0 / 3.0; // of constant radiance

private:
  /// Two by two squares, left to right, then down, in two lines of a processor's cache: what
  /// adaptive sums ask for at a time. Single precision is enough for what only says where to look.
  /// Squares beyond the map's edge are black.
  struct alignas(64) Block
  {
    float Directions[3][4];
    float Irradiances[3][4];
    float Rests[4];
  };
  struct Level
  {
    int Width;
    int Height;
    std::vector<Block> Blocks; // none on level 0
  };

  void AverageTexels();
  /// That which holds a square of a level above 0.
  std::size_t GetBlock(int level, int x, int y) const
  {
    const auto width = static_cast<std::size_t>((this->GetWidth(level) + 1) / 2);
    return static_cast<std::size_t>(y / 2) * width + static_cast<std::size_t>(x / 2);
  }

  void AddLevel(std::vector<glm::dvec4>& moments);
  void AddMiddles();
  glm::dvec4 GetTexelMoment(const Light& light, int y) const;
  double GetSolidAngle(int level, int y) const;
  glm::dvec3 GetPartRadiance(int part, int x, int y) const;

  /// 2 to the level.
  double GetScale(int level) const
  {
    return this->Scales[static_cast<std::size_t>(level - this->GetLowestLevel())];
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  std::vector<glm::vec3> Texels;      // the mean radiance of each one's area
  std::vector<TexelDirections> Parts; // levels 0, -1, ...
  std::vector<TexelDirections> Above; // levels 1, 2, ...: the middles
  std::vector<double> StripAreas;     // solid angles on the equator, of levels 0, -1, ...
  std::vector<Level> Levels;
  std::vector<double> Scales; // of the levels, the lowest first
  double Radius = 0.0;        // of a texel on the equator
};
} // namespace measuredbrdf

#endif
