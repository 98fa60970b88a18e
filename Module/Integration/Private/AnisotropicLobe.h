// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a table of radiance needs of one view of an anisotropic material: LobeHarmonics.h for
 * kernels without a plane of symmetry.
 */

#ifndef AnisotropicLobe_h
#define AnisotropicLobe_h

#include "LobeMeans.h"
#include "LobeNodes.h"

#include <glm/glm.hpp>

#include <complex>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class AnisotropicLobe
{
public:
  /// Of a prepared BRDF seen from unit o above the horizon. resolution: nodes of the integral over
  /// theta_i, twice as many over phi_i; they crowd where the kernel is.
  AnisotropicLobe(vtkBRDF* brdf, const glm::dvec3& o, int resolution);

  const LobeMeans& GetMeans() const { return this->Means; }

  /**
   * b_lk = integral of rest x Y*_lk, scaled to the rest's directional albedo, in the frame whose z
   * is the lobe's axis and whose x is the tangent, carried from the normal to the axis by the
   * smallest rotation, for l <= degree and 0 <= k <= orders. At (3 k + channel) (degree + 1) + l.
   */
  std::vector<std::complex<float>> Expand(int degree, int orders) const;

private:
  using Series = std::vector<std::complex<double>>;
  Series ExpandAboutNormal(int degree, double azimuth) const;

  LobeMeans Means;
  glm::dvec3 Sum = glm::dvec3(0.0); // the rest over the nodes
  std::vector<LobeNode> Polar;
  std::vector<LobeNode> Azimuths; // from -pi on
  std::vector<glm::dvec3> Kernel; // rest at (polar, azimuth)
};
} // namespace measuredbrdf

#endif
