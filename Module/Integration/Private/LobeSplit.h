// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material's low- and high-frequency parts: which share of each lobe is broad. Private to the
 * module.
 */

#ifndef LobeSplit_h
#define LobeSplit_h

#include "LobeViews.h"

#include <glm/glm.hpp>

#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
/**
 * Per view the kernel f cos(theta_i), less its Lambert part, is cut at the height at which all of
 * its energy would fill the solid angle: what is above is narrower than that angle (Markov's
 * inequality). Both are tabulated over the view's polar angle and interpolated.
 */
class LobeSplit
{
public:
  ///@{
  /// Of a prepared, isotropic BRDF, or its views; solidAngle > 0 in sr.
  LobeSplit(vtkBRDF* brdf, double solidAngle);
  LobeSplit(const LobeViews& views, double solidAngle);
  ///@}

  struct View
  {
    glm::dvec3 Floor;
    double Height; // of the sum of all channels
    double Share;  // that the sharp part has of the albedo

    /// f's broad part, 0 <= result <= f, for a light at this cosine.
    glm::dvec3 GetBroad(const glm::dvec3& f, double cosine) const;
  };

  /// For unit o above the horizon.
  View GetView(const glm::dvec3& o) const;

  /// Largest share that the sharp part has of a view's directional albedo.
  double GetSharpShare() const { return this->SharpShare; }

private:
  std::vector<View> Views;
  double SharpShare = 0.0;
};
} // namespace measuredbrdf

#endif
