// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HorizonCode.h"

#include "HalfVector.h" // for Pi
#include "LocalFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int NormalSteps = 4096; // of each side of the octahedron
constexpr int Halvings = 3;       // of a stratum of elevation

constexpr double SectorWidth = 2.0 * Pi / HorizonCode::Sectors;

double GetAzimuth(int sector) { return SectorWidth * sector; }

// Base 2, from the last bit on (van der Corput).
double ReverseBits(unsigned k)
{
  double value = 0.0;
  for (double place = 0.5; k > 0; k >>= 1, place *= 0.5)
  {
    value += (k & 1u) ? place : 0.0;
  }
  return value;
}

/**
 * What is hidden, or visible, in the middle azimuths of a code's sectors.
 *
 * Found with only a few more rays than HorizonCode::Rays: where these agree across a sector and
 * both beside it, its middle is as they are; elsewhere it is asked, and the interval's ends are
 * halved.
 *
 * Between sectors bounds are interpolated. So a sector whose interval is empty has both where
 * those of the sectors beside it would end: at the horizon, at the zenith or in its middle.
 */
class SectorIntervals
{
public:
  static constexpr int Sectors = HorizonCode::Sectors;

  using Interval = HorizonCode::Interval;
  using Test = std::function<bool(int sector, double sine)>; // whether a sector's middle is hidden

  /// hidden: of the rays, so many elevations each sector.
  SectorIntervals(const std::vector<char>& hidden, int elevations, const Test& test)
    : Hidden(hidden)
    , Elevations(elevations)
    , IsHidden(test)
  {
    std::array<Flags, Sectors> flags;
    double misfit[2] = { 0.0, 0.0 };
    for (int s = 0; s < Sectors; ++s)
    {
      flags[s] = this->FindFlags(s);
      misfit[0] += this->FindRun(flags[s]).Misfit;
      Flags visible = flags[s];
      visible.flip();
      misfit[1] += this->FindRun(visible).Misfit;
    }
    this->Opening = misfit[1] < misfit[0];
    for (int s = 0; s < Sectors; ++s)
    {
      if (this->Opening)
      {
        flags[s].flip();
      }
      this->Intervals[s] = this->Find(s, flags[s]);
    }
    this->PlaceEmpty();
  }

  /// Whether the intervals are what is visible, not what is hidden: of a hollow both its near side
  /// and the one opposite are hidden. The same for all sectors: whichever contradicts fewer rays of
  /// their middles, weighted by their sines.
  bool IsOpening() const { return this->Opening; }

  const Interval& Get(int sector) const { return this->Intervals[sector]; }

private:
  using Flags = std::vector<bool>; // of places in a sector's middle: whether they are inside

  struct Run
  {
    int First = 0;
    int Count = 0;
    double Misfit = 0.0; // of places, by their sines
  };

  double GetPlace(int k, int sector) const
  {
    return (k + HorizonCode::Rays::GetOffset(sector)) / this->Elevations;
  }

  bool IsInside(int sector, double sine) const
  {
    return this->IsHidden(sector, sine) != this->Opening;
  }

  // How many of the rays of an elevation, of the sector and both beside it, are hidden.
  int CountHidden(int k, int sector) const
  {
    int count = 0;
    for (int s = sector - 1; s <= sector + 1; ++s)
    {
      const int turn = (s + Sectors) % Sectors;
      count += this->Hidden[turn * this->Elevations + k] ? 1 : 0;
    }
    return count;
  }

  // Whether any of these is inside.
  bool IsNearInside(int k, int sector) const
  {
    const int count = this->CountHidden(k, sector);
    return this->Opening ? count < 3 : count > 0;
  }

