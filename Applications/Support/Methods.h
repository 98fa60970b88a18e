// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * --method: how a subcommand integrates an environment's light.
 */

#ifndef Methods_h
#define Methods_h

#include "Inputs.h"

#include "vtkBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace tool
{
/// What the material is and takes on the GPU, in one line.
std::string DescribeForm(vtkBRDF* brdf);

/**
 * Whether a basis or a fit suits a material. The thesis represents materials in a basis, and uses
 * the D-BRDF for the one that rings, the foil. It decides by hand; this measures. The material is
 * projected onto the zonal basis of the order over the device's zone, and a basis is advised where
 * the relative L2 distance there is at most 10 %. The negative mass (vtkBasisBRDF::GetNegativeMass)
 * describes how the projection rings and does not enter the decision: for 37 materials and the
 * orders 4 to 12 it does not exceed 0.3 % where the residual is below 10 %. docs/thesis.md has the
 * figures.
 */
struct Advice
{
  bool IsBasis = false;
  double InZoneResidual = 0.0;
  double NegativeMass = 0.0;
  std::string Reason; // one line
};

constexpr double DeviceZone[2] = { 9.0, 57.0 }; // degrees

/// Throws Error, also where Ctrl-C was pressed; it begins with name, or the material's. Needs an
/// Interruptible.
Advice Advise(
  vtkBRDF* brdf, int order, const double* zone = DeviceZone, const std::string& name = "");

/// The material as advised: spherical harmonics of the hemisphere, or the D-BRDF fit. One that is
/// in a basis already stays.
struct Representation
{
  vtkSmartPointer<vtkBRDF> BRDF;
  std::string Kind;
  std::string Description; // of the shader inputs, in one line
  std::string Reason;
};

/// Measure and make it, with a progress bar. Throws Error naming its file, also where Ctrl-C
/// was pressed. Needs an Interruptible.
Representation Represent(const Material& material, int order);

/// How to plan.
struct PlanOptions
{
  double Tolerance = 0.02;
  double MaximumCost = 150.0; // of a pixel, times a table's
  bool All = false;           // try every candidate
  bool ForView = false;       // for what a picture shows, instead of for a sphere from everywhere

  /// Add --tolerance, --maximum-cost and, where a picture is seen, --for-view to a subcommand.
  void AddTo(CLI::App* command, bool forView);
};

/// What a camera sees of a mesh.
struct VisiblePairs
{
  vtkNew<vtkDoubleArray> Normals; // 3 components each
  vtkNew<vtkDoubleArray> Views;
};

struct MethodOptions
{
  std::string Method;
  std::string Sizes;
  PlanOptions Plan;
  LightSetOptions Lights;
  int Order = 6; // of the basis of --method thesis

  /// Add --method and the methods' own options to a subcommand; those that run on the CPU only
  /// where a picture can be made there, "traced" where there is a surface, and --for-view where a
  /// picture is seen.
  void AddTo(CLI::App* command, bool onCpu, bool forView, bool traced = false);

  /// To be called first: light-set takes the place of the default auto where lights were asked for.
  /// Throws UsageError where options don't go together.
  void Check(const CLI::App* command);

  /// Whether it sums over lights: light-set and thesis.
  bool HasLights() const { return this->Method == "light-set" || this->Method == "thesis"; }
};

/// A method made for a material and an environment.
struct Method
{
  /// Prepared, with its BRDF and environment; of --method auto null until something was drawn.
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
  vtkSmartPointer<vtkBRDF> BRDF;               // the material, or what stands for it
  Representation Thesis;                       // of --method thesis
  vtkSmartPointer<vtkRadiancePlanner> Planner; // of --method auto once something was drawn

  /// How many lights it sums over, 0 where it has none.
  int GetNumberOfLights() const;
};

/// A planner that has planned under a progress bar. seen: what a camera sees, which Scene finds;
/// null: a sphere from everywhere. Throws Error, also where Ctrl-C was pressed. Needs an
/// Interruptible.
vtkSmartPointer<vtkRadiancePlanner> MakePlan(const Material& material, vtkEnvironment* environment,
  const PlanOptions& options, const VisiblePairs* seen = nullptr);

/// Make it under a progress bar. Throws Error, also where Ctrl-C was pressed. Needs an
/// Interruptible.
Method MakeMethod(
  const MethodOptions& options, const Material& material, vtkEnvironment* environment);

/// The integrator alone; of --method auto the one that is planned for a sphere from everywhere.
vtkSmartPointer<vtkRadianceIntegrator> MakeIntegrator(
  const MethodOptions& options, const Material& material, vtkEnvironment* environment);

/// Whether nothing but the CPU integrates it.
bool IsOnCpuOnly(const std::string& method);

/// An array of tuples of so many values.
vtkSmartPointer<vtkDoubleArray> MakeArray(const std::vector<double>& values, int components);

/// Tangents of normals, 3 doubles each: about the up axis, as the mapper takes them where the data
/// has none.
vtkSmartPointer<vtkDoubleArray> MakeTangents(const std::vector<double>& normals);

/// The values of an array.
std::vector<double> ToVector(vtkDoubleArray* array);

/// Radiance of an integrator for (normal, view) pairs, 3 doubles each: 3 doubles each. Anisotropic
/// materials are turned about the up axis, as the mapper does without tangents. show gets the share
/// done; without one there is a progress bar. Throws Error. Needs an Interruptible.
std::vector<double> IntegratePairs(vtkRadianceIntegrator* integrator,
  const std::vector<double>& normals, const std::vector<double>& views,
  const std::function<void(double)>& show = nullptr);
} // namespace tool

#endif
