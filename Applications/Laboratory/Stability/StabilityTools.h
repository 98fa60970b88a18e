// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What stability cases are made of: the methods, materials, environments, (normal, view) pairs. No
 * graphics.
 */

#ifndef StabilityTools_h
#define StabilityTools_h

#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadianceIntegrator.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

class vtkLightSet;
class vtkPolyData;

namespace tool::stability
{
using Vector = std::array<double, 3>;

/// A way to integrate an environment's light, at the size that it is mostly used with.
struct MethodUnderTest
{
  std::string Name;
  bool Planned; // whether the planner may choose it
  std::function<vtkSmartPointer<vtkRadianceIntegrator>(vtkBRDF*, vtkEnvironment*)> Make;
};

/// Every method, the thesis's first: "median-cut", "importance", "variance" (64 hard lights each),
/// "thesis" (median cut over the material in harmonics of order 6), "soft-lights", "filtered",
///, "table", "hybrid", "auto".
const std::vector<MethodUnderTest>& GetMethodsUnderTest();

/// The sum over so many lights by median cut, for any material and environment.
vtkSmartPointer<vtkRadianceIntegrator> MakeLightLoop(int count);

/// Lights by "median-cut", "importance" or "variance".
vtkSmartPointer<vtkLightSet> MakeLights(
  vtkEnvironment* environment, const std::string& method, int count, unsigned int seed = 1);

///@{
/// Integrators, ready to be prepared.
vtkSmartPointer<vtkRadianceIntegrator> MakeLightLoop(
  vtkBRDF* brdf, vtkEnvironment* environment, vtkLightSet* lights, bool soft = false);
vtkSmartPointer<vtkRadianceIntegrator> MakeTable(
  vtkBRDF* brdf, vtkEnvironment* environment, int rows, int viewAngles, int azimuths);
vtkSmartPointer<vtkRadianceIntegrator> MakeFiltered(
  vtkBRDF* brdf, vtkEnvironment* environment, int samples);
///@}

///@{
/// Materials: 0.3 Lambert + 0.1 Blinn-Phong of an exponent, the lobe alone, Lambert alone.
vtkSmartPointer<vtkBRDF> MakePlastic(double exponent);
vtkSmartPointer<vtkBRDF> MakeLobe(double exponent);
vtkSmartPointer<vtkBRDF> MakeLambert(double albedo);
///@}

/// The material in a basis (vtkBasisBRDF::BasisType), by least squares.
vtkSmartPointer<vtkBRDF> Project(vtkBRDF* brdf, int basis, int order);

///@{
/// Environments: a function of the direction at texel centers, the means over blocks of texels
/// (as it is where it is no wider), the pixels turned about +y by a number of columns, the radiance
/// times a factor.
vtkSmartPointer<vtkEnvironment> MakeEnvironment(
  int width, int height, const std::function<Vector(const Vector&)>& radiance);
vtkSmartPointer<vtkEnvironment> Shrink(vtkEnvironment* environment, int width);
vtkSmartPointer<vtkEnvironment> Roll(vtkEnvironment* environment, double columns);
vtkSmartPointer<vtkEnvironment> Scale(vtkEnvironment* environment, double factor);
///@}

/// A gray sky that varies slowly, without anything small in it.
Vector GetSmoothRadiance(const Vector& direction);

/// Directions of unit length, 3 doubles each.
struct Pairs
{
  std::vector<double> Normals;
  std::vector<double> Views;

  void Add(const Vector& normal, const Vector& view);
};

/// As a sphere shows them to a distant camera at azimuth 30, elevation 20 degrees.
Pairs MakeSpherePairs(int count);

/// All views turned to one polar angle about their normals, in degrees.
Pairs AtAngle(const Pairs& pairs, double degrees);

/// About +y by an angle in degrees.
Vector Turn(const Vector& v, double degrees);

/// Radiance, 3 doubles each. Throws Error. Needs an Interruptible.
std::vector<double> Integrate(vtkRadianceIntegrator* integrator, const Pairs& pairs);

/// By the reference, to 0.02 %.
std::vector<double> IntegrateReference(
  vtkBRDF* brdf, vtkEnvironment* environment, const Pairs& pairs);

/// A number in words: 3 significant digits.
std::string Say(double value);
} // namespace tool::stability

#endif
