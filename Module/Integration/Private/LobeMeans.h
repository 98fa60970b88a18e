// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The kernel f(i,o) cos(theta_i) of one view in a few numbers.
 */

#ifndef LobeMeans_h
#define LobeMeans_h

#include <glm/glm.hpp>

namespace measuredbrdf
{
class LobeQuadrature;

/// Of a view o, which is (sin theta, 0, cos theta) for isotropic materials.
struct LobeMeans
{
  LobeMeans() = default;
  explicit LobeMeans(const LobeQuadrature& quadrature);

  /// The largest difference: of directional albedos, of the first's, or of Delta in radians.
  static double GetDistance(const LobeMeans& a, const LobeMeans& b);

  ///@{
  /// For interpolation: a weighted sum, then what it must not be.
  void Add(const LobeMeans& other, double weight);
  void Clamp();
  ///@}

  /// The Lambert part c in 1/sr: the least f up to 80 degrees.
  glm::dvec3 Floor = glm::dvec3(0.0);

  /// Directional albedo of the rest, which is 0 where it is rounding; never negative.
  glm::dvec3 Amplitude = glm::dvec3(0.0);

  ///@{
  /// The rest's mean direction, weighted by its cube so that the sharpest part of a kernel
  /// decides. Of an isotropic material it is (-sin delta, 0, cos delta); LobeViews then limits how
  /// fast its own deltas change from view to view.
  glm::dvec3 Axis = glm::dvec3(0.0);
  double Delta = 0.0;
  ///@}

  /// Directional albedo, the sum of all channels.
  double Albedo = 0.0;
};
} // namespace measuredbrdf

#endif
