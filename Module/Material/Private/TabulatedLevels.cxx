// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TabulatedLevels.h"

#include "HalfVector.h"
#include "ZonalKernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace measuredbrdf
{
namespace
{
constexpr int MaximumThetaD = 45;          // 2 degrees
constexpr int MaximumPhiDPerHalfTurn = 36; // 5 degrees

// Where fewer of the weights than this fall on valid cells there is no value.
constexpr float MinimumValidWeight = 1e-4f;

// Samples along theta_h for a lobe of variance 1; the square root's spacing needs as many more as
// the fourth root of the variance is smaller.
constexpr double CountOfUnitVariance = 8.0;

// RGB times validity, validity (0 or 1).
struct Cell
{
  float Values[4];
};

// A mean over valid cells.
Cell Normalized(const Cell& sum)
{
  Cell cell{ { 0.0f, 0.0f, 0.0f, 0.0f } };
  if (sum.Values[3] > MinimumValidWeight)
  {
    for (int c = 0; c < 3; ++c)
    {
      cell.Values[c] = sum.Values[c] / sum.Values[3];
    }
    cell.Values[3] = 1.0f;
  }
  return cell;
}

// What part of sample k of `from` lies in sample j of `to` <= from, in units of the latter.
double GetOverlap(int k, int from, int j, int to)
{
  const double scale = static_cast<double>(to) / from;
  return std::max(std::min((k + 1) * scale, j + 1.0) - std::max(k * scale, j + 0.0), 0.0);
}

// The volume averaged to width x height samples of phi_d and theta_d.
std::vector<Cell> Average(
  const std::array<int, 3>& dimensions, const std::vector<float>& volume, int width, int height)
{
  std::vector<Cell> cells;
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < height; ++y)
    {
      const int top = y * dimensions[1] / height;
      const int bottom = ((y + 1) * dimensions[1] + height - 1) / height;
      for (int x = 0; x < width; ++x)
      {
        const int left = x * dimensions[0] / width;
        const int right = ((x + 1) * dimensions[0] + width - 1) / width;
        Cell sum{ { 0.0f, 0.0f, 0.0f, 0.0f } };
        for (int b = top; b < bottom; ++b)
        {
          for (int a = left; a < right; ++a)
          {
            const std::size_t index =
              static_cast<std::size_t>(a) +
              static_cast<std::size_t>(dimensions[0]) *
                (static_cast<std::size_t>(b) +
                  static_cast<std::size_t>(dimensions[1]) * static_cast<std::size_t>(z));
            const float* v = &volume[3 * index];
            if (!std::isnan(v[0]))
            {
              const float weight = static_cast<float>(
                GetOverlap(a, dimensions[0], x, width) * GetOverlap(b, dimensions[1], y, height));
              for (int c = 0; c < 3; ++c)
              {
                sum.Values[c] += weight * v[c];
              }
              sum.Values[3] += weight;
            }
          }
        }
        cells.push_back(Normalized(sum));
      }
    }
  }
  return cells;
}

// Variance of the Gaussian lobe with the width at half the height of the volume's, seen from within
// 45 degrees of h, where every theta_h up to 45 degrees is above the horizon.
double FindOwnVariance(const std::vector<Cell>& cells, int width, int height, int nThetaH)
{
  const std::size_t slice = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t half =
    static_cast<std::size_t>(width) * static_cast<std::size_t>((height + 1) / 2);
  std::vector<double> profile;
  double floor = std::numeric_limits<double>::max();
  for (int z = 0; z < nThetaH; ++z)
  {
    double sum = 0.0;
    double valid = 0.0;
    for (std::size_t k = 0; k < half; ++k)
    {
      const float* v = cells[slice * static_cast<std::size_t>(z) + k].Values;
      sum += static_cast<double>(v[0]) + v[1] + v[2];
      valid += v[3];
    }
    profile.push_back(valid > 0.0 ? sum / valid : (z > 0 ? profile.back() : 0.0));
    floor = std::min(floor, profile.back());
  }
  const double middle = 0.5 * (profile[0] + floor);
  for (int z = 1; z < nThetaH; ++z)
  {
    const double above = profile[static_cast<std::size_t>(z - 1)];
    const double below = profile[static_cast<std::size_t>(z)];
    if (below <= middle && above > middle)
    {
      const double theta = UnitToThetaH((z - 0.5 + (above - middle) / (above - below)) / nThetaH);
      return std::clamp(theta * theta / (2.0 * std::log(2.0)), 1e-6, 1.0);
    }
  }
  return 1.0;
}

