// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A list of a few texels of an environment with changed radiance. It describes the environment
 * without its suns and lamps and needs no copy of the map.
 */

#ifndef TexelChanges_h
#define TexelChanges_h

#include "vtkEnvironment.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

struct vtkEnvironment::TexelChanges
{
  struct Texel
  {
    std::size_t Index; // row by row
    glm::vec3 Radiance;
    bool operator<(const Texel& other) const { return this->Index < other.Index; }
    bool operator==(const Texel& other) const
    {
      return this->Index == other.Index && this->Radiance == other.Radiance;
    }
  };

  std::vector<Texel> Texels; // ascending

  /// RGB of texels [x0,x1) of a row: the environment's own pixels or, if one of them is changed, a
  /// copy in room.
  const float* GetRow(
    vtkEnvironment* environment, int y, int x0, int x1, std::vector<float>& room) const;

  /// Radiance at (u,v) in [0,1]^2 of an environment that is not empty.
  glm::dvec3 Interpolate(vtkEnvironment* environment, double u, double v) const;
};

namespace measuredbrdf
{
using TexelChanges = vtkEnvironment::TexelChanges;
}

#endif
