// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a table of radiance needs of one view angle: the kernel f(i,o) cos(theta_i), less a Lambert
 * part, as spherical harmonics about an axis in the plane of incidence.
 */

#ifndef LobeHarmonics_h
#define LobeHarmonics_h

#include "LampWindow.h"
#include "LobeMeans.h"
#include "LobeNodes.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <utility>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class LobeHarmonics
{
public:
  /// Of a prepared, isotropic BRDF seen at polar angle theta < pi/2, o = (sin theta, 0, cos theta).
  /// resolution: nodes of the integrals over theta_i and phi_i; they crowd where the kernel is,
  /// which so many cells tell.
  LobeHarmonics(vtkBRDF* brdf, double theta, int resolution, int cells);

  const LobeMeans& GetMeans() const { return this->Means; }

  ///@{
  /// Nodes take most of the memory; what was expanded, and the means, stay without them.
  bool HasNodes() const { return !this->Kernel.empty(); }
  void ForgetNodes();
  ///@}

  /// On the heap, about.
  std::size_t GetBytes() const
  {
    return sizeof(*this) + this->Kernel.capacity() * sizeof(glm::dvec3) +
           (this->Polar.capacity() + this->Azimuths.capacity()) * sizeof(LobeNode);
  }

  /// The rest outside of a window about the axis at delta, in the same unit: Expand divides it by
  /// the whole rest's integral.
  LobeHarmonics GetOutside(const LampWindow& window, double delta) const;

  /**
   * b_lk = integral of rest x Y*_lk / integral of rest, over the hemisphere, in the frame whose z
   * is (-sin delta, 0, cos delta) and whose x lies in the plane of incidence on o's side, for l <=
   * degree and 0 <= k <= orders; real, since the plane of incidence is taken as a mirror (what
   * measured data break of that is averaged out). At (3 k + channel) (degree + 1) + l, for each of
   * the lobes with its delta. On several threads.
   */
  static std::vector<std::vector<float>> Expand(
    const std::vector<std::pair<const LobeHarmonics*, double>>& lobes, int degree, int orders);

private:
  struct Lanes;

  static std::vector<std::vector<float>> ExpandLanes(
    const std::vector<Lanes>& blocks, int degree, int orders, std::size_t count);
  std::vector<float> SumAzimuths(std::size_t orders) const;

  LobeMeans Means;
  glm::dvec3 Sum = glm::dvec3(0.0); // the rest over the nodes, which see less of a sharp lobe
  std::vector<LobeNode> Polar;
  std::vector<LobeNode> Azimuths; // over [0, pi], weights for both sides
  std::vector<glm::dvec3> Kernel; // rest at (polar, azimuth), mean of both sides
};
} // namespace measuredbrdf

#endif
