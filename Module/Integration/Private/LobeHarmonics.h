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
#include "LobeViews.h"

#include <glm/glm.hpp>

#include <complex>
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
  LobeKernel() = default;

  /// resolution: nodes over theta_i. As many over phi_i in [0, pi], of means of both sides of the
  /// plane of incidence, with weights for both; or twice as many over [-pi, pi].
  LobeKernel(vtkBRDF* brdf, const glm::dvec3& o, int resolution, int cells, bool isSymmetric);

  LobeMeans Means;
  glm::dvec3 Sum = glm::dvec3(0.0); // of the rest over the nodes, which see less of a sharp lobe
  std::vector<LobeNode> Polar;
  std::vector<LobeNode> Azimuths;
  std::vector<glm::dvec3> Rest; // at (polar, azimuth)

  ///@{
  /// Nodes take most of the memory; what was expanded, and the means, stay without them.
  bool HasNodes() const { return !this->Rest.empty(); }
  void ForgetNodes();
  ///@}

  /// The rest outside of the LampWindow about the axis at delta, in the same unit: ExpandLobes
  /// divides it by the whole rest's integral.
  LobeKernel GetOutside(double delta) const;
};

/// A kernel in the frame whose z is (-sin delta, 0, cos delta) and whose x lies in the plane of
/// incidence on o's side, once the sample is turned by -Azimuth about its normal.
struct TurnedLobe
{
  const LobeKernel* Kernel;
  double Delta;
  double Azimuth = 0.0;
  bool IsOdd = false; // its part that is odd in the azimuth, not the even one
};

/**
 * b_lk = integral of rest x Y*_lk / integral of rest, over the hemisphere, for l <= degree and
 * 0 <= k <= orders, at (3 k + channel) (degree + 1) + l of each lobe. They are real where the plane
 * of incidence is a mirror: the odd part is 0 then (what measured data of isotropic materials break
 * of that is averaged out). Else they are those of the even part, less i times those of the odd
 * one. On several threads.
 */
std::vector<std::vector<float>> ExpandLobes(
  const std::vector<TurnedLobe>& lobes, int degree, int orders);

/**
 * The same of kernels without a plane of symmetry, scaled to the rest's directional albedo, in the
 * frame whose z is the lobe's axis and whose x is the tangent, carried from the normal to the axis
 * by the smallest rotation.
 */
std::vector<std::vector<std::complex<float>>> ExpandAnisotropicLobes(
  const std::vector<LobeKernel>& kernels, int degree, int orders);
} // namespace measuredbrdf

#endif
