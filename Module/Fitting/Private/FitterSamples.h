// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a fitter's FitTo gets, as the module's own solvers take it.
 */

#ifndef FitterSamples_h
#define FitterSamples_h

#include "FitSamples.h"
#include "HalfVector.h"
#include "vtkBRDFFitter.h"

#include <glm/gtc/type_ptr.hpp>

#include <utility>
#include <vector>

namespace measuredbrdf
{
/// loss: vtkBRDFFitter::LossType.
inline FitSamples ToFitSamples(const std::vector<vtkBRDFFitter::Sample>& samples, int loss)
{
  std::vector<FitSample> own;
  own.reserve(samples.size());
  for (const vtkBRDFFitter::Sample& sample : samples)
  {
    const glm::dvec3 i = glm::make_vec3(sample.I);
    const glm::dvec3 o = glm::make_vec3(sample.O);
    own.push_back(
      { i, o, HalfVector(i, o), { sample.F[0], sample.F[1], sample.F[2] }, sample.Weight });
  }
  return FitSamples(FitLoss{ loss }, std::move(own));
}
} // namespace measuredbrdf

#endif
