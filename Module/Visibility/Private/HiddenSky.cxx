// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HiddenSky.h"

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

// What a degree of the light makes of irradiance (Ramamoorthi, Hanrahan 2001, eq. 8); the higher
// ones make less than 1 %.
constexpr double CosineBand[] = { Pi, 2.0 * Pi / 3.0, Pi / 4.0 };

// Lobes narrower than this do not feel what the sky beside them is like.
constexpr double CorrelationKappa = 12.0;
constexpr double LargestOdds = 50.0;

// Cosines of elevation of a lobe's nodes: whole steps apart, so that the shader makes the
// exponentials of a sector by multiplication. Their sines are within 0.006 of the middles of even
// steps.
constexpr double NodeCosine = 0.3948;
constexpr double NodeStep = 0.0301;
constexpr int NodeSteps[HiddenSky::Elevations] = { 20, 19, 17, 14, 9, 0 };

// Of elevations. The tangent below which a plane through a point hides the sky is a cosine of the
// azimuth: so tangents are interpolated between sectors. Nearly tangents: these end at 5, so that a
// bound at the zenith does not decide alone.
constexpr double Steepness = 0.96;
double GetTangent(double sine) { return sine / std::sqrt(1.0 - Steepness * sine * sine); }
double GetSine(double tangent) { return tangent / std::sqrt(1.0 + Steepness * tangent * tangent); }

constexpr double SectorWidth = 2.0 * Pi / HiddenSky::Sectors;

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
}

void HiddenSky::PackNormal(const glm::dvec3& normal, std::uint8_t bytes[3])
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

glm::dvec3 HiddenSky::UnpackNormal(const std::uint8_t bytes[3])
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

HiddenSky::Code HiddenSky::MakeOpen(const glm::dvec3& normal)
{
  Code code{};
  PackNormal(normal, code.data());
  std::fill(code.begin() + SectorBytes, code.end(), static_cast<std::uint8_t>(OpenTransfer));
  return code;
}

HiddenSky::Rays::Rays(int elevations)
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

glm::dvec3 HiddenSky::Rays::Make(int sector, double across, double z)
{
  const double azimuth = GetAzimuth(sector) + across * SectorWidth;
  const double sine = std::sqrt(std::max(1.0 - z * z, 0.0));
  return { sine * std::cos(azimuth), sine * std::sin(azimuth), z };
}

double HiddenSky::Rays::GetOffset(int sector)
{
  return ReverseBits(static_cast<unsigned>(sector)) + 0.5 / Sectors;
}

double HiddenSky::Rays::GetSolidAngle() const { return 2.0 * Pi / (Sectors * this->Elevations); }

