// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HiddenIntervals.h"

#include <algorithm>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr int Halvings = 3; // of a stratum of elevation
}

HiddenIntervals::HiddenIntervals(
  const std::vector<char>& hidden, int elevations, const Offset& offset, const Test& test)
  : Hidden(hidden)
  , Elevations(elevations)
  , PlaceInStratum(offset)
  , IsHidden(test)
{
  for (int s = 0; s < Sectors; ++s)
  {
    this->Intervals[static_cast<std::size_t>(s)] = this->Find(s);
  }
  this->PlaceEmpty();
}

double HiddenIntervals::GetPlace(int k, int sector) const
{
  return (k + this->PlaceInStratum(sector)) / this->Elevations;
}

// How many of the rays of an elevation, of the sector and both beside it.
int HiddenIntervals::CountHidden(int k, int sector) const
{
  int count = 0;
  for (int s = sector - 1; s <= sector + 1; ++s)
  {
    const int turn = (s + Sectors) % Sectors;
    count += this->Hidden[static_cast<std::size_t>(turn * this->Elevations + k)] ? 1 : 0;
  }
  return count;
}

// An edge between a hidden and a visible place of the middle, or the other way round.
double HiddenIntervals::Halve(int sector, double from, double to, bool hiddenBelow) const
{
  for (int k = 0; k < Halvings; ++k)
  {
    const double middle = 0.5 * (from + to);
    (this->IsHidden(sector, middle) == hiddenBelow ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

// The edge before place k of a sector's flags; where a hidden and a visible place do not meet
// there, half way.
double HiddenIntervals::FindEdge(
  int sector, int k, bool hiddenBelow, const std::vector<char>& flags) const
{
  const auto at = static_cast<std::size_t>(k);
  const double from = this->GetPlace(k - 1, sector);
  const double to = this->GetPlace(k, sector);
  return (flags[at - 1] != 0) == hiddenBelow && (flags[at] != 0) != hiddenBelow
           ? this->Halve(sector, from, to, hiddenBelow)
           : 0.5 * (from + to);
}

// The middle is asked only where the rays about it do not agree. As many places as are hidden,
// where most of them are.
HiddenIntervals::Interval HiddenIntervals::Find(int sector)
{
  std::vector<char> flags;
  for (int k = 0; k < this->Elevations; ++k)
  {
    const int near = this->CountHidden(k, sector);
    const bool asks = near > 0 && near < 3;
    flags.push_back(near == 3 || (asks && this->IsHidden(sector, this->GetPlace(k, sector))));
  }
  const auto count = static_cast<int>(std::count(flags.begin(), flags.end(), 1));
  if (count == 0)
  {
    // Lower than all rays?
    const double first = this->GetPlace(0, sector);
    const double edge =
      this->CountHidden(0, sector) > 0 ? this->Halve(sector, 0.0, first, true) : 0.0;
    return { 0.0, edge < first / (1 << Halvings) ? 0.0 : edge };
  }
  int best = -1;
  int first = 0;
  for (int begin = 0; begin + count <= this->Elevations; ++begin)
  {
    const auto inside =
      static_cast<int>(std::count(flags.begin() + begin, flags.begin() + begin + count, 1));
    if (inside > best)
    {
      best = inside;
      first = begin;
    }
  }
  const int last = first + count; // the first place above
  Interval interval;
  interval.Low = first == 0 ? 0.0 : this->FindEdge(sector, first, false, flags);
  interval.High = last < this->Elevations ? this->FindEdge(sector, last, true, flags)
                  : this->IsZenithHidden()
                    ? 1.0
                    : this->Halve(sector, this->GetPlace(last - 1, sector), 1.0, true);
  interval.High = std::max(interval.Low, interval.High);
  return interval;
}

bool HiddenIntervals::IsZenithHidden()
{
  if (this->Zenith < 0)
  {
    this->Zenith = this->IsHidden(0, 1.0) ? 1 : 0;
  }
  return this->Zenith == 1;
}

void HiddenIntervals::PlaceEmpty()
{
  const auto found = this->Intervals;
  const double zenith = this->Zenith == 1 ? 1.0 : 0.0; // where sectors beside it do not tell
  for (int s = 0; s < Sectors; ++s)
  {
    Interval& interval = this->Intervals[static_cast<std::size_t>(s)];
    double sum = 0.0;
    int count = 0;
    for (const int other : { s + Sectors - 1, s + 1 })
    {
      const Interval& beside = found[static_cast<std::size_t>(other % Sectors)];
      if (!beside.IsEmpty())
      {
        ++count;
        sum += !beside.IsToZenith()
                 ? (beside.IsFromHorizon() ? 0.0 : 0.5 * (beside.Low + beside.High))
               : beside.IsFromHorizon() ? zenith
                                        : 1.0;
      }
    }
    if (interval.IsEmpty())
    {
      const double place = count > 0 ? sum / count : zenith;
      interval = { place, place };
    }
  }
}
} // namespace measuredbrdf
