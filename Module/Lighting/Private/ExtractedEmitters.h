// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Bright sources of an environment (suns, lamps), extracted as directional lights, and the
 * environment without them, which is smoother and easier to integrate.
 */

#ifndef ExtractedEmitters_h
#define ExtractedEmitters_h

#include "TexelChanges.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

class vtkEnvironment;

namespace measuredbrdf
{
struct ExtractedEmitters
{
  struct Part
  {
    glm::dvec3 Direction;
    glm::dvec3 Irradiance; // on a surface that faces it
    double Spread;         // variance of its directions along each axis (square radians)
  };

  struct Light : Part
  {
    /// Few smaller lights that add up to it, for what sees the lamp's shape: its texels or, where
    /// there are more than MostParts, groups of them.
    std::vector<Part> Parts;
  };
  static constexpr std::size_t MostParts = 8;

  static constexpr double DefaultShare = 2e-3;
  static constexpr double LampShare = 1e-3; // least share, if many texels make few lights

  /**
   * Extract the texels that hold more than share of all luminance and more than 32 times the mean
   * (at most the brightest maximum ones) from an environment that is not empty; share >= 1: none.
   *
   * With an angle (radians), lights consist of the texels within it of the light's brightest one.
   * Two lights are merged if all their texels lie within the angle of the common mean, or within
   * twice the angle if one holds less than 1 % of the other. A light has the sum of its texels,
   * their mean direction, and the variance of what is between their neighbors' centers. The share
   * is then the least one, up to DefaultShare by factors of two, for which maximum lights hold all
   * texels. A panel that needs more is not a lamp.
   */
  ExtractedEmitters(vtkEnvironment* environment, double share, int maximum, double angle = 0.0);

  static ExtractedEmitters FindLamps(vtkEnvironment* environment, double angle, int maximum)
  {
    return { environment, LampShare, maximum, angle };
  }

  std::vector<Light> Lights;
  /// Changes of GetSubdivided(): the mean of their neighbors in place of the lights' texels.
  TexelChanges Rest;
};
} // namespace measuredbrdf

#endif
