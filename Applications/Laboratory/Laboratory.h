// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The commands of measured-brdf-lab, and what several of them make and measure: materials in other
 * forms, and the light that a sphere of a material sends to a camera.
 */

#ifndef Laboratory_h
#define Laboratory_h

#include "Progress.h"

#include "vtkBRDF.h"
#include "vtkBasisBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadianceIntegrator.h"
#include "vtkSmartPointer.h"

#include <Eigen/Core>
#include <glm/glm.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace laboratory
{
/// What --basis takes, and vtkBasisBRDF's types.
const std::map<std::string, int> Bases = { { "spherical-harmonics",
                                             vtkBasisBRDF::SPHERICAL_HARMONICS },
  { "hemispherical", vtkBasisBRDF::HEMISPHERICAL }, { "zonal", vtkBasisBRDF::ZONAL },
  { "legendre-fourier", vtkBasisBRDF::LEGENDRE_FOURIER } };

/// For work that shows its progress: draws a bar, and throws Error where Ctrl-C was pressed. Needs
/// an Interruptible.
inline std::function<void(double)> ShowProgress(const std::string& label)
{
  return [bar = std::make_shared<tool::ProgressBar>(label)](double share)
  {
    bar->Update(share);
    tool::Interruptible::Check();
  };
}

///@{
/// The material in a basis, by least squares, zonal ones over a zone in degrees; its D-BRDF fit.
/// With a progress bar. Throw Error, which begins with name. Need an Interruptible.
vtkSmartPointer<vtkBasisBRDF> ProjectOnto(
  vtkBRDF* brdf, int basis, int order, const double zone[2], const std::string& name);
vtkSmartPointer<vtkBRDF> FitDistribution(vtkBRDF* brdf, const std::string& name);
///@}

constexpr double AllAngles[2] = { 0.0, 90.0 }; // degrees

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

namespace tool
{
///@{
/// Add one subcommand each.
void AddAcquireCommand(CLI::App& app);
void AddPhotographCommand(CLI::App& app);
void AddProjectCommand(CLI::App& app);
void AddRepresentationsCommand(CLI::App& app);
void AddStabilityCommand(CLI::App& app);
void AddThesisCommand(CLI::App& app);
///@}
} // namespace tool

#endif