  // The middle is asked only where the rays about it do not agree.
  Flags FindFlags(int sector) const
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
  Run FindRun(const Flags& flags) const
  {
    const auto isInside = [&flags](int k) { return flags[k] ? 1 : 0; };
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
  double Halve(int sector, double from, double to, bool insideBelow) const
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
  double FindEdge(int sector, int k, bool insideBelow, const Flags& flags) const
  {
    const auto at = static_cast<std::size_t>(k);
    const double from = this->GetPlace(k - 1, sector);
    const double to = this->GetPlace(k, sector);
    return flags[at - 1] == insideBelow && flags[at] != insideBelow
             ? this->Halve(sector, from, to, insideBelow)
             : 0.5 * (from + to);
  }

  // Where an opening begins whose lowest place sees the sky, though a ray beside it does not.
  double FindRim(int sector) const
  {
    const double first = this->GetPlace(0, sector);
    const bool asks = this->Opening && this->CountHidden(0, sector) > 0;
    const double edge = asks ? this->Halve(sector, 0.0, first, false) : 0.0;
    return edge < first / (1 << Halvings) ? 0.0 : edge;
  }

  Interval Find(int sector, const Flags& flags)
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
      const double edge =
        this->IsNearInside(0, sector) ? this->Halve(sector, 0.0, first, true) : 0.0;
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

  bool IsZenithInside()
  {
    if (this->Zenith < 0)
    {
      this->Zenith = this->IsInside(0, 1.0) ? 1 : 0;
    }
    return this->Zenith == 1;
  }

  void PlaceEmpty()
  {
    const auto found = this->Intervals;
    const double zenith = this->Zenith == 1 ? 1.0 : 0.0; // where sectors beside it do not tell
    for (int s = 0; s < Sectors; ++s)
    {
      Interval& interval = this->Intervals[s];
      double sum = 0.0;
      int count = 0;
      for (const int other : { s + Sectors - 1, s + 1 })
      {
        const Interval& beside = found[other % Sectors];
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

  const std::vector<char>& Hidden;
  int Elevations;
  Test IsHidden;
  bool Opening = false;
  int Zenith = -1; // whether it is inside; unknown
  std::array<Interval, Sectors> Intervals;
};
}

void HorizonCode::PackNormal(const glm::dvec3& normal, std::uint8_t bytes[3])
{
  const glm::dvec3 n = normal / (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
  glm::dvec2 p(n);
  if (n.z < 0.0)
  {
    p = { (1.0 - std::abs(n.y)) * (n.x < 0.0 ? -1.0 : 1.0),
      (1.0 - std::abs(n.x)) * (n.y < 0.0 ? -1.0 : 1.0) };
  }
  unsigned cell[2];
  for (int c = 0; c < 2; ++c)
  {
    cell[c] = static_cast<unsigned>(
      std::clamp(std::floor((0.5 * p[c] + 0.5) * NormalSteps), 0.0, NormalSteps - 1.0));
  }
  bytes[0] = static_cast<std::uint8_t>(cell[0] & 255u);
  bytes[1] = static_cast<std::uint8_t>((cell[0] >> 8u) | ((cell[1] & 15u) << 4u));
  bytes[2] = static_cast<std::uint8_t>(cell[1] >> 4u);
}

glm::dvec3 HorizonCode::UnpackNormal(const std::uint8_t bytes[3])
{
  // Every step up to the square root is exact in single precision, too: the shader sees the same
  // sign of z, which decides on the frame.
  const double u = bytes[0] + 256.0 * (bytes[1] % 16);
  const double v = bytes[1] / 16 + 16.0 * bytes[2];
  glm::dvec3 n((2.0 * u + 1.0) / NormalSteps - 1.0, (2.0 * v + 1.0) / NormalSteps - 1.0, 0.0);
  n.z = 1.0 - std::abs(n.x) - std::abs(n.y);
  if (n.z < 0.0)
  {
    n = { (1.0 - std::abs(n.y)) * (n.x < 0.0 ? -1.0 : 1.0),
      (1.0 - std::abs(n.x)) * (n.y < 0.0 ? -1.0 : 1.0), n.z };
  }
  return glm::normalize(n);
}

HorizonCode::Code HorizonCode::MakeOpen(const glm::dvec3& normal)
{
  Code code{};
  PackNormal(normal, code.data());
  std::fill(code.begin() + SectorBytes, code.end(), static_cast<std::uint8_t>(OpenTransfer));
  return code;
}

HorizonCode::Rays::Rays(int elevations)
  : Elevations(elevations)
{
  for (int s = 0; s < Sectors; ++s)
  {
    for (int k = 0; k < elevations; ++k)
    {
      const double z = (k + GetOffset(s)) / elevations;
      const double across = ReverseBits(static_cast<unsigned>(k)) - 0.5 + 0.5 / elevations;
      this->Directions.push_back(Make(s, across, z));
    }
  }
}

glm::dvec3 HorizonCode::Rays::Make(int sector, double across, double z)
{
  const double azimuth = GetAzimuth(sector) + across * SectorWidth;
  const double sine = std::sqrt(std::max(1.0 - z * z, 0.0));
  return { sine * std::cos(azimuth), sine * std::sin(azimuth), z };
}

double HorizonCode::Rays::GetOffset(int sector)
{
  return ReverseBits(static_cast<unsigned>(sector)) + 0.5 / Sectors;
}

double HorizonCode::Rays::GetSolidAngle() const { return 2.0 * Pi / (Sectors * this->Elevations); }

HorizonCode::Code HorizonCode::Encode(
  const glm::dvec3& normal, const Rays& rays, const std::vector<char>& hidden, const Test& test)
{
  Code code = MakeOpen(normal);
  const glm::dmat3 frame = FrameAbout(UnpackNormal(code.data()));
  const int elevations = rays.GetElevations();
  const SectorIntervals intervals(hidden, elevations,
    [&test](int sector, double sine) { return test(Rays::Make(sector, 0.0, sine)); });
  std::array<double, sky::Harmonics> transfer{};
  int width = 0;
  for (int s = 0; s < Sectors; ++s)
  {
    for (int k = 0; k < elevations; ++k)
    {
      const auto ray = static_cast<std::size_t>(s * elevations + k);
      if (hidden[ray])
      {
        const glm::dvec3& d = rays.GetDirections()[ray];
        const sky::Values values = sky::Evaluate(frame * d);
        for (std::size_t j = 0; j < values.size(); ++j)
        {
          transfer[j] += d.z * values[j];
        }
      }
    }
    const auto low = static_cast<std::size_t>(intervals.IsOpening() ? 4 + 2 * s : 3 + 2 * s);
    const auto high = static_cast<std::size_t>(intervals.IsOpening() ? 3 + 2 * s : 4 + 2 * s);
    code[low] = static_cast<std::uint8_t>(std::lround(255.0 * intervals.Get(s).Low));
    code[high] = static_cast<std::uint8_t>(std::lround(255.0 * intervals.Get(s).High));
    width += std::abs(code[high] - code[low]);
  }
  if (intervals.IsOpening() && width == 0) // narrower than a byte: all is hidden
  {
    for (std::size_t s = 0; s < Sectors; ++s)
    {
      code[3 + 2 * s] = 0;
      code[4 + 2 * s] = 255;
    }
  }
  for (std::size_t j = 0; j < transfer.size(); ++j)
  {
    const double step = std::round(transfer[j] * rays.GetSolidAngle() / TransferStep);
    code[SectorBytes + j] = static_cast<std::uint8_t>(std::clamp(OpenTransfer + step, 0.0, 255.0));
  }
  return code;
}

double HorizonCode::GetHiddenCosine(const Code& code)
{
  const double transfer = (code[SectorBytes] - OpenTransfer) * TransferStep;
  return std::clamp(transfer * std::sqrt(4.0 * Pi) / Pi, 0.0, 1.0);
}

BounceCode::Code BounceCode::MakeDark()
{
  Code code;
  code.fill(static_cast<std::uint8_t>(Middle));
  code[0] = 0;
  return code;
}

// Rounded down: what comes back is never more than what there is.
BounceCode::Code BounceCode::Encode(const Transfer& transfer)
{
  Code code = MakeDark();
  const double root = std::sqrt(std::max(transfer[0], 0.0));
  code[0] = static_cast<std::uint8_t>(std::clamp(std::floor(root / RootStep), 0.0, 255.0));
  for (std::size_t j = 1; code[0] > 0 && j < Harmonics; ++j)
  {
    const double step = std::round(transfer[j] / transfer[0] / RatioStep);
    code[j] = static_cast<std::uint8_t>(std::clamp(Middle + step, 0.0, 2.0 * Middle));
  }
  return code;
}

BounceCode::Transfer BounceCode::GetVisible(const HorizonCode::Code& code)
{
  const sky::Values all = sky::GetCosineTransfer(HorizonCode::UnpackNormal(code.data()));
  Transfer transfer;
  for (std::size_t j = 0; j < Harmonics; ++j)
  {
    transfer[j] = all[j] - (code[HorizonCode::SectorBytes + j] - HorizonCode::OpenTransfer) *
                             HorizonCode::TransferStep;
  }
  transfer[0] = std::clamp(transfer[0], 0.0, all[0]);
  return transfer;
}
} // namespace measuredbrdf
