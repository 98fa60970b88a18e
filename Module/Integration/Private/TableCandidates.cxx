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

namespace measuredbrdf
{
namespace
{
// A table's error falls at best by so many powers of its rows, view angles and azimuths,
constexpr double ErrorOrders[] = { 3.0, 2.0, 2.0 };
// from one table of many rows and view angles to another by so many times (measured: 2.15, by
// predictions that are a seventh off),
constexpr double MostOfMany = 2.6;
constexpr int ManyRows = 129;
constexpr int ManyViews = 12;
// and by so many powers of what the rows before gained, for each doubling of them: where few rows
// do not show a lobe yet, twice as many gain less than the next. Of view angles with as many rows
// by so many powers of what the step before gained, for each step by as many times.
constexpr double RowGainPower = 2.0;
constexpr double RowGainPowerOfFew = 4.0;
constexpr int FewRows = 64;
constexpr double MostOfRows = 0.7; // tiles may have held back what seems to gain less
constexpr double ViewGainPower = 2.0;
constexpr double ViewGainFactor = 4.0; // so many times, in error, what it gained with fewer rows

// Twice as many maps leave at least so much of the error; measured: 0.75 to 0.95.
constexpr double LeastOfMaps = 0.7;
// and so much of what fewer maps leave, however many rows they have; measured: 0.64 to 0.96.
constexpr double LeastOfModes = 0.6;

// Of tables that differ in rows alone, where maps were worth their cost the finer one left 0.14 to
// 0.55 of the coarser one's error.
constexpr int FineTable[] = { 257, 8, 8 };
constexpr int CoarseTable[] = { 65, 8, 8 };
constexpr double MostOfMappedRows = 0.65;
constexpr double NearTolerance = 1.5; // times it: maps, which have more view angles, may meet it

constexpr vtkIdType MapBytes =
  4 * RadianceTable::IrradianceSide * RadianceTable::IrradianceSide + 16 * ShaderProfile::Size;
}

// What linear interpolation in each size costs in error differs with the material's gloss
// (docs/methods/memory.md). Of more than 113 rows: with tiles (TableTiles.h).
std::vector<std::vector<int>> GetTableCandidates()
{
  return { { 17, 8, 8 }, { 33, 8, 8 }, { 33, 12, 16 }, { 33, 24, 16 }, { 49, 12, 16 }, { 65, 8, 8 },
    { 129, 12, 16 }, { 257, 8, 8 }, { 129, 20, 16 }, { 201, 20, 16 }, { 257, 12, 16 } };
}

std::vector<std::vector<int>> GetHybridCandidates()
{
  return { { 17, 8, 8, 0 }, { 33, 8, 8, 0 }, { 33, 12, 16, 0 }, { 33, 20, 12, 0 }, { 65, 8, 8, 0 },
    { 65, 12, 16, 0 }, { 65, 20, 12, 0 }, { 113, 8, 8, 0 }, { 161, 16, 16, 0 }, { 128, 12, 8, 4 },
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
  const bool haveMany = std::min(sizes[0], others[0]) > ManyRows && others[1] >= ManyViews;
  return haveMany ? std::min(gain, MostOfMany) : gain;
}

// Whether two attempts differ by more than the tolerance in what more view angles, or more rows,
// cannot bring: one has fewer of the former, but not of the latter, and is worse.
bool IsOutOfReach(const std::vector<int>& sizes, const vtkRadianceIntegrator::Attempt& worse,
  const vtkRadianceIntegrator::Attempt& better, double tolerance)
{
  const std::vector<int>& a = worse.Sizes;
  const std::vector<int>& b = better.Sizes;
  const bool isCoarser = b[0] <= a[0] || (a[0] > FewRows && 2 * (b[0] - 1) <= sizes[0] - 1);
  const bool byViews = sizes[1] <= a[1] && a[1] < b[1] && isCoarser;
  const bool byRows = sizes[0] <= a[0] && a[0] < b[0] && b[1] <= a[1];
  return (byViews || byRows) && worse.Error - better.Error > tolerance;
}

// What view angles gained with fewer rows, or at the last step with as many, is too little.
bool GainTooLittleByViews(const std::vector<int>& sizes,
  const std::map<int, std::map<int, double>>& errors, double tolerance)
{
  const int rows = sizes[0];
  const int views = sizes[1];
  const auto ofRows = errors.find(rows);
  if (ofRows == errors.end())
  {
    return false;
  }
  for (const auto& [count, byViews] : errors)
  {
    const auto same = byViews.find(views);
    for (const auto& [angles, error] : byViews)
    {
      const auto fewer = ofRows->second.find(angles);
      if (same != byViews.end() && angles < views && count < rows &&
          fewer != ofRows->second.end() &&
          fewer->second - ViewGainFactor * (error - same->second) > tolerance)
      {
        return true;
      }
    }
  }
  if (ofRows->second.size() < 2)
  {
    return false;
  }
  const auto last = ofRows->second.rbegin();
  const auto before = std::next(last);
  const double gain = std::min(last->second / before->second, 1.0);
  const double steps = std::log(static_cast<double>(views) / last->first) /
                       std::log(static_cast<double>(last->first) / before->first);
  return last->first < views && last->second * std::pow(gain, ViewGainPower * steps) > tolerance;
}

// By how many times the error fell for each doubling of the rows, where these grew last.
double GetRowGain(const std::map<int, double>& errors)
{
  const auto last = errors.rbegin();
  const auto before = std::next(last);
  const double doublings = std::log2(static_cast<double>(last->first) / before->first);
  return std::pow(std::min(last->second / before->second, 1.0), 1.0 / doublings);
}

// What they gained with as many view angles, or with those that have most rows, is too little. Of
// an error rows bring down one part and view angles another.
bool GainTooLittleByRows(const std::vector<int>& sizes,
  const std::map<int, std::map<int, double>>& errors, double tolerance)
{
  std::map<int, std::map<int, double>> byViews; // and by rows
  for (auto it = errors.begin(); it != errors.end() && it->first < sizes[0]; ++it)
  {
    for (const auto& [views, error] : it->second)
    {
      byViews[views][it->first] = error;
    }
  }
  const std::map<int, double>* known = nullptr;
  for (const auto& [views, byRows] : byViews)
  {
    const bool isFiner = !known || byRows.rbegin()->first > known->rbegin()->first;
    if (byRows.size() > 1 && (isFiner || views == sizes[1]))
    {
      known = &byRows;
    }
    if (known == &byRows && views == sizes[1])
    {
      break;
    }
  }
  if (!known)
  {
    return false;
  }
  const int finest = known->rbegin()->first;
  const double gain = std::min(GetRowGain(*known), MostOfRows);
  for (auto it = errors.lower_bound(finest); it != errors.end() && it->first < sizes[0]; ++it)
  {
    const double power = (finest > FewRows ? RowGainPower : RowGainPowerOfFew) *
                         std::log2(static_cast<double>(sizes[0]) / it->first);
    for (const auto& [views, error] : it->second)
    {
      const double left = std::pow(static_cast<double>(views) / sizes[1], ErrorOrders[1]);
      if (views <= sizes[1] && error * std::min(std::pow(gain, power), left) > tolerance)
      {
        return true;
      }
    }
  }
  return false;
}
}

bool CanPruneTable(const std::vector<int>& sizes,
  const std::vector<vtkRadianceIntegrator::Attempt>& attempts, double tolerance)
{
  std::map<int, std::map<int, double>> errors; // by rows and view angles
  for (const vtkRadianceIntegrator::Attempt& attempt : attempts)
  {
    const auto isBetter = [&](const vtkRadianceIntegrator::Attempt& other)
    { return IsOutOfReach(sizes, attempt, other, tolerance); };
    // It is too far away for what this adds, or lacks what this lacks, too.
    if (attempt.Error > tolerance * GetMostGain(sizes, attempt.Sizes) ||
        std::any_of(attempts.begin(), attempts.end(), isBetter))
    {
      return true;
    }
    errors[attempt.Sizes[0]][attempt.Sizes[1]] = attempt.Error;
  }
  return GainTooLittleByViews(sizes, errors, tolerance) ||
         GainTooLittleByRows(sizes, errors, tolerance);
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
        gain = std::min( // tiles may have held it back; maps have none
          std::pow(std::min(more.Error / fewer.Error, 1.0), 1.0 / doublings), MostOfRows);
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

// Maps gain as much as a table's rows do.
bool CanPruneMapsAlone(const std::vector<vtkRadianceIntegrator::Attempt>& tables, double tolerance)
{
  const auto find = [&tables](const int(&sizes)[3])
  {
    return std::find_if(tables.begin(), tables.end(),
      [&sizes](const vtkRadianceIntegrator::Attempt& table)
      { return std::equal(std::begin(sizes), std::end(sizes), table.Sizes.begin()); });
  };
  const auto fine = find(FineTable);
  const auto coarse = find(CoarseTable);
  if (fine == tables.end())
  {
    return CanPruneTable({ std::begin(FineTable), std::end(FineTable) }, tables, tolerance);
  }
  return coarse != tables.end() && fine->Error > NearTolerance * tolerance &&
         fine->Error > MostOfMappedRows * coarse->Error;
}
} // namespace measuredbrdf
