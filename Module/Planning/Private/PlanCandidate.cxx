// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanCandidate.h"

#include "vtkRadianceCostModel.h"
#include "vtkRadiancePlanner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr double ErrorOrders[] = { 3.0, 2.0, 2.0 }; // tables gain at best so many powers of sizes
// And at best so many times, in powers, what the step before gained in rows or view angles.
constexpr double RowGainPower = 4.0;
constexpr double ViewGainPower = 2.0;
constexpr double ViewGainFactor = 4.0; // so many times, in error, what it gained with fewer rows

// Rows, view angles, azimuths: what linear interpolation in each costs in error differs with the
// material's gloss (docs/methods.md).
const int TableSizes[][3] = { { 17, 8, 8 }, { 33, 8, 8 }, { 33, 12, 16 }, { 33, 24, 16 },
  { 65, 8, 8 }, { 65, 12, 16 }, { 65, 24, 24 }, { 129, 8, 8 }, { 129, 12, 16 }, { 129, 24, 16 },
  { 257, 8, 8 } };
// The same and samples of the sharp layer, with suns and lamps as lights.
const int LayerSizes[][4] = { { 17, 8, 8, 0 }, { 33, 8, 8, 0 }, { 33, 12, 16, 0 }, { 65, 8, 8, 0 },
  { 65, 12, 16, 0 }, { 129, 8, 8, 0 }, { 129, 12, 16, 0 }, { 257, 8, 8, 0 }, { 65, 12, 16, 8 } };
constexpr double MegabyteShare = 3.0 / 107.0; // of a table's pixel, that a megabyte counts as
constexpr double SpherePixels = 196350.0;     // where it does
constexpr vtkIdType TableBytes = 16 * (256 * 129 + 3 * 64); // irradiance and profile
const int LightCounts[] = { 64, 256, 1024, 4096 };
constexpr int AnisotropicLights = 256; // more cost seconds a frame without a graphics card
const int SampleCounts[] = { 16, 64, 256 };
const int FunctionCounts[] = { 9, 25, 64 };

vtkIdType GetTableBytes(const int sizes[3])
{
  return TableBytes +
         6 * static_cast<vtkIdType>(2 * (sizes[0] - 1)) * sizes[0] * sizes[1] * (sizes[2] + 1);
}

// What the order of the candidates counts. bytePrice: of a byte, in ns a pixel.
double GetOrder(const PlanCandidate& candidate, double bytePrice)
{
  return candidate.Cost + bytePrice * static_cast<double>(candidate.Bytes);
}
}

std::string GetSizesText(const PlanCandidate& candidate)
{
  const int* sizes = candidate.Sizes;
  const std::string first = std::to_string(sizes[0]);
  switch (candidate.Method)
  {
    case vtkRadiancePlanner::LIGHT_SET:
      return first + " soft lights by variance";
    case vtkRadiancePlanner::BASIS:
      return "at most " + first + " functions";
    case vtkRadiancePlanner::FILTERED:
      return first + " samples";
    default:
      return first + " rows x " + std::to_string(sizes[1]) + " view angles x " +
             std::to_string(sizes[2]) + " azimuths" +
             (sizes[3] > 0 ? ", " + std::to_string(sizes[3]) + " samples" : std::string()) +
             (candidate.Lights > 0 ? ", " + std::to_string(candidate.Lights) + " suns as lights"
                                   : std::string());
  }
}

