// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a table of radiance needs of one view: the kernel f(i,o) cos(theta_i), less a Lambert part,
 * as spherical harmonics about the lobe's axis. Isotropic materials have their axis in the plane of
 * incidence and kernels that are symmetric about it; anisotropic ones have neither.
 */

#ifndef LobeHarmonics_h
#define LobeHarmonics_h

#include "Lamps.h"
#include "LobeQuadrature.h"

#include <glm/glm.hpp>

#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
/// Of an integral over an angle, in rad.
struct LobeNode
{
  double Angle;
  double Weight;
};

/// The kernel of a prepared BRDF seen from unit o above the horizon, less its Lambert part, at
/// nodes that crowd where it is, which so many cells tell: pairs of Gauss nodes in intervals of
/// equal energy, half of it spread evenly.
struct LobeKernel
{
  /// resolution: nodes over theta_i. As many over phi_i in [0, pi], of means of both sides of the
  /// plane of incidence, with weights for both; or twice as many over [-pi, pi].
  LobeKernel(vtkBRDF* brdf, const glm::dvec3& o, int resolution, int cells, bool isSymmetric);

  LobeMeans Means;
  glm::dvec3 Sum = glm::dvec3(0.0); // of the rest over the nodes, which see less of a sharp lobe
  std::vector<LobeNode> Polar;
  std::vector<LobeNode> Azimuths;
  std::vector<glm::dvec3> Rest; // at (polar, azimuth)
};

class LobeHarmonics
{
public:
  /// Of a prepared, isotropic BRDF seen at polar angle theta < pi/2, o = (sin theta, 0, cos theta).
  /// resolution: nodes of the integrals over theta_i and phi_i; they crowd where the kernel is,
  /// which so many cells tell.
  LobeHarmonics(vtkBRDF* brdf, double theta, int resolution, int cells)
    : Lobe(brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), resolution, cells, true)
  {
  }

  const LobeMeans& GetMeans() const { return this->Lobe.Means; }

  ///@{
  /// Nodes take most of the memory; what was expanded, and the means, stay without them.
  bool HasNodes() const { return !this->Lobe.Rest.empty(); }
  void ForgetNodes();
  ///@}

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

  LobeKernel Lobe;
};

/// The same of any material, whose kernels have no plane of symmetry.
class AnisotropicLobe
{
public:
  /// Of a prepared BRDF seen from unit o above the horizon. resolution: nodes of the integral over
  /// theta_i, twice as many over phi_i; they crowd where the kernel is.
  AnisotropicLobe(vtkBRDF* brdf, const glm::dvec3& o, int resolution)
    : Lobe(brdf, o, resolution, 512, false)
  {
  }

  const LobeMeans& GetMeans() const { return this->Lobe.Means; }

  /**
   * b_lk = integral of rest x Y*_lk, scaled to the rest's directional albedo, in the frame whose z
   * is the lobe's axis and whose x is the tangent, carried from the normal to the axis by the
   * smallest rotation, for l <= degree and 0 <= k <= orders. At (3 k + channel) (degree + 1) + l.
   */
  std::vector<std::complex<float>> Expand(int degree, int orders) const;

private:
  using Series = std::vector<std::complex<double>>;
  Series ExpandAboutNormal(int degree, double azimuth) const;

  LobeKernel Lobe;
};
} // namespace measuredbrdf

#endif
