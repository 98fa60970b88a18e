// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPyramid.h"

#include "HalfVector.h" // for Pi
#include "Neighbors.h"
#include "TexelTree.h"
#include "vtkEnvironment.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Texels a side for the finest maps. 1024 would take more than 12 MB with a material's textures.
constexpr int MaximumSize = 768;

// Points a side at which an environment's texel is interpolated: at least so many per texel of the
// map that flat regions stay flat (each texel takes the mean of what falls into it).
int GetParts(vtkEnvironment* environment, int size)
{
  const double ratio =
    2.0 * size * size / (static_cast<double>(environment->GetWidth()) * environment->GetHeight());
  return std::clamp(static_cast<int>(std::ceil(2.0 * std::sqrt(ratio))), 1, 64);
}

// (u,v) in [0,1]^2 of a unit direction: glm::vec3 or glm::dvec3. The result is below 1.
template <typename Direction>
auto ToSquare(const Direction& d)
{
  using Number = typename Direction::value_type;
  const Number r = std::sqrt(std::max(1 - std::abs(d.z), Number(0)));
  Number v = r * std::atan2(std::abs(d.y), std::abs(d.x)) * static_cast<Number>(2.0 / Pi);
  Number u = r - v;
  if (d.z < 0)
  {
    std::swap(u, v);
    u = 1 - u;
    v = 1 - v;
  }
  const glm::vec<2, Number> uv(std::copysign(u, d.x), std::copysign(v, d.y));
  return glm::clamp((uv + Number(1)) / Number(2), Number(0), Number(0.999999));
}
}

glm::dvec3 EnvironmentPyramid::ToSphere(const glm::dvec2& uv)
{
  const double u = std::abs(2.0 * uv.x - 1.0);
  const double v = std::abs(2.0 * uv.y - 1.0);
  const double signedDistance = 1.0 - u - v;
  const double r = 1.0 - std::abs(signedDistance);
  const double phi = (r > 0.0 ? (v - u) / r + 1.0 : 1.0) * Pi / 4.0;
  const double z = std::copysign(1.0 - r * r, signedDistance);
  const double s = r * std::sqrt(std::max(2.0 - r * r, 0.0));
  return glm::dvec3(
    std::copysign(std::cos(phi) * s, uv.x - 0.5), std::copysign(std::sin(phi) * s, uv.y - 0.5), z);
}

EnvironmentPyramid::EnvironmentPyramid(
  vtkEnvironment* environment, const TexelChanges& changes, int size)
{
  environment = environment->GetSubdivided();
  this->Size = size > 0 ? size : ChooseSize(environment);
  int row = 0;
  for (int s = this->Size; s > 0; s /= 2)
  {
    this->Origins.push_back(s == this->Size ? glm::ivec2(0) : glm::ivec2(this->Size + 2, row));
    row += s == this->Size ? 0 : s + 2;
  }
  this->AtlasHeight = std::max(this->Size + 2, row);
  this->Atlas.assign(
    static_cast<std::size_t>(this->GetAtlasWidth() * this->AtlasHeight), glm::vec4(0.0f));
  this->Fill(environment, changes);
  for (int level = 0; level < this->GetNumberOfLevels(); ++level)
  {
    if (level > 0)
    {
      this->Halve(level);
    }
    this->ContinueBorder(level);
  }
}

int EnvironmentPyramid::ChooseSize(vtkEnvironment* environment)
{
  environment = environment->GetSubdivided();
  const double texels =
    static_cast<double>(environment->GetWidth()) * static_cast<double>(environment->GetHeight());
  const double wanted = std::max(std::sqrt(texels) / 1.4, 1.0);
  return wanted > 512.0 ? MaximumSize : 1 << static_cast<int>(std::ceil(std::log2(wanted) - 1e-9));
}

vtkIdType EnvironmentPyramid::EstimateBytes(vtkEnvironment* environment)
{
  const vtkIdType size = ChooseSize(environment);
  return 6 * (size + size / 2 + 4) * (size + 20);
}

std::size_t EnvironmentPyramid::Locate(int level, int x, int y) const
{
  const glm::ivec2 place = this->Origins[static_cast<std::size_t>(level)] + glm::ivec2(x, y) + 1;
  return static_cast<std::size_t>(place.y * this->GetAtlasWidth() + place.x);
}

// Sums of RGB and of weights, by area, of the points that fall into each texel of the map.
std::vector<glm::dvec4> EnvironmentPyramid::Gather(
  vtkEnvironment* environment, const TexelChanges& changes) const
{
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  const int parts = GetParts(environment, this->Size);
  const TexelDirections directions(width * parts, height * parts);
  std::vector<glm::dvec4> sums(static_cast<std::size_t>(this->Size) * this->Size, glm::dvec4(0.0));
  std::vector<Neighbors> columns;
  for (int k = 0; k < width * parts; ++k)
  {
    columns.push_back(PeriodicNeighbors((k + 0.5) / (width * parts), width));
  }
  std::vector<float> firstRoom, secondRoom;
  std::vector<glm::dvec3> mixed(width);
  for (int row = 0; row < height * parts; ++row)
  {
    // Interpolated between two rows of texels, then between two texels of that.
    const Neighbors rows = ClampedNeighbors((row + 0.5) / (height * parts), height);
    const float* first = changes.GetRow(environment, rows.First, 0, width, firstRoom);
    const float* second = changes.GetRow(environment, rows.Second, 0, width, secondRoom);
    for (int x = 0; x < width; ++x)
    {
      mixed[x] =
        rows.Mix<glm::dvec3>(glm::make_vec3(first + 3 * x), glm::make_vec3(second + 3 * x));
    }
    for (int column = 0; column < width * parts; ++column)
    {
      const glm::ivec2 at(ToSquare(directions.Get(column, row)) * static_cast<double>(this->Size));
      const Neighbors& near = columns[column];
      sums[static_cast<std::size_t>(at.y) * this->Size + at.x] +=
        directions.Rows[row].x * glm::dvec4(near.Mix(mixed[near.First], mixed[near.Second]), 1.0);
    }
  }
  return sums;
}

