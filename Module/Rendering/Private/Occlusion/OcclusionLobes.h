// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What hidden skies (HiddenSky.h) need to know of a material's gloss. Private to the rendering
 * room.
 */

#ifndef OcclusionLobes_h
#define OcclusionLobes_h

#include <glm/glm.hpp>

#include <array>

class vtkBRDF;

namespace measuredbrdf
{
/**
 * The kernel f cos(theta) of a material, less what the integrator reflects as a Lambert surface
 * does, as cos(theta) exp(p . d): the von Mises-Fisher lobe is f, so that the lobe ends at the
 * horizon, as the kernel does. p is the one with the kernel's mean direction, which is the most
 * likely one of an exponential family.
 */
class OcclusionLobes
{
public:
  static constexpr int Views = 16; // polar angles of the view, evenly spaced

  OcclusionLobes() = default;
  OcclusionLobes(vtkBRDF* brdf, bool withFloor);

  struct Lobe
  {
    // p is (-Across, 0, Along) seen from (sin theta, 0, cos theta).
    double Across = 0.0;
    double Along = 1.0;
    double Integral = 1.0;                // of cos(theta) exp(p . d - |p|) over the hemisphere
    double Delta = 0.0;                   // to the axis of a table's lobe, as LobeMeans has it
    glm::dvec3 Lambert = glm::dvec3(0.0); // what is left out, in 1/sr
    glm::dvec3 Albedo = glm::dvec3(0.0);  // directional, of the lobe

    /// p of a surface's normal, seen from a unit direction.
    glm::dvec3 GetSlope(const glm::dvec3& normal, const glm::dvec3& view) const;

    /// The axis about which a table has the lobe: unit.
    glm::dvec3 GetAxis(const glm::dvec3& normal, const glm::dvec3& view) const;

    /// A lamp's radiance in the lobe over its irradiance; unit directions.
    double GetShine(
      const glm::dvec3& normal, const glm::dvec3& slope, const glm::dvec3& lamp) const;
  };
  /// Between the two nearest views.
  Lobe Get(double cosine) const;
  const std::array<Lobe, Views>& GetLobes() const { return this->Lobes; }

private:
  std::array<Lobe, Views> Lobes;
};
} // namespace measuredbrdf

#endif
