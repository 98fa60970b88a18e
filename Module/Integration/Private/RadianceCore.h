// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a smoothed table of radiance lacks of sharp lobes, factored: the kernels' harmonics about
 * the lobe's axis, less what the blur leaves, are decomposed by singular values for each azimuthal
 * order, weighted by what the environment's degrees make of them. Each mode is a function about the
 * axis, convolved with the environment once, times a weight over theta_o:
 *
 *   T(axis, theta_o, psi) = sum_k W_k(theta_o) (cos(m_k psi) A_k(axis) + sin(m_k psi) B_k(axis))
 *
 * This is the thesis's pair of textures, coefficients and functions, with the light in one of them.
 * Private to the module.
 */

#ifndef RadianceCore_h
#define RadianceCore_h

#include "EnvironmentHarmonics.h"
#include "LobeViews.h"
#include "MaterialPrecomputation.h"

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace measuredbrdf
{
struct RadianceCore
{
  explicit RadianceCore(int rows)
    : Rows(rows)
    , Columns(2 * (rows - 1))
  {
  }

  int Rows; // poles included
  int Columns;
  std::vector<int> Orders;    // m of each mode, ascending
  std::vector<float> Profile; // RGB, ProfileSize x (1 + modes): (0, cos, sin delta); W_k
  std::vector<float> Fields;  // RGB, Columns x Rows x fields: A_k and, for m > 0, B_k

  int GetNumberOfFields() const;

  /// Radiance, of either sign, towards o about the normal n, as the shader looks it up; t: a unit
  /// tangent or zero.
  glm::dvec3 Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const;

  /// Of kernels at evenly spaced view angles, what is above a blur (GetSmoothed), by at most so
  /// many fields. goOn gets the share that is done; where it says false, so does this.
  bool Make(const EnvironmentHarmonics& environment, const LobeViews& views,
    const MaterialPrecomputation::Kernels& knots, int degree, double smoothing, int fields,
    const std::function<bool(double)>& goOn);
};
} // namespace measuredbrdf

#endif
