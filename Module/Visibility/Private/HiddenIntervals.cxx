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
  std::array<Flags, Sectors> flags;
  double misfit[2] = { 0.0, 0.0 };
  for (int s = 0; s < Sectors; ++s)
  {
    Flags& own = flags[static_cast<std::size_t>(s)];
    own = this->FindFlags(s);
    misfit[0] += this->FindRun(own).Misfit;
    Flags visible = own;
    visible.flip();
    misfit[1] += this->FindRun(visible).Misfit;
  }
  this->Opening = misfit[1] < misfit[0];
  for (int s = 0; s < Sectors; ++s)
  {
    Flags& own = flags[static_cast<std::size_t>(s)];
    if (this->Opening)
    {
      own.flip();
    }
    this->Intervals[static_cast<std::size_t>(s)] = this->Find(s, own);
  }
  this->PlaceEmpty();
}

double HiddenIntervals::GetPlace(int k, int sector) const
{
  return (k + this->PlaceInStratum(sector)) / this->Elevations;
}

bool HiddenIntervals::IsInside(int sector, double sine) const
{
  return this->IsHidden(sector, sine) != this->Opening;
}

// How many of the rays of an elevation, of the sector and both beside it, are hidden.
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

// Whether any of these is inside.
bool HiddenIntervals::IsNearInside(int k, int sector) const
{
  const int count = this->CountHidden(k, sector);
  return this->Opening ? count < 3 : count > 0;
}

// The middle is asked only where the rays about it do not agree.
HiddenIntervals::Flags HiddenIntervals::FindFlags(int sector) const
{
  Flags flags;
  for (int k = 0; k < this->Elevations; ++k)
  {
    const int near = this->CountHidden(k, sector);
    const bool asks = near > 0 && near < 3;
    flags.push_back(near == 3 || (asks && this->IsHidden(sector, this->GetPlace(k, sector))));
  }
  return flags;
}

// As many places as are inside, where most of them are.
HiddenIntervals::Run HiddenIntervals::FindRun(const Flags& flags) const
{
  const auto isInside = [&flags](int k) { return flags[static_cast<std::size_t>(k)] ? 1 : 0; };
  Run run;
  run.Count = static_cast<int>(std::count(flags.begin(), flags.end(), true));
  int inside = static_cast<int>(std::count(flags.begin(), flags.begin() + run.Count, true));
  int best = inside;
  for (int begin = 1; begin + run.Count <= this->Elevations; ++begin)
  {
    inside += isInside(begin + run.Count - 1) - isInside(begin - 1);
    if (inside > best)
    {
      best = inside;
      run.First = begin;
    }
  }
  for (int k = 0; k < this->Elevations; ++k)
  {
    const int isInRun = k >= run.First && k < run.First + run.Count ? 1 : 0;
    run.Misfit += isInRun != isInside(k) ? k + 0.5 : 0.0;
  }
  return run;
}

// An edge between a place inside and one outside, or the other way round.
double HiddenIntervals::Halve(int sector, double from, double to, bool insideBelow) const
{
  for (int k = 0; k < Halvings; ++k)
  {
    const double middle = 0.5 * (from + to);
    (this->IsInside(sector, middle) == insideBelow ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

// The edge before place k of a sector's flags; where a place inside and one outside do not meet
// there, half way.
double HiddenIntervals::FindEdge(int sector, int k, bool insideBelow, const Flags& flags) const
{
  const auto at = static_cast<std::size_t>(k);
  const double from = this->GetPlace(k - 1, sector);
  const double to = this->GetPlace(k, sector);
  return flags[at - 1] == insideBelow && flags[at] != insideBelow
           ? this->Halve(sector, from, to, insideBelow)
           : 0.5 * (from + to);
}

// Where an opening begins whose lowest place sees the sky, though a ray beside it does not.
double HiddenIntervals::FindRim(int sector) const
{
  const double first = this->GetPlace(0, sector);
  const bool asks = this->Opening && this->CountHidden(0, sector) > 0;
  const double edge = asks ? this->Halve(sector, 0.0, first, false) : 0.0;
  return edge < first / (1 << Halvings) ? 0.0 : edge;
}

HiddenIntervals::Interval HiddenIntervals::Find(int sector, const Flags& flags)
{
  const Run run = this->FindRun(flags);
  const double top = this->GetPlace(this->Elevations - 1, sector);
  if (run.Count == 0)
  {
    // Higher, or lower, than all rays?
    if (this->IsNearInside(this->Elevations - 1, sector) && this->IsZenithInside())
    {
      return { this->Halve(sector, top, 1.0, false), 1.0 };
    }
    const double first = this->GetPlace(0, sector);
    const double edge = this->IsNearInside(0, sector) ? this->Halve(sector, 0.0, first, true) : 0.0;
    return { 0.0, edge < first / (1 << Halvings) ? 0.0 : edge };
  }
  const int last = run.First + run.Count; // the first place above
  Interval interval;
  interval.Low =
    run.First > 0 ? this->FindEdge(sector, run.First, false, flags) : this->FindRim(sector);
  interval.High = last < this->Elevations  ? this->FindEdge(sector, last, true, flags)
                  : this->IsZenithInside() ? 1.0
                                           : this->Halve(sector, top, 1.0, true);
  interval.High = std::max(interval.Low, interval.High);
  return interval;
}

bool HiddenIntervals::IsZenithInside()
{
  if (this->Zenith < 0)
  {
    this->Zenith = this->IsInside(0, 1.0) ? 1 : 0;
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
