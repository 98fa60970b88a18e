// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * --method: how a subcommand integrates an environment's light.
 */

#ifndef Methods_h
#define Methods_h

#include "Inputs.h"
#include "Thesis.h"

#include "vtkRadianceIntegrator.h"

#include <string>
#include <vector>

namespace tool
{
struct MethodOptions
{
  std::string Method;
  std::string Sizes;
  LightSetOptions Lights;
  ThesisOptions Thesis;

  /// Add --method, one of these, and the methods' own options to a subcommand.
  void AddTo(CLI::App* command, const std::vector<std::string>& methods);

  /// Throws UsageError where options don't go together.
  void Check(const CLI::App* command) const;

  /// Whether it sums over lights: light-set and thesis.
  bool HasLights() const { return this->Method == "light-set" || this->Method == "thesis"; }
};

/// The integrator of a method with its BRDF and environment, prepared under a progress bar.
/// representation: what --method thesis draws instead of the material, else empty.
struct Method
{
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
  vtkSmartPointer<vtkBRDF> BRDF;
  Representation Thesis;

  /// How many lights it sums over, 0 where it has none.
  int GetNumberOfLights() const;
};

/// Make it. Throws Error, also where Ctrl-C was pressed. Needs an Interruptible.
Method MakeMethod(
  const MethodOptions& options, const Material& material, vtkEnvironment* environment);

/// Radiance of an integrator for (normal, view) pairs, 3 doubles each, under a progress bar: 3
/// doubles each. Throws Error. Needs an Interruptible.
std::vector<double> IntegratePairs(vtkRadianceIntegrator* integrator,
  const std::vector<double>& normals, const std::vector<double>& views);
} // namespace tool

#endif
