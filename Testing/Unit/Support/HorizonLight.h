// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a horizon code (HorizonCode.h) does to the light that its point reflects, in C++: the
 * reference for shaders/vtkBRDFHiddenSky.glsl and vtkBRDFBouncedLight.glsl.
 */

#ifndef HorizonLight_h
#define HorizonLight_h

#include "HalfVector.h" // for Pi
#include "HorizonCode.h"
#include "LocalFrame.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
// What a degree of the light makes of irradiance (Ramamoorthi, Hanrahan 2001, eq. 8); the higher
// ones make less than 1 %.
inline constexpr double CosineBand[] = { Pi, 2.0 * Pi / 3.0, Pi / 4.0 };

// Lobes narrower than this do not feel what the sky beside them is like.
inline constexpr double CorrelationKappa = 12.0;
inline constexpr double LargestOdds = 50.0;

// Cosines of elevation of a lobe's nodes: whole steps apart, so that the shader makes the
// exponentials of a sector by multiplication. Their sines are within 0.006 of the middles of even
// steps.
inline constexpr double NodeCosine = 0.3948;
inline constexpr double NodeStep = 0.0301;
inline constexpr int NodeSteps[6] = { 20, 19, 17, 14, 9, 0 };

// Of elevations. The tangent below which a plane through a point hides the sky is a cosine of the
// azimuth: so tangents are interpolated between sectors. Nearly tangents: these end at 5, so that a
// bound at the zenith does not decide alone.
inline constexpr double Steepness = 0.96;
inline double GetTangent(double sine) { return sine / std::sqrt(1.0 - Steepness * sine * sine); }
inline double GetSine(double tangent)
{
  return tangent / std::sqrt(1.0 + Steepness * tangent * tangent);
}

inline constexpr double SectorWidth = 2.0 * Pi / HorizonCode::Sectors;

inline double GetSectorAzimuth(std::size_t sector)
{
  return SectorWidth * static_cast<double>(sector);
}

class HorizonLight : public HorizonCode
{
public:
  /// A code to evaluate.
  explicit HorizonLight(const Code& code)
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

  const glm::dvec3& GetNormal() const { return this->Frame[2]; }

  /// Share of pi that is hidden: of the irradiance from a uniform sky, 0 to 1.
  double GetHiddenCosine() const
  {
    return std::clamp(this->Transfer[0] * std::sqrt(4.0 * Pi) / Pi, 0.0, 1.0);
  }

  /// Hidden irradiance under light of these harmonics, in the surface's axes.
  glm::dvec3 GetHiddenIrradiance(const sky::Colors& light) const
  {
    glm::dvec3 sum(0.0);
    for (std::size_t j = 0; j < sky::Harmonics; ++j)
    {
      sum += this->Transfer[j] * light[j];
    }
    return glm::max(sum, glm::dvec3(0.0));
  }

