// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * f of many lights for one view: faster than one by one where a material can. Private to the
 * module.
 */

#ifndef ManyLights_h
#define ManyLights_h

#include "vtkAdaptiveWarpBRDF.h"
#include "vtkBRDF.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <typeinfo>

namespace measuredbrdf
{
/// The material where it evaluates many lights at a time, else null: whoever derives from it may
/// do more.
inline vtkAdaptiveWarpBRDF* GetManyLightsForm(vtkBRDF* brdf)
{
  return brdf && typeid(*brdf) == typeid(vtkAdaptiveWarpBRDF)
           ? static_cast<vtkAdaptiveWarpBRDF*>(brdf)
           : nullptr;
}

/// Of a prepared material; lights: unit vectors above the horizon, like o.
inline void EvaluateManyLights(
  vtkBRDF* brdf, std::size_t count, const glm::dvec3* lights, const glm::dvec3& o, glm::dvec3* f)
{
  if (vtkAdaptiveWarpBRDF* many = GetManyLightsForm(brdf))
  {
    many->EvaluateLights(static_cast<int>(count), &lights[0].x, &o.x, &f[0].x);
    return;
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    brdf->Evaluate(&lights[k].x, &o.x, &f[k].x);
  }
}
} // namespace measuredbrdf

#endif