// Weights of the n samples along theta_h in the mean about angle a; they sum to 1. The samples
// stand for their linear interpolation, in steps fine enough for the kernel.
std::vector<double> GetWeights(double a, int n, double variance)
{
  const double reach = GetRingReach(variance);
  std::vector<double> weights(static_cast<std::size_t>(n), 0.0);
  double total = 0.0;
  for (int k = 0; k <= n; ++k) // between samples k - 1 and k
  {
    const double low = std::max(k - 0.5, 0.0) / n;
    const double high = std::min(k + 0.5, n + 0.0) / n;
    const double width = UnitToThetaH(high) - UnitToThetaH(low);
    if (UnitToThetaH(high) < a - reach || UnitToThetaH(low) > a + reach)
    {
      continue;
    }
    const int steps = 2 + static_cast<int>(4.0 * width / std::sqrt(variance));
    for (int step = 0; step < steps; ++step)
    {
      const double u = low + (high - low) * (step + 0.5) / steps;
      // d theta = pi u du
      const double weight = GetRingWeight(a, UnitToThetaH(u), variance) * u * (high - low) / steps;
      const Neighbors t = ClampedNeighbors(u, n);
      weights[static_cast<std::size_t>(t.First)] += weight * (1.0 - t.Weight);
      weights[static_cast<std::size_t>(t.Second)] += weight * t.Weight;
      total += weight;
    }
  }
  for (double& weight : weights)
  {
    weight /= total;
  }
  return weights;
}

// The slice of weighted cells along theta_h, appended to rgb.
void AppendSlice(const std::vector<Cell>& cells, const std::vector<double>& weights,
  std::vector<Cell>& sums, std::vector<float>& rgb)
{
  const std::size_t slice = sums.size();
  std::fill(sums.begin(), sums.end(), Cell{ { 0.0f, 0.0f, 0.0f, 0.0f } });
  for (std::size_t z = 0; z < weights.size(); ++z)
  {
    const float weight = static_cast<float>(weights[z]);
    for (std::size_t k = 0; weight > 0.0f && k < slice; ++k)
    {
      const Cell& cell = cells[slice * z + k];
      for (int c = 0; c < 4; ++c)
      {
        sums[k].Values[c] += weight * cell.Values[c];
      }
    }
  }
  for (const Cell& sum : sums)
  {
    const Cell mean = Normalized(sum);
    for (int c = 0; c < 3; ++c)
    {
      rgb.push_back(
        mean.Values[3] > 0.0f ? mean.Values[c] : std::numeric_limits<float>::quiet_NaN());
    }
  }
}

int RoundUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }
} // namespace

//------------------------------------------------------------------------------
TabulatedLevels::TabulatedLevels(
  const std::array<int, 3>& dimensions, bool halfTurn, const std::vector<float>& volume)
{
  const int width = std::min(dimensions[0], (halfTurn ? 1 : 2) * MaximumPhiDPerHalfTurn);
  const int height = std::min(dimensions[1], MaximumThetaD);
  const std::vector<Cell> cells = Average(dimensions, volume, width, height);
  this->OwnVariance = FindOwnVariance(cells, width, height, dimensions[2]);
  this->NumberOfLevels = static_cast<int>(std::ceil(std::log2(1.0 + 1.0 / this->OwnVariance)));
  const double wanted = std::ceil(CountOfUnitVariance * std::pow(2.0 * this->OwnVariance, -0.25));
  this->FirstCount = RoundUp(
    std::min(static_cast<int>(wanted), dimensions[2]), 1 << ((this->NumberOfLevels - 1) / 4));
  this->Dimensions = { width, height,
    this->GetOffset(this->NumberOfLevels) + this->GetCount(this->NumberOfLevels) };

  std::vector<Cell> sums(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  this->Volume.reserve(3 * sums.size() * static_cast<std::size_t>(this->Dimensions[2]));
  for (int level = 1; level <= this->NumberOfLevels; ++level)
  {
    const double variance = this->OwnVariance * (std::exp2(level) - 1.0);
    const int count = this->GetCount(level);
    for (int k = 0; k < count; ++k)
    {
      const double theta = UnitToThetaH((k + 0.5) / count);
      AppendSlice(cells, GetWeights(theta, dimensions[2], variance), sums, this->Volume);
    }
  }
}

//------------------------------------------------------------------------------
int TabulatedLevels::GetOffset(int level) const
{
  // Four levels of each count, which halves: 4 (n + n/2 + ...) = 8 (n - count).
  const int count = this->GetCount(level);
  return 8 * (this->FirstCount - count) + (level - 1) % 4 * count;
}

//------------------------------------------------------------------------------
Neighbors TabulatedLevels::FindLevels(double variance) const
{
  const double level = std::min(std::log1p(variance / this->OwnVariance) / std::log(2.0),
    static_cast<double>(this->NumberOfLevels));
  const int first = std::min(static_cast<int>(level), this->NumberOfLevels - 1);
  return { first, first + 1, level - first };
}

//------------------------------------------------------------------------------
Neighbors TabulatedLevels::FindSlices(int level, double u) const
{
  const Neighbors slices = ClampedNeighbors(u, this->GetCount(level));
  const int offset = this->GetOffset(level);
  return { offset + slices.First, offset + slices.Second, slices.Weight };
}
} // namespace measuredbrdf