HiddenSky::Code HiddenSky::Encode(
  const glm::dvec3& normal, const Rays& rays, const std::vector<char>& hidden, const Test& test)
{
  Code code = MakeOpen(normal);
  const glm::dmat3 frame = FrameAbout(UnpackNormal(code.data()));
  const int elevations = rays.GetElevations();
  const HiddenIntervals intervals(hidden, elevations, Rays::GetOffset,
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

HiddenSky::HiddenSky(const Code& code)
  : Frame(FrameAbout(UnpackNormal(code.data())))
{
  int span = 0;
  double inSectors = 0.0;
  for (std::size_t s = 0; s < Sectors; ++s)
  {
    this->Low[s] = code[3 + 2 * s] / 255.0;
    this->High[s] = code[4 + 2 * s] / 255.0;
    span += code[4 + 2 * s] - code[3 + 2 * s];
    inSectors += (this->High[s] * this->High[s] - this->Low[s] * this->Low[s]) / Sectors;
  }
  if (span < 0)
  {
    this->Opening = true;
    std::swap(this->Low, this->High);
    inSectors += 1.0;
  }
  for (std::size_t s = 0; s < Sectors; ++s)
  {
    this->High[s] = std::max(this->High[s], this->Low[s]); // of damaged codes: empty
  }
  for (std::size_t j = 0; j < sky::Harmonics; ++j)
  {
    this->Transfer[j] = (code[SectorBytes + j] - OpenTransfer) * TransferStep;
  }
  this->Trust = std::clamp(this->GetHiddenCosine() / std::max(inSectors, 1e-6), 0.0, 1.0);
}

double HiddenSky::GetHiddenCosine() const
{
  return std::clamp(this->Transfer[0] * std::sqrt(4.0 * Pi) / Pi, 0.0, 1.0);
}

glm::dvec3 HiddenSky::GetHiddenIrradiance(const sky::Colors& light) const
{
  glm::dvec3 sum(0.0);
  for (std::size_t j = 0; j < sky::Harmonics; ++j)
  {
    sum += this->Transfer[j] * light[j];
  }
  return glm::max(sum, glm::dvec3(0.0));
}

double HiddenSky::GetHiddenShare(const glm::dvec3& slope) const
{
  const glm::dvec3 local = ToLocal(this->Frame, slope);
  const double kappa = glm::length(slope);
  double inside = 0.0;
  double all = 0.0;
  for (std::size_t s = 0; s < Sectors; ++s)
  {
    const double azimuth = GetAzimuth(static_cast<int>(s));
    const double across = local.x * std::cos(azimuth) + local.y * std::sin(azimuth);
    const double low = this->Low[s] * Elevations;
    const double high = this->High[s] * Elevations;
    for (int e = 0; e < Elevations; ++e)
    {
      const double cosine = NodeCosine + NodeStep * NodeSteps[e];
      const double sine = std::sqrt(1.0 - cosine * cosine);
      const double weight =
        (e + 0.5) / Elevations * std::exp(across * cosine + local.z * sine - kappa);
      all += weight;
      inside += weight * (std::clamp(high - e, 0.0, 1.0) - std::clamp(low - e, 0.0, 1.0));
    }
  }
  const double share = std::clamp(inside / std::max(all, 1e-30), 0.0, 1.0);
  return this->Opening ? 1.0 - share : share;
}

HiddenSky::Interval HiddenSky::GetBounds(const glm::dvec3& local, double last) const
{
  const double sine = std::max(std::hypot(local.x, local.y), 1e-6);
  double sum = 0.0;
  double low = 0.0;
  double high = 0.0;
  for (std::size_t s = 0; s < Sectors; ++s)
  {
    const double azimuth = GetAzimuth(static_cast<int>(s));
    const double cosine =
      (local.x * std::cos(azimuth) + local.y * std::sin(azimuth)) / sine; // of the azimuths
    const double weight = std::max(cosine - last, 0.0);
    sum += weight;
    low += weight * GetTangent(this->Low[s]);
    high += weight * GetTangent(this->High[s]);
  }
  sum = std::max(sum, 1e-6);
  return { GetSine(low / sum), GetSine(high / sum) };
}

double HiddenSky::GetLampMargin(const glm::dvec3& direction) const
{
  const glm::dvec3 local = ToLocal(this->Frame, direction);
  const Interval bounds = this->GetBounds(local, std::cos(SectorWidth));
  constexpr double edge = 0.04; // sine of elevation: half a stratum of the rays or so
  if (bounds.IsEmpty())
  {
    return this->Opening ? -LargestMargin : LargestMargin;
  }
  const double below = bounds.IsFromHorizon() ? -LargestMargin : (bounds.Low - local.z) / edge;
  const double above = bounds.IsToZenith() ? -LargestMargin : (local.z - bounds.High) / edge;
  const double outside = std::clamp(std::max(below, above), -LargestMargin, LargestMargin);
  return this->Opening ? -outside : outside;
}

double HiddenSky::GetVisibleLamp(const glm::dvec3& direction) const
{
  return std::clamp(this->GetLampMargin(direction) + 0.5, 0.0, 1.0);
}

double HiddenSky::GetHiddenPanel(const glm::dvec3& direction, double radius) const
{
  return this->GetHiddenPanel(direction, radius, radius, 0.0);
}

double HiddenSky::GetHiddenPanel(
  const glm::dvec3& direction, double radius, double seenRadius, double rise) const
{
  const glm::dvec3 local = ToLocal(this->Frame, direction);
  const double sine = std::max(std::hypot(local.x, local.y), 1e-6);
  // Above the horizon.
  const auto ends = [sine](double z, double extent) -> Interval
  {
    const double half = std::max(extent * sine, 0.03);
    const double low = std::max(z - half, 0.0);
    return { low, std::max(std::min(z + half, 1.0), low) };
  };
  // Azimuths that it covers, if more than a sector: about the zenith all of them alike.
  const double width = std::max(std::max(radius, 0.04) / std::max(sine, 1e-3), SectorWidth);
  const double last = std::cos(std::min(width, Pi)) - std::max(width - Pi, 0.0);
  Interval bounds = this->GetBounds(local, last);
  const Interval own = ends(local.z, radius);
  if (width > SectorWidth)
  {
    const double covered = this->GetCovered(local, last, own);
    const double top = std::sqrt(glm::mix(own.Low * own.Low, own.High * own.High, covered));
    const double wide = 1.0 - SectorWidth / width;
    bounds = { glm::mix(bounds.Low, own.Low, wide), glm::mix(bounds.High, top, wide) };
  }
  const Interval seen = ends(local.z + rise, seenRadius);
  double low = seen.Low;
  double high = this->Opening ? seen.High : seen.Low;
  if (!bounds.IsEmpty())
  {
    // The edge that is nearer to its middle, moved by what of the panel lies beyond the other one.
    const bool isRoof = !bounds.IsFromHorizon() &&
                        (bounds.IsToZenith() || local.z < 0.5 * (bounds.Low + bounds.High));
    const auto square = [](double x) { return x * x; };
    const double edge =
      std::sqrt(isRoof ? square(bounds.Low) + std::max(square(own.High) - square(bounds.High), 0.0)
                       : square(bounds.High) - std::max(square(bounds.Low) - square(own.Low), 0.0));
    const bool isHiddenAbove = isRoof != this->Opening;
    low = isHiddenAbove ? std::clamp(edge, seen.Low, seen.High) : seen.Low;
    high = isHiddenAbove ? seen.High : std::clamp(edge, seen.Low, seen.High);
  }
  const double all = seen.High * seen.High - seen.Low * seen.Low;
  return this->Trust * (high * high - low * low) / std::max(all, 1e-6);
}

// Share of the irradiance between two sines of elevation that is within the bounds of sectors about
// an azimuth.
double HiddenSky::GetCovered(const glm::dvec3& local, double last, const Interval& ends) const
{
  const double sine = std::max(std::hypot(local.x, local.y), 1e-6);
  double sum = 0.0;
  double inside = 0.0;
  for (std::size_t s = 0; s < Sectors; ++s)
  {
    const double azimuth = GetAzimuth(static_cast<int>(s));
    const double cosine = (local.x * std::cos(azimuth) + local.y * std::sin(azimuth)) / sine;
    const double weight = std::max(cosine - last, 0.0);
    sum += weight;
    const double low = std::clamp(this->Low[s], ends.Low, ends.High);
    const double high = std::clamp(this->High[s], ends.Low, ends.High);
    inside += weight * (high * high - low * low);
  }
  const double all = sum * (ends.High * ends.High - ends.Low * ends.Low);
  return std::clamp(inside / std::max(all, 1e-6), 0.0, 1.0);
}

glm::dvec3 HiddenSky::GetHiddenLight(double hiddenShare, double kappa,
  const glm::dvec3& hiddenIrradiance, const glm::dvec3& irradiance) const
{
  const double cosine = this->GetHiddenCosine();
  const double power = 1.0 / (1.0 + kappa / CorrelationKappa);
  glm::dvec3 result(hiddenShare);
  for (int c = 0; c < 3; ++c)
  {
    const double share =
      std::clamp(hiddenIrradiance[c] / std::max(irradiance[c], 1e-30), 0.0, 0.999);
    const double odds = share * (1.0 - cosine) / std::max((1.0 - share) * cosine, 1e-6);
    const double factor = std::pow(std::clamp(odds, 1.0 / LargestOdds, LargestOdds), power);
    const double seen = std::max(1.0 - hiddenShare, 0.0);
    result[c] = hiddenShare * factor / std::max(hiddenShare * factor + seen, 1e-12);
  }
  return result;
}

glm::dvec3 sky::GetIrradiance(const Colors& light, const glm::dvec3& normal)
{
  const Values values = Evaluate(normal);
  glm::dvec3 sum(0.0);
  for (int l = 0; l <= 2; ++l)
  {
    for (int m = 0; m < 2 * l + 1; ++m)
    {
      const auto at = static_cast<std::size_t>(l * l + m);
      sum += CosineBand[l] * values[at] * light[at];
    }
  }
  return glm::max(sum, glm::dvec3(0.0));
}
} // namespace measuredbrdf
