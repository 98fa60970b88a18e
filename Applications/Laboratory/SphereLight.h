// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light that a sphere sends to a camera: pairs of normals and views, environments that are made
 * for an experiment, the reference, and the distance from it.
 */

#ifndef SphereLight_h
#define SphereLight_h

#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadianceIntegrator.h"
#include "vtkSmartPointer.h"

#include <Eigen/Core>
#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace laboratory
{
using Environment = vtkSmartPointer<vtkEnvironment>;

/// Normals and views of unit length, 3 doubles each.
struct Pairs
{
  void Add(const glm::dvec3& normal, const glm::dvec3& view);

  std::vector<double> Normals;
  std::vector<double> Views;
};

/// As a sphere shows them to a distant camera at azimuth 30, elevation 20 degrees.
Pairs MakeSpherePairs(int count);

///@{
/// Environments: a function of the direction at texel centers, one of fewer texels
/// (the environment itself where it has no more).
Environment MakeEnvironment(
  int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance);
Environment Shrink(vtkEnvironment* environment, int width);
///@}

/// Radiance of pairs, three channels each.
using Radiance = Eigen::ArrayXd;

///@{
/// By an integrator on the CPU; by the reference to 0.02 %. They throw Error and need an
/// Interruptible.
Radiance Integrate(vtkRadianceIntegrator* integrator, const Pairs& pairs);
Radiance IntegrateReference(vtkBRDF* brdf, vtkEnvironment* environment, const Pairs& pairs);
///@}

/// Mean |x - r| / mean r.
double GetRelativeL1(const Radiance& x, const Radiance& reference);
} // namespace laboratory

#endif
