// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Fits a shading model to a material: the parameters whose sphere, lit by several environments, is
 * closest to the material's.
 */

#ifndef ModelFit_h
#define ModelFit_h

#include "SurfaceModel.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace tool
{
class LitSphere;

struct ModelFit
{
  vtkSmartPointer<SurfaceModel> Model;
  std::vector<Feature> Features; // beside Core, in the order in which they were taken
  double Error = 0.0;            // mean over the lights of relative L1 on the lit sphere
  double ClosestError = 0.0;     // of the fit that takes every valid value
};

/**
 * The model's core parameters, then one part after the other as long as it takes away at least
 * WorthIt of the error; the part that takes away most comes first. Anisotropy is tried for
 * anisotropic materials only. usual: with values such as people set by hand, a dielectric or
 * a metal (a metallic part of 0, or of 0.3 to 1 with a roughness of at most 0.6; others up to
 * ModelParameter::MostUsual); else all that are valid. Deterministic. The BRDF must be prepared.
 * proceed: called after every iteration with the share that is done; what it throws ends the fit.
 * Throws std::runtime_error for a material that reflects no light, or where no start can be fitted.
 */
ModelFit FitModel(const std::string& model, vtkBRDF* brdf, const LitSphere& sphere, bool usual,
  const std::function<void(double)>& proceed);

/// The share of the error that a part has to take away to be written, and the least part of the
/// light, in the whole error, that this has to be.
constexpr double WorthIt = 0.05;
constexpr double WorthAtLeast = 0.001;

/// Mean over the lights of sum |x - r| / sum r, for sums of a sphere.
double GetMeanError(const Eigen::ArrayXXd& radiance, const Eigen::ArrayXXd& reference);
} // namespace tool

#endif
