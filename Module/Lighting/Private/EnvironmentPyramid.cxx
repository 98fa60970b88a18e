// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPyramid.h"

#include "HalfVector.h" // for Pi
#include "TexelChanges.h"
#include "TexelInterpolation.h"
#include "vtkEnvironment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

// Radiance times solid angle.
glm::dvec3 SumTexels(vtkEnvironment* environment, const TexelChanges& changes)
{
  const int width = environment->GetWidth();
  std::vector<float> room;
  glm::dvec3 sum(0.0);
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    const float* pixels = changes.GetRow(environment, y, 0, width, room);
    const double solidAngle = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < width; ++x)
    {
      sum += solidAngle * glm::dvec3(pixels[3 * x], pixels[3 * x + 1], pixels[3 * x + 2]);
    }
  }
  return sum;
}

// atan(y/x) in right angles for x, y >= 0, as brdfQuadrant does it.
float Quadrant(float y, float x)
{
  const float r = std::min(x, y) / std::max(std::max(x, y), 1e-30f);
  const float s = r * r;
  const float a =
    r * (0.636619357f +
          s * (-0.212163183f +
                s * (0.126569445f +
                      s * (-0.0858621121f +
                            s * (0.0533940294f + s * (-0.0235631824f + s * 0.0050059724f))))));
  return y > x ? 1.0f - a : a;
}
}

