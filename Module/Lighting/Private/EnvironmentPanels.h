// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The bright, compact parts of an environment: windows, softboxes, a sun's halo.
 */

#ifndef EnvironmentPanels_h
#define EnvironmentPanels_h

#include "TexelChanges.h"

#include <glm/glm.hpp>

#include <vector>

class vtkEnvironment;
class vtkLightSet;

namespace measuredbrdf
{
/**
 * A mixture of 16 von Mises-Fisher lobes and a uniform part that fits the radiance of 32 x 32
 * directions by expectation maximization (Banerjee et al. 2005), from the directions of a light set
 * on. Its panels are the concentrated lobes, those first that are the brightest.
 */
class EnvironmentPanels
{
public:
  struct Panel
  {
    glm::dvec3 Direction; // unit
    /// Of the panel's radiance over the sphere: on a surface that faces a small panel.
    glm::dvec3 Irradiance;
    double Concentration; // radiance as exp(concentration (d . direction))
  };

  /// Where the light starts from: so many lights.
  static constexpr int Lights = 16;

  /// An environment that is not empty, with some texels changed.
  EnvironmentPanels(vtkEnvironment* environment, const TexelChanges& changes, vtkLightSet* lights);

  const std::vector<Panel>& GetPanels() const { return this->Panels; }

private:
  std::vector<Panel> Panels;
};
} // namespace measuredbrdf

#endif
