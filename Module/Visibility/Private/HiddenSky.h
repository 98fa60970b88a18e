// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What of the sky is hidden from a point of a surface, in 60 bytes, and what that does to the light
 * that the point reflects. GLSL twin: shaders/vtkBRDFHiddenSky.glsl. Private to the module.
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

#ifndef HiddenSky_h
#define HiddenSky_h

#include "HiddenIntervals.h"
#include "SkyHarmonics.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace measuredbrdf
{
class HiddenSky
{
public:
  using Interval = HiddenIntervals::Interval;
  static constexpr int Sectors = HiddenIntervals::Sectors;
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

  /// A code to evaluate.
  explicit HiddenSky(const Code& code);

  const glm::dvec3& GetNormal() const { return this->Frame[2]; }

  /// Share of pi that is hidden: of the irradiance from a uniform sky, 0 to 1.
  double GetHiddenCosine() const;

  /// Hidden irradiance under light of these harmonics, in the surface's axes.
  glm::dvec3 GetHiddenIrradiance(const sky::Colors& light) const;

  /// Hidden share, 0 to 1, of a lobe cos(theta) exp(slope . d) above the horizon; in the surface's
  /// axes, no longer than LargestKappa.
  double GetHiddenShare(const glm::dvec3& slope) const;

  /// How far a small lamp in this unit direction is from what is hidden of its azimuth, in widths
  /// of a shadow's edge: positive where it is visible. No larger than LargestMargin, nor less than
  /// its negative. Between points margins are interpolated, not what is visible: shadows' edges
  /// then lie where they should across triangles.
  double GetLampMargin(const glm::dvec3& direction) const;
  static constexpr double LargestMargin = 3.0;

  /// Visible share of the lamp at such a margin, 0 to 1.
  double GetVisibleLamp(const glm::dvec3& direction) const;

  /// Hidden share, 0 to 1, of a panel about this unit direction: an even strip that reaches radius
  /// (radians) to each side. A lobe sees a part of it, which reaches seenRadius about a middle that
  /// is higher by rise (in the sine of elevation).
  ///@{
  double GetHiddenPanel(const glm::dvec3& direction, double radius) const;
  double GetHiddenPanel(
    const glm::dvec3& direction, double radius, double seenRadius, double rise) const;
  ///@}

  /// Hidden share of the light in a lobe, per channel: the lobe's hidden share, and where the lobe
  /// is wide, how much brighter than the rest the hidden part of the sky is. irradiance: of the
  /// whole sky of light's harmonics about the normal.
  glm::dvec3 GetHiddenLight(double hiddenShare, double kappa, const glm::dvec3& hiddenIrradiance,
    const glm::dvec3& irradiance) const;

  /// Concentrations are no larger: sectors are no narrower.
  static constexpr double LargestKappa = 60.0;
  static constexpr int Elevations = 6; // nodes of a lobe in each sector

private:
  // Low to High in the azimuth of a direction of the code's frame, between the sectors whose
  // azimuths' cosine to it is above last.
  Interval GetBounds(const glm::dvec3& local, double last) const;
  double GetCovered(const glm::dvec3& local, double last, const Interval& ends) const;

  glm::dmat3 Frame; // columns
  std::array<double, Sectors> Low;
  std::array<double, Sectors> High;
  bool Opening = false; // what is between them is visible, not hidden
  std::array<double, sky::Harmonics> Transfer;
  // How much less the harmonics say is hidden than the sectors, whose lowest rays may hit the
  // point's own facets: 0 to 1.
  double Trust;
};

namespace sky
{
/// Irradiance about a unit normal under light of these harmonics (Ramamoorthi, Hanrahan 2001).
glm::dvec3 GetIrradiance(const Colors& light, const glm::dvec3& normal);
}
} // namespace measuredbrdf

#endif