void EnvironmentPyramid::Fill(vtkEnvironment* environment, const TexelChanges& changes)
{
  // The map's texels take the mean of what falls into them.
  const std::vector<glm::dvec4> sums = this->Gather(environment, changes);
  const double solidAngle = 4.0 * Pi / static_cast<double>(sums.size());
  glm::dvec3 shown(0.0);
  const auto forTexels = [this](const auto& use)
  {
    for (int k = 0; k < this->Size * this->Size; ++k)
    {
      use(k, this->At(0, k % this->Size, k / this->Size));
    }
  };
  forTexels(
    [&](int k, glm::vec4& texel)
    {
      glm::dvec3 mean = glm::dvec3(sums[k]) / sums[k].w;
      if (!(sums[k].w > 0.0))
      {
        const glm::dvec2 middle(k % this->Size + 0.5, k / this->Size + 0.5);
        const glm::dvec3 d = ToSphere(middle / static_cast<double>(this->Size));
        double u, v;
        vtkEnvironment::GetCoordinates(&d.x, u, v);
        mean = changes.Interpolate(environment, u, v);
      }
      texel = glm::vec4(glm::vec3(mean), 0.0f);
      shown += mean * solidAngle;
    });
  // Points are taken or left by the map's texels as wholes: no light is lost or gained over all.
  glm::dvec3 kept(0.0);
  std::vector<float> room;
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    const float* pixels = changes.GetRow(environment, y, 0, environment->GetWidth(), room);
    glm::dvec3 sum(0.0);
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      sum += glm::dvec3(glm::make_vec3(pixels + 3 * x));
    }
    kept += environment->GetTexelSolidAngle(y) * sum;
  }
  const glm::dvec3 gain = kept / glm::max(shown, std::numeric_limits<double>::min());
  forTexels([&](int, glm::vec4& texel) { texel *= glm::vec4(gain, 1.0f); });
}

void EnvironmentPyramid::Halve(int level)
{
  const int size = this->Size >> level;
  const int parts = (this->Size >> (level - 1)) / size; // 2; 3 from three texels a side to one
  for (int y = 0; y < parts * size; ++y)
  {
    for (int x = 0; x < parts * size; ++x)
    {
      this->At(level, x / parts, y / parts) +=
        this->At(level - 1, x, y) / static_cast<float>(parts * parts);
    }
  }
}

void EnvironmentPyramid::ContinueBorder(int level)
{
  const int size = this->Size >> level;
  const int last = size - 1;
  for (int k = 0; k < size; ++k)
  {
    this->At(level, -1, k) = this->At(level, 0, last - k);
    this->At(level, size, k) = this->At(level, last, last - k);
    this->At(level, k, -1) = this->At(level, last - k, 0);
    this->At(level, k, size) = this->At(level, last - k, last);
  }
  this->At(level, -1, -1) = this->At(level, last, last);
  this->At(level, size, -1) = this->At(level, 0, last);
  this->At(level, -1, size) = this->At(level, last, 0);
  this->At(level, size, size) = this->At(level, 0, 0);
}

float EnvironmentPyramid::GetLevel(double solidAngle) const
{
  const double texel = 4.0 * Pi / (static_cast<double>(this->Size) * this->Size);
  return static_cast<float>(0.5 * std::log2(std::max(solidAngle / texel, 1e-30)));
}

glm::vec3 EnvironmentPyramid::Bilinear(int level, const glm::vec2& uv) const
{
  const glm::vec2 place = uv * static_cast<float>(this->Size >> level) + 0.5f;
  const glm::ivec2 first(place);
  const glm::vec2 weight = place - glm::vec2(first);
  const glm::vec4* row = &this->Atlas[this->Locate(level, first.x - 1, first.y - 1)];
  const glm::vec4* next = row + this->GetAtlasWidth();
  return glm::vec3(
    glm::mix(glm::mix(row[0], row[1], weight.x), glm::mix(next[0], next[1], weight.x), weight.y));
}

glm::vec3 EnvironmentPyramid::Sample(const glm::vec3& d, float lod) const
{
  const int last = this->GetNumberOfLevels() - 1;
  const float clamped = std::clamp(lod, 0.0f, static_cast<float>(last));
  const int level = std::min(static_cast<int>(clamped), std::max(last - 1, 0));
  const float t = clamped - static_cast<float>(level);
  const glm::vec2 uv = ToSquare(d);
  const glm::vec3 fine = this->Bilinear(level, uv);
  return last > 0 && t > 0.0f ? glm::mix(fine, this->Bilinear(level + 1, uv), t) : fine;
}
} // namespace measuredbrdf
