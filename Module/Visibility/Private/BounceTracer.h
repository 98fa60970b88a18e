// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What comes back to points of surfaces from the surfaces that hide the sky from them
 * (BouncedLight), once it is known what each point sees of the sky. Private to the module.
 */

#ifndef BounceTracer_h
#define BounceTracer_h

#include "BouncedLight.h"
#include "HiddenSky.h"
#include "SurfacePoints.h"
#include "SurfaceTracer.h"
#include "VisibilityArrays.h"

#include <glm/glm.hpp>

#include <vector>

namespace measuredbrdf
{
class BounceTracer
{
public:
  /// surfaces: those that the tracer has as its first ones, whose arrays say what each point sees;
  /// what is hidden by others stays dark. rays: as many in each sector as from points, or fewer.
  BounceTracer(const SurfaceTracer& tracer, const std::vector<SurfaceArrays>& surfaces,
    int elevations, double farthest);

  /// Of a point, with the code of one of its sides. Thread-safe.
  BouncedLight::Code Trace(
    const SurfaceVertex& point, double side, const HiddenSky::Code& code) const;

private:
  BouncedLight::Transfer GetVisible(
    const SurfaceTracer::Hit& hit, const glm::dvec3& direction) const;

  const SurfaceTracer& Tracer;
  const std::vector<SurfaceArrays>& Surfaces;
  HiddenSky::Rays Rays;
  double Farthest;
};
} // namespace measuredbrdf

#endif
