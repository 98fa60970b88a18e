// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What of the sky a surface hides from a point, and what it sends back, in a few bytes.
 */

#ifndef HorizonCode_h
#define HorizonCode_h

#include "SkyHarmonics.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace measuredbrdf
{
/**
 * The horizon code of a point: what of the sky is hidden from it, in 60 bytes.
 * shaders/vtkBRDFHiddenSky.glsl evaluates it.
 *
 * - A normal (3 bytes): the code's frame is FrameAbout(normal).
 * - 16 sectors of azimuth (2 bytes each): two sines of elevation in the sector's middle. Where the
 *   second bytes of all sectors sum to no less than the first ones, the sky is hidden from the
 *   first sine to the second. Otherwise it is visible from the second to the first, an opening: of
 *   a hollow both the near wall and the one opposite hide.
 * - 25 spherical harmonics, in the surface's own axes, of the hidden part of cos theta (1 byte
 *   each): their product with the light's harmonics is the hidden irradiance (Sloan, Kautz, Snyder
 *   2002), exact as far as the light's harmonics reach.
 *
 * Errors of this and of other forms: docs/methods/self-occlusion.md.
 */
class HorizonCode
{
public:
  static constexpr int Sectors = 16;
  static constexpr int SectorBytes = 3 + 2 * Sectors; // with the normal
  static constexpr int TransferBytes = static_cast<int>(sky::Harmonics);
  static constexpr int Bytes = SectorBytes + TransferBytes;
  static constexpr int OpenTransfer = 127;                    // the byte for 0
  static constexpr double TransferStep = 1.05 / OpenTransfer; // largest: 2 pi / 3 sqrt(3 / 4 pi)
  using Code = std::array<std::uint8_t, Bytes>;

  /// Of a point that sees all of its sky.
  static Code MakeOpen(const glm::dvec3& normal);

  ///@{
  /// The normal that a code keeps of this one: 12 bits for each side of the octahedron.
  static void PackNormal(const glm::dvec3& normal, std::uint8_t bytes[3]);
  static glm::dvec3 UnpackNormal(const std::uint8_t bytes[3]);
  ///@}

  /// Share of pi that is hidden: of the irradiance from a uniform sky, 0 to 1.
  static double GetHiddenCosine(const Code& code);

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

  /// Rays of equal solid angle about a normal: in each sector so many, from the horizon up. In the
  /// code's frame; ray k of sector s is number s * elevations + k.
  class Rays
  {
  public:
    explicit Rays(int elevations);
    int GetElevations() const { return this->Elevations; }
    const std::vector<glm::dvec3>& GetDirections() const { return this->Directions; }
    double GetSolidAngle() const;

    /// Its middle and across (in widths of a sector) give the azimuth; z: sine of elevation.
    static glm::dvec3 Make(int sector, double across, double z);

    /// Where a sector's rays lie in their strata of elevation, 0 to 1: sectors differ, so that
    /// errors do not add up.
    static double GetOffset(int sector);

  private:
    int Elevations;
    std::vector<glm::dvec3> Directions;
  };

  /// Whether a direction of the code's frame is hidden.
  using Test = std::function<bool(const glm::dvec3& direction)>;

  /// The code of a point, of which of the rays are hidden (not 0). test: a few rays more, between
  /// hidden and visible ones.
  static Code Encode(
    const glm::dvec3& normal, const Rays& rays, const std::vector<char>& hidden, const Test& test);

  ///@{
  /// What evaluates codes keeps to these: the largest concentration of a lobe (sectors are no
  /// narrower), and how far a lamp is from a shadow's edge at most, in widths of the edge.
  static constexpr double LargestKappa = 60.0;
  static constexpr double LargestMargin = 3.0;
  ///@}
};

/**
 * What comes back to a point from what hides the sky from it, in 9 bytes: the irradiance after one
 * bounce as a linear function of the light's harmonics of degree 0 to 2, if all that hides is matte
 * and white (Sloan, Kautz, Snyder 2002, interreflected transfer). Times the albedo it is that of
 * other materials. shaders/vtkBRDFBouncedLight.glsl evaluates it.
 *
 * The first byte is the root of the part that uniform light has; the others are relative to it, so
 * that faint light is as fine as strong light.
 */
class BounceCode
{
public:
  static constexpr std::size_t Harmonics = 9; // degree 2: the next two degrees gain little
  static constexpr int Bytes = static_cast<int>(Harmonics);
  static constexpr int Middle = 127;                 // the byte for 0, but for the first
  static constexpr double RatioStep = 2.25 / Middle; // light from one direction: sqrt(5) at most
  static constexpr double RootStep = 0.9415 / 255.0; // first harmonic of cos theta: 0.9413^2
  using Code = std::array<std::uint8_t, Bytes>;
  using Transfer = std::array<double, Harmonics>;

  /// Of a point that nothing comes back to.
  static Code MakeDark();

  static Code Encode(const Transfer& transfer);

  /// The irradiance that a point with this horizon code has from the sky, as a linear function of
  /// the light's first harmonics; uniform: that of a uniform sky of radiance 1, at most pi.
  static Transfer GetVisible(const HorizonCode::Code& code);
};
} // namespace measuredbrdf

#endif
