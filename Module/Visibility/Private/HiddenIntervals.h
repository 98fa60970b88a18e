// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What is hidden, or visible, in the middle azimuths of a hidden sky's sectors. Private to the
 * module.
 */

#ifndef HiddenIntervals_h
#define HiddenIntervals_h

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace measuredbrdf
{
/**
 * Found with only a few more rays than HiddenSky::Rays: where these agree across a sector and
 * both beside it, its middle is as they are; elsewhere it is asked, and the interval's ends are
 * halved.
 *
 * Between sectors bounds are interpolated. So a sector whose interval is empty has both where
 * those of the sectors beside it would end: at the horizon, at the zenith or in its middle.
 */
class HiddenIntervals
{
public:
  static constexpr int Sectors = 16;

  /// Between two sines of elevation. What is within half a byte's step of the horizon or the zenith
  /// reaches it.
  struct Interval
  {
    double Low = 0.0;
    double High = 0.0;
    bool IsEmpty() const { return !(this->High > this->Low); }
    bool IsFromHorizon() const { return this->Low < 0.5 / 255.0; }
    bool IsToZenith() const { return this->High > 254.5 / 255.0; }
  };

  using Offset = std::function<double(int sector)>;          // of rays in their strata, 0 to 1
  using Test = std::function<bool(int sector, double sine)>; // whether a sector's middle is hidden

  /// hidden: of the rays, so many elevations each sector.
  HiddenIntervals(
    const std::vector<char>& hidden, int elevations, const Offset& offset, const Test& test);

  /// Whether the intervals are what is visible, not what is hidden: of a hollow both its near side
  /// and the one opposite are hidden. The same for all sectors: whichever contradicts fewer rays of
  /// their middles, weighted by their sines.
  bool IsOpening() const { return this->Opening; }

  const Interval& Get(int sector) const
  {
    return this->Intervals[static_cast<std::size_t>(sector)];
  }

private:
  using Flags = std::vector<bool>; // of places in a sector's middle: whether they are inside

  struct Run
  {
    int First = 0;
    int Count = 0;
    double Misfit = 0.0; // of places, by their sines
  };

  double GetPlace(int k, int sector) const;
  bool IsInside(int sector, double sine) const;
  int CountHidden(int k, int sector) const;
  bool IsNearInside(int k, int sector) const;
  Flags FindFlags(int sector) const;
  Run FindRun(const Flags& flags) const;
  double Halve(int sector, double from, double to, bool insideBelow) const;
  double FindEdge(int sector, int k, bool insideBelow, const Flags& flags) const;
  double FindRim(int sector) const;
  Interval Find(int sector, const Flags& flags);
  bool IsZenithInside();
  void PlaceEmpty();

  const std::vector<char>& Hidden;
  int Elevations;
  Offset PlaceInStratum;
  Test IsHidden;
  bool Opening = false;
  int Zenith = -1; // whether it is inside; unknown
  std::array<Interval, Sectors> Intervals;
};
} // namespace measuredbrdf

#endif