  /// Hidden share, 0 to 1, of a lobe cos(theta) exp(slope . d) above the horizon; in the surface's
  /// axes, no longer than LargestKappa.
  double GetHiddenShare(const glm::dvec3& slope) const
  {
    const glm::dvec3 local = ToLocal(this->Frame, slope);
    const double kappa = glm::length(slope);
    double inside = 0.0;
    double all = 0.0;
    for (std::size_t s = 0; s < Sectors; ++s)
    {
      const double azimuth = GetSectorAzimuth(s);
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

  /// How far a small lamp in this unit direction is from what is hidden of its azimuth, in widths
  /// of a shadow's edge: positive where it is visible. No larger than LargestMargin, nor less than
  /// its negative. Between points margins are interpolated, not what is visible: shadows' edges
  /// then lie where they should across triangles.
  double GetLampMargin(const glm::dvec3& direction) const
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

  /// Visible share of the lamp at such a margin, 0 to 1.
  double GetVisibleLamp(const glm::dvec3& direction) const
  {
    return std::clamp(this->GetLampMargin(direction) + 0.5, 0.0, 1.0);
  }

  /// Hidden share, 0 to 1, of a panel about this unit direction: an even strip that reaches radius
  /// (radians) to each side. A lobe sees a part of it, which reaches seenRadius about a middle that
  /// is higher by rise (in the sine of elevation).
  double GetHiddenPanel(const glm::dvec3& direction, double radius) const
  {
    return this->GetHiddenPanel(direction, radius, radius, 0.0);
  }

  double GetHiddenPanel(
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
      // The edge that is nearer to its middle, moved by what of the panel lies beyond the other
      // one.
      const bool isRoof = !bounds.IsFromHorizon() &&
                          (bounds.IsToZenith() || local.z < 0.5 * (bounds.Low + bounds.High));
      const auto square = [](double x) { return x * x; };
      const double edge = std::sqrt(
        isRoof ? square(bounds.Low) + std::max(square(own.High) - square(bounds.High), 0.0)
               : square(bounds.High) - std::max(square(bounds.Low) - square(own.Low), 0.0));
      const bool isHiddenAbove = isRoof != this->Opening;
      low = isHiddenAbove ? std::clamp(edge, seen.Low, seen.High) : seen.Low;
      high = isHiddenAbove ? seen.High : std::clamp(edge, seen.Low, seen.High);
    }
    const double all = seen.High * seen.High - seen.Low * seen.Low;
    return this->Trust * (high * high - low * low) / std::max(all, 1e-6);
  }

  /// Hidden share of the light in a lobe, per channel: the lobe's hidden share, and where the lobe
  /// is wide, how much brighter than the rest the hidden part of the sky is. irradiance: of the
  /// whole sky of light's harmonics about the normal.
  glm::dvec3 GetHiddenLight(double hiddenShare, double kappa, const glm::dvec3& hiddenIrradiance,
    const glm::dvec3& irradiance) const
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

  static constexpr int Elevations = 6; // nodes of a lobe in each sector

private:
  // Low to High in the azimuth of a direction of the code's frame, between the sectors whose
  // azimuths' cosine to it is above last.
  Interval GetBounds(const glm::dvec3& local, double last) const
  {
    const double sine = std::max(std::hypot(local.x, local.y), 1e-6);
    double sum = 0.0;
    double low = 0.0;
    double high = 0.0;
    for (std::size_t s = 0; s < Sectors; ++s)
    {
      const double azimuth = GetSectorAzimuth(s);
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

  // Share of the irradiance between two sines of elevation that is within the bounds of sectors
  // about an azimuth.
  double GetCovered(const glm::dvec3& local, double last, const Interval& ends) const
  {
    const double sine = std::max(std::hypot(local.x, local.y), 1e-6);
    double sum = 0.0;
    double inside = 0.0;
    for (std::size_t s = 0; s < Sectors; ++s)
    {
      const double azimuth = GetSectorAzimuth(s);
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

  glm::dmat3 Frame; // columns
  std::array<double, Sectors> Low;
  std::array<double, Sectors> High;
  bool Opening = false; // what is between them is visible, not hidden
  std::array<double, sky::Harmonics> Transfer;
  // How much less the harmonics say is hidden than the sectors, whose lowest rays may hit the
  // point's own facets: 0 to 1.
  double Trust;
};

/// What comes back to a point, by its code.
class BouncedLight : public BounceCode
{
public:
  explicit BouncedLight(const Code& code)
  {
    this->Values[0] = std::pow(code[0] * RootStep, 2.0);
    for (std::size_t j = 1; j < Harmonics; ++j)
    {
      this->Values[j] = this->Values[0] * (code[j] - Middle) * RatioStep;
    }
  }

  const Transfer& GetTransfer() const { return this->Values; }

  /// Irradiance for an albedo of 1, from light of these harmonics in the surface's axes; never
  /// negative.
  glm::dvec3 GetIrradiance(const sky::Colors& light) const
  {
    glm::dvec3 sum(0.0);
    for (std::size_t j = 0; j < Harmonics; ++j)
    {
      sum += this->Values[j] * light[j];
    }
    return glm::max(sum, glm::dvec3(0.0));
  }

private:
  Transfer Values;
};

namespace sky
{
/// Irradiance about a unit normal under light of these harmonics (Ramamoorthi, Hanrahan 2001).
inline glm::dvec3 GetIrradiance(const Colors& light, const glm::dvec3& normal)
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
}
} // namespace measuredbrdf

#endif
