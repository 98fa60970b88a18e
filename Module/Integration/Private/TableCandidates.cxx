// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableCandidates.h"

#include "RadianceTable.h"
#include "ShaderProfile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>

namespace measuredbrdf
{
namespace
{
// A table's error falls at best by so many powers of its rows, view angles and azimuths,
constexpr double ErrorOrders[] = { 3.0, 2.0, 2.0 };
// from one table with tiles to another by so many times (measured: 2.15, by predictions that are a
// seventh off),
constexpr double MostOfTiles = 2.6;
// and at best by so many times, in powers, what the step before gained in rows or view angles.
constexpr double RowGainPower = 4.0;
constexpr double ViewGainPower = 2.0;
constexpr double ViewGainFactor = 4.0; // so many times, in error, what it gained with fewer rows

// Twice as many maps leave at least so much of the error; measured: 0.75 to 0.95.
constexpr double LeastOfMaps = 0.7;
// and so much of what fewer maps leave, however many rows they have; measured: 0.64 to 0.96.
constexpr double LeastOfModes = 0.6;

constexpr vtkIdType MapBytes =
  4 * RadianceTable::IrradianceSide * RadianceTable::IrradianceSide + 16 * ShaderProfile::Size;
}

// What linear interpolation in each size costs in error differs with the material's gloss
// (docs/methods.md).
std::vector<std::vector<int>> GetTableCandidates()
{
  return { { 17, 8, 8 }, { 33, 8, 8 }, { 33, 12, 16 }, { 33, 24, 16 }, { 65, 8, 8 }, { 65, 12, 16 },
    { 65, 20, 16 }, { 65, 24, 24 }, { 129, 8, 8 }, { 201, 20, 16 }, { 257, 12, 16 },
    { 257, 24, 16 } };
}

std::vector<std::vector<int>> GetHybridCandidates()
{
  return { { 17, 8, 8, 0 }, { 33, 8, 8, 0 }, { 33, 12, 16, 0 }, { 33, 20, 16, 0 }, { 65, 8, 8, 0 },
    { 65, 12, 16, 0 }, { 65, 20, 12, 0 }, { 113, 8, 8, 0 }, { 257, 12, 16, 0 }, { 128, 12, 8, 4 },
    { 256, 12, 8, 4 }, { 256, 12, 8, 8 }, { 128, 12, 8, 16 } };
}

std::vector<std::vector<int>> GetAnisotropicCandidates()
{
  return { { 17, 8, 16, 8 }, { 25, 6, 16, 8 }, { 25, 8, 20, 8 }, { 33, 6, 24, 6 }, { 33, 6, 24, 8 },
    { 33, 8, 32, 8 }, { 49, 8, 32, 8 } };
}

vtkIdType GetTableBytes(int rows, int viewAngles, int azimuths)
{
  const RadianceTable table(rows, viewAngles, azimuths);
  return MapBytes +
         4 * static_cast<vtkIdType>(table.GetMap(viewAngles, 0) + table.Tiles.Places.size());
}

namespace
{
// By how many times the error may fall from the other sizes to these.
double GetMostGain(const std::vector<int>& sizes, const std::vector<int>& others)
{
  double gain = 1.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double ratio = static_cast<double>(sizes[k]) / others[k];
    gain = std::max(gain, std::pow(ratio, ErrorOrders[k]));
  }
  const bool haveTiles = std::min(sizes[0], others[0]) > TableTiles::LargestWhole;
  return haveTiles ? std::min(gain, MostOfTiles) : gain;
}
}

bool CanPruneTable(const std::vector<int>& sizes,
  const std::vector<vtkRadianceIntegrator::Attempt>& attempts, double tolerance)
{
  const int rows = sizes[0];
  const int views = sizes[1];
  std::map<int, std::map<int, double>> errors; // by rows and view angles
  for (const vtkRadianceIntegrator::Attempt& other : attempts)
  {
    // One is too far away for what this adds.
    if (other.Error > tolerance * GetMostGain(sizes, other.Sizes))
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
  const auto& [fewer, before] = least[least.size() - 2];
  double gain = std::min(error / before, 1.0);
  for (const auto& [angles, more] : errors[count])
  {
    const auto same = errors[fewer].find(angles);
    gain = same != errors[fewer].end() ? std::min(gain, more / same->second) : gain;
  }
  return std::min(error, before) *
           std::pow(gain, RowGainPower * std::log2(static_cast<double>(rows) / count)) >
         tolerance;
}

namespace
{
// A table of 113 rows is as good as maps of 128.
bool IsClearlyFewer(int rows, int others) { return 8 * rows < 7 * others; }

// What attempts show that too few maps cost, however many rows they have: of a table of fewer rows
// rows cost more, and all that it lacks is less.
double GetLeastOfModes(int maps, const std::vector<vtkRadianceIntegrator::Attempt>& attempts,
  const std::vector<vtkRadianceIntegrator::Attempt>& tables)
{
  double least = 0.0;
  for (const vtkRadianceIntegrator::Attempt& attempt : attempts)
  {
    const double doublings = std::log2(static_cast<double>(maps) / attempt.Sizes[3]);
    for (const vtkRadianceIntegrator::Attempt& table : tables)
    {
      if (IsClearlyFewer(table.Sizes[0], attempt.Sizes[0]))
      {
        least = std::max(least, (attempt.Error - table.Error) * std::pow(LeastOfModes, doublings));
      }
    }
  }
  return least;
}
}

// Rows gain by as much as CanPruneTable expects of a table.
bool CanPruneMaps(int rows, int maps, const std::vector<vtkRadianceIntegrator::Attempt>& attempts,
  const std::vector<vtkRadianceIntegrator::Attempt>& tables, double tolerance)
{
  double gain = 0.0; // by the finest tables that differ in rows alone
  int finest = 0;
  for (const vtkRadianceIntegrator::Attempt& fewer : tables)
  {
    for (const vtkRadianceIntegrator::Attempt& more : tables)
    {
      const double doublings =
        std::log2((more.Sizes[0] - 1.0) / std::max(fewer.Sizes[0] - 1.0, 1.0));
      if (doublings > 0.75 && doublings <= 1.0 && more.Sizes[0] > finest &&
          fewer.Sizes[1] == more.Sizes[1] && fewer.Sizes[2] == more.Sizes[2])
      {
        finest = more.Sizes[0];
        gain = std::pow(std::min(more.Error / fewer.Error, 1.0), 1.0 / doublings);
      }
    }
  }
  if (GetLeastOfModes(maps, attempts, tables) > tolerance)
  {
    return true;
  }
  return std::any_of(attempts.begin(), attempts.end(),
    [=](const vtkRadianceIntegrator::Attempt& attempt)
    {
      if (attempt.Sizes[0] >= rows) // maps of as many rows, but fewer
      {
        const double doublings = std::log2(static_cast<double>(maps) / attempt.Sizes[3]);
        return attempt.Error * std::pow(LeastOfMaps, doublings) > tolerance;
      }
      return 2 * attempt.Sizes[0] == rows && !IsClearlyFewer(finest, attempt.Sizes[0]) &&
             attempt.Error * std::pow(gain, RowGainPower) > tolerance;
    });
}
} // namespace measuredbrdf