std::vector<PlanCandidate> ListCandidates(
  const PlanConstraints& wishes, const std::vector<double>& costs)
{
  const double base = costs[vtkRadianceCostModel::BASE];
  const double tableCost = base + costs[vtkRadianceCostModel::TABLE];
  std::vector<PlanCandidate> wanted;
  if (wishes.IsIsotropic)
  {
    for (const auto& sizes : TableSizes)
    {
      PlanCandidate table(vtkRadiancePlanner::TABLE, sizes[0], sizes[1], sizes[2]);
      table.Cost = tableCost;
      table.Bytes = GetTableBytes(sizes);
      wanted.push_back(table);
    }
    for (const auto& sizes : LayerSizes)
    {
      PlanCandidate hybrid(vtkRadiancePlanner::HYBRID, sizes[0], sizes[1], sizes[2], sizes[3]);
      hybrid.Lights = wishes.Lights;
      hybrid.LightAngle = wishes.LightAngle;
      hybrid.Cost = tableCost + costs[vtkRadianceCostModel::SAMPLE] * sizes[3] +
                    costs[vtkRadianceCostModel::LIGHT] * wishes.Lights;
      hybrid.Bytes =
        GetTableBytes(sizes) + 32 * wishes.Lights + (sizes[3] > 0 ? wishes.PyramidBytes : 0);
      if (wishes.Lights > 0 || sizes[3] > 0) // else a table
      {
        wanted.push_back(hybrid);
      }
    }
  }
  // For anisotropic materials, and to compare with.
  for (const int count : LightCounts)
  {
    PlanCandidate lights(vtkRadiancePlanner::LIGHT_SET, count);
    lights.Cost = base + costs[vtkRadianceCostModel::LIGHT] * count;
    lights.Bytes = 32 * static_cast<vtkIdType>(count);
    if (wishes.All || (!wishes.IsIsotropic && count <= AnisotropicLights))
    {
      wanted.push_back(lights);
    }
  }
  for (const int count : SampleCounts)
  {
    PlanCandidate samples(vtkRadiancePlanner::FILTERED, count);
    samples.Cost = base + costs[vtkRadianceCostModel::SAMPLE] * count;
    samples.Bytes = wishes.PyramidBytes;
    if (wishes.IsIsotropic && wishes.All)
    {
      wanted.push_back(samples);
    }
  }
  for (const int count : FunctionCounts)
  {
    PlanCandidate functions(vtkRadiancePlanner::BASIS, count);
    functions.Cost = base + costs[vtkRadianceCostModel::FUNCTION] * count;
    functions.Bytes = 12 * 2 * 48 * 48 * static_cast<vtkIdType>(count);
    if (wishes.IsIsotropic && wishes.All)
    {
      wanted.push_back(functions);
    }
  }
  wanted.erase(
    std::remove_if(wanted.begin(), wanted.end(),
      [&wishes](const PlanCandidate& candidate) { return candidate.Bytes > wishes.MaximumBytes; }),
    wanted.end());
  const double bytePrice = 1e-6 * MegabyteShare * tableCost * SpherePixels / wishes.Pixels;
  std::stable_sort(wanted.begin(), wanted.end(),
    [bytePrice](const PlanCandidate& a, const PlanCandidate& b)
    { return GetOrder(a, bytePrice) < GetOrder(b, bytePrice); });
  return wanted;
}

bool CanPrune(
  const PlanCandidate& candidate, const std::vector<PlanCandidate>& tried, double tolerance)
{
  if (candidate.Method != vtkRadiancePlanner::TABLE &&
      candidate.Method != vtkRadiancePlanner::HYBRID)
  {
    return false;
  }
  const int rows = candidate.Sizes[0];
  const int views = candidate.Sizes[1];
  std::map<int, std::map<int, double>> errors; // by rows and view angles
  for (const PlanCandidate& other : tried)
  {
    if (other.Method != candidate.Method || other.Sizes[3] != candidate.Sizes[3])
    {
      continue;
    }
    // One is too far away for what this adds.
    double gain = 1.0;
    for (int k = 0; k < 3; ++k)
    {
      const double ratio = static_cast<double>(candidate.Sizes[k]) / other.Sizes[k];
      gain = std::max(gain, std::pow(ratio, ErrorOrders[k]));
    }
    if (other.Error > tolerance * gain)
    {
      return true;
    }
    errors[other.Sizes[0]][other.Sizes[1]] = other.Error;
  }
  const auto ofRows = errors.find(rows);
  std::vector<std::pair<int, double>> least; // by fewer rows
  for (const auto& [count, byViews] : errors)
  {
    double best = HUGE_VAL;
    for (const auto& [angles, error] : byViews)
    {
      best = std::min(best, error);
      const auto same = byViews.find(views);
      // More view angles alone gained more than is left: more rows do not replace them.
      if (same != byViews.end() && angles > views && same->second - error > tolerance)
      {
        return true;
      }
      // What they gained with fewer rows is too little here.
      if (same != byViews.end() && angles < views && count < rows && ofRows != errors.end())
      {
        const auto fewer = ofRows->second.find(angles);
        if (fewer != ofRows->second.end() &&
            fewer->second - ViewGainFactor * (error - same->second) > tolerance)
        {
          return true;
        }
      }
    }
    if (count < rows)
    {
      least.emplace_back(count, best);
    }
  }
  // More view angles gained too little.
  if (ofRows != errors.end() && ofRows->second.size() > 1)
  {
    const auto last = ofRows->second.rbegin();
    const double gain = std::min(last->second / std::next(last)->second, 1.0);
    if (last->first < views && last->second * std::pow(gain, ViewGainPower) > tolerance)
    {
      return true;
    }
  }
  // More rows gained too little.
  if (least.size() < 2)
  {
    return false;
  }
  const auto& [count, error] = least.back();
  const double gain = std::min(error / least[least.size() - 2].second, 1.0);
  return error * std::pow(gain, RowGainPower * std::log2(static_cast<double>(rows) / count)) >
         tolerance;
}
} // namespace measuredbrdf
