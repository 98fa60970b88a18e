// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What comes back to a point of a surface from what hides the sky from it, in 9 bytes: the
 * irradiance after one bounce as a linear function of the light's harmonics of degree 0 to 2, if
 * all that hides is matte and white (Sloan, Kautz, Snyder 2002, interreflected transfer). Times the
 * albedo it is that of other materials. GLSL twin: shaders/vtkBRDFBouncedLight.glsl. Private to the
 * module.
 *
 * The first byte is the root of the part that uniform light has; the others are relative to it, so
 * that faint light is as fine as strong light.
 */

#ifndef BouncedLight_h
#define BouncedLight_h

#include "HiddenSky.h"
#include "SkyHarmonics.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace measuredbrdf
{
class BouncedLight
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

  /// A code to evaluate.
  explicit BouncedLight(const Code& code);

  const Transfer& GetTransfer() const { return this->Values; }

  /// Irradiance for an albedo of 1, from light of these harmonics in the surface's axes; never
  /// negative.
  glm::dvec3 GetIrradiance(const sky::Colors& light) const;

  /// The irradiance that a point with this code has from the sky, as a linear function of the
  /// light's first harmonics; uniform: that of a uniform sky of radiance 1, which is at most pi.
  static Transfer GetVisible(const HiddenSky::Code& code);

private:
  Transfer Values;
};
} // namespace measuredbrdf

#endif