glm::dvec2 EnvironmentPyramid::ToSquare(const glm::dvec3& d)
{
  const double r = std::sqrt(std::max(1.0 - std::abs(d.z), 0.0));
  double v = r * std::atan2(std::abs(d.y), std::abs(d.x)) * 2.0 / Pi;
  double u = r - v;
  if (d.z < 0.0)
  {
    std::swap(u, v);
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return 0.5 * glm::dvec2(std::copysign(u, d.x), std::copysign(v, d.y)) + 0.5;
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
  vtkEnvironment* environment, const TexelChanges* changes, int size)
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
  static const TexelChanges& none = *new TexelChanges; // never destroyed: threads use it
  this->Fill(environment, changes ? *changes : none);
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

glm::vec4& EnvironmentPyramid::At(int level, int x, int y)
{
  return this->Atlas[this->Locate(level, x, y)];
}

// Sums of RGB and of weights, by area, of the points that fall into each texel of the map.
std::vector<glm::dvec4> EnvironmentPyramid::Gather(
  vtkEnvironment* environment, const TexelChanges& changes) const
{
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  std::vector<glm::dvec4> sums(
    static_cast<std::size_t>(this->Size) * static_cast<std::size_t>(this->Size), glm::dvec4(0.0));
  const int parts = GetParts(environment, this->Size);
  std::vector<glm::dvec2> columns;
  std::vector<TexelNeighbors> neighbors;
  for (int k = 0; k < width * parts; ++k)
  {
    const double u = (k + 0.5) / (width * parts);
    glm::dvec3 d;
    vtkEnvironment::GetDirection(u, 0.5, &d.x);
    columns.emplace_back(d.x, d.z);
    neighbors.push_back(TexelNeighbors::InRow(u, static_cast<std::size_t>(width)));
  }
  std::vector<float> firstRoom, secondRoom;
  std::vector<float> mixed(3 * static_cast<std::size_t>(width));
  for (int row = 0; row < height * parts; ++row)
  {
    const double v = (row + 0.5) / (height * parts);
    glm::dvec3 meridian;
    vtkEnvironment::GetDirection(0.5, v, &meridian.x);
    const double cosine = std::hypot(meridian.x, meridian.z);
    // Interpolated between two rows of texels, then between two texels of that.
    const auto rows = TexelNeighbors::InColumn(v, static_cast<std::size_t>(height));
    const float* first =
      changes.GetRow(environment, static_cast<int>(rows.First), 0, width, firstRoom);
    const float* second =
      changes.GetRow(environment, static_cast<int>(rows.Second), 0, width, secondRoom);
    for (std::size_t k = 0; k < mixed.size(); ++k)
    {
      mixed[k] = static_cast<float>(rows.Mix(first[k], second[k]));
    }
    for (std::size_t column = 0; column < columns.size(); ++column)
    {
      const glm::dvec3 d(cosine * columns[column].x, meridian.y, cosine * columns[column].y);
      const glm::dvec2 uv = ToSquare(d);
      const int x = std::min(static_cast<int>(uv.x * this->Size), this->Size - 1);
      const int y = std::min(static_cast<int>(uv.y * this->Size), this->Size - 1);
      const TexelNeighbors& between = neighbors[column];
      const float* a = &mixed[3 * between.First];
      const float* b = &mixed[3 * between.Second];
      glm::dvec4 value(1.0);
      for (int c = 0; c < 3; ++c)
      {
        value[c] = between.Mix(a[c], b[c]);
      }
      sums[static_cast<std::size_t>(y) * this->Size + x] += cosine * value;
    }
  }
  return sums;
}

void EnvironmentPyramid::Fill(vtkEnvironment* environment, const TexelChanges& changes)
{
  // The map's texels take the mean of what falls into them.
  const std::vector<glm::dvec4> sums = this->Gather(environment, changes);
  glm::dvec3 shown(0.0);
  for (int y = 0; y < this->Size; ++y)
  {
    for (int x = 0; x < this->Size; ++x)
    {
      const glm::dvec4& sum = sums[static_cast<std::size_t>(y) * this->Size + x];
      glm::dvec3 mean;
      if (sum.w > 0.0)
      {
        mean = glm::dvec3(sum) / sum.w;
      }
      else
      {
        const glm::dvec3 d = ToSphere((glm::dvec2(x, y) + 0.5) / static_cast<double>(this->Size));
        changes.GetRadiance(environment, &d.x, &mean.x);
      }
      this->At(0, x, y) = glm::vec4(glm::vec3(mean), 0.0f);
      shown += mean * 4.0 * Pi / (static_cast<double>(this->Size) * this->Size);
    }
  }
  // Points are taken or left by the map's texels as wholes: no light is lost or gained over all.
  const glm::dvec3 kept = SumTexels(environment, changes);
  glm::vec4 gain(1.0f);
  for (int c = 0; c < 3; ++c)
  {
    gain[c] = shown[c] > 0.0 ? static_cast<float>(kept[c] / shown[c]) : 1.0f;
  }
  for (int y = 0; y < this->Size; ++y)
  {
    for (int x = 0; x < this->Size; ++x)
    {
      this->At(0, x, y) *= gain;
    }
  }
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

glm::vec3 EnvironmentPyramid::Bilinear(int level, float u, float v) const
{
  const float size = static_cast<float>(this->Size >> level);
  const float x = u * size + 0.5f;
  const float y = v * size + 0.5f;
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const std::size_t stride = static_cast<std::size_t>(this->GetAtlasWidth());
  const glm::vec4* row = &this->Atlas[this->Locate(level, x0 - 1, y0 - 1)];
  const float right = x - static_cast<float>(x0);
  return glm::vec3(glm::mix(glm::mix(row[0], row[1], right),
    glm::mix(row[stride], row[stride + 1], right), y - static_cast<float>(y0)));
}

glm::vec3 EnvironmentPyramid::Sample(const glm::vec3& d, float lod) const
{
  const float r = std::sqrt(std::max(1.0f - std::abs(d.z), 0.0f));
  float v = r * Quadrant(std::abs(d.y), std::abs(d.x));
  float u = r - v;
  if (d.z < 0.0f)
  {
    std::swap(u, v);
    u = 1.0f - u;
    v = 1.0f - v;
  }
  u = 0.5f * std::copysign(u, d.x) + 0.5f;
  v = 0.5f * std::copysign(v, d.y) + 0.5f;
  u = std::clamp(u, 0.0f, 0.999999f);
  v = std::clamp(v, 0.0f, 0.999999f);
  const int last = this->GetNumberOfLevels() - 1;
  const float clamped = std::clamp(lod, 0.0f, static_cast<float>(last));
  const int level = std::min(static_cast<int>(clamped), std::max(last - 1, 0));
  const float t = clamped - static_cast<float>(level);
  const glm::vec3 fine = this->Bilinear(level, u, v);
  return last > 0 && t > 0.0f ? fine + t * (this->Bilinear(level + 1, u, v) - fine) : fine;
}
} // namespace measuredbrdf
