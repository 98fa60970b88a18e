// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The few texels of an environment that outweigh all others (suns, lamps) as directional lights,
 * and the rest: what is integrated over a map is the smoother the less of them it holds. Private to
 * the module.
 */

#ifndef ExtractedEmitters_h
#define ExtractedEmitters_h

#include "TexelChanges.h"

#include <glm/glm.hpp>

#include <utility>
#include <vector>

class vtkEnvironment;

namespace measuredbrdf
{
struct ExtractedEmitters
{
  struct Light
  {
    glm::dvec3 Direction;
    glm::dvec3 Irradiance; // on a surface that faces it
  };

  static constexpr double DefaultShare = 2e-3;
  static constexpr double LampShare = 1e-3; // the least where many texels make few lights

  /**
   * Texels that hold more than share of all luminance, and 32 times what they hold in the mean (the
   * brightest maximum of them); share >= 1: none. The environment is not empty.
   */
  ExtractedEmitters(vtkEnvironment* environment, double share, int maximum);

  /**
   * The same with lights of many texels: those within angle (radians) of its brightest one; two of
   * which are one where all lies within the angle of the common mean, or within twice that if one
   * holds less than 1 % of the other. Their sum comes from their mean direction. The share is the
   * least, from LampShare to DefaultShare by factors of two, whose texels all go into maximum
   * lights: a panel that needs more is no lamp.
   */
  static ExtractedEmitters FindLamps(vtkEnvironment* environment, double angle, int maximum);

  std::vector<Light> Lights;
  /// Of GetSubdivided(): their neighbors' mean in place of the lights.
  TexelChanges Rest;

private:
  ExtractedEmitters() = default;

  /// The texels that hold more than a share of all luminance, the brightest first.
  struct Ranking
  {
    Ranking(vtkEnvironment* environment, double share);
    double Total = 0.0;
    std::vector<std::pair<double, int>> Texels; // luminance, index
  };

  /// Returns whether all texels with that share found a light.
  bool Extract(
    vtkEnvironment* environment, const Ranking& ranking, double share, int maximum, double angle);
};
} // namespace measuredbrdf

#endif
