// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The stability laboratory: known ways to fail, each a case that provokes one and measures it; and
 * what cases are made of: methods, materials, environments, (normal, view) pairs, error measures,
 * and the stage of cases that draw.
 */

#ifndef Stability_h
#define Stability_h

#include "Inputs.h"
#include "Picture.h"
#include "Scenes.h"

#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkRadianceIntegrator.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

class vtkActor;
class vtkLightSet;
class vtkRenderer;

namespace tool::stability
{
/// For known limits: shown, whatever comes out.
constexpr double Unlimited = std::numeric_limits<double>::infinity();

/// One measured figure. It passes at or below its threshold, is a known limit up to another bound,
/// and fails beyond it or where it is not finite.
struct Finding
{
  std::string Method; // of integrating, of fitting, a representation ...
  std::string Figure; // what was measured, in words
  double Value = 0.0;
  double Threshold = 0.0;
  double Bound = 0.0; // of the known limit; the threshold where there is none
  std::string Note;
  std::string Why; // it is a known limit

  /// What is known to fail, how far it may, and why.
  void KnownUpTo(double bound, const std::string& why);

  /// "pass", "known limit" or "fail".
  std::string GetStatus() const;
};

/// Thresholds of the methods of a case: one for all, and how far some are known to miss it.
struct Limits
{
  double Threshold;
  std::map<std::string, double> Known; // method -> bound
  std::string Why;                     // these miss it
};

/// What cases are given and what they hand back.
class Context
{
public:
  /// The user's material or else this one.
  vtkSmartPointer<vtkBRDF> Choose(vtkBRDF* otherwise) const;

  /// The user's environment, else "sky" or "hall", averaged down to width x width / 2.
  vtkSmartPointer<vtkEnvironment> MakeEnvironment(const std::string& otherwise, int width) const;

  Finding& Add(const std::string& method, const std::string& figure, double value, double threshold,
    const std::string& note = "");
  void Add(
    const std::string& method, const std::string& figure, double value, const Limits& limits);

  vtkSmartPointer<vtkBRDF> BRDF;               // the user's, or null
  vtkSmartPointer<vtkEnvironment> Environment; // the user's, or null
  bool Short = false;
  std::string Renderer; // set by cases that draw
  std::vector<Finding> Findings;
  std::optional<Picture> Shown; // in linear display light
};

struct Case
{
  std::string Name;
  std::string Group;
  std::string Question; // what is provoked, in one line
  std::function<void(Context&)> Run;
};

/// All cases, in the order of docs/stability.md.
std::vector<Case> GetCases();

///@{
/// The groups, one file each.
void AddBasesCases(std::vector<Case>& cases);
void AddRangeCases(std::vector<Case>& cases);
void AddSamplingCases(std::vector<Case>& cases);
void AddGeometryCases(std::vector<Case>& cases);
void AddTemporalCases(std::vector<Case>& cases);
void AddScaleCases(std::vector<Case>& cases);
void AddDataCases(std::vector<Case>& cases);
void AddConvergenceCases(std::vector<Case>& cases);
void AddNumericCases(std::vector<Case>& cases);
///@}

using Vector = std::array<double, 3>;

/// A way to integrate an environment's light, at the size that it is mostly used with.
struct MethodUnderTest
{
  std::string Name;
  bool Planned; // whether the planner may choose it
  std::function<vtkSmartPointer<vtkRadianceIntegrator>(vtkBRDF*, vtkEnvironment*)> Make;
};

/// Every method, the thesis's first: "median-cut", "importance", "variance" (64 hard lights each),
/// "thesis" (median cut over the material in harmonics of order 6), "soft-lights",
/// "filtered", "table", "hybrid", "auto".
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

///@{
/// Errors of values x against a reference r: mean |x - r| / mean r; sqrt(mean (x - r)^2) / mean r;
/// median of |x - r| / r; infinite where values are not finite.
double GetRelativeL1(const std::vector<double>& x, const std::vector<double>& reference);
double GetRelativeRMS(const std::vector<double>& x, const std::vector<double>& reference);
double GetMedianError(const std::vector<double>& x, const std::vector<double>& reference);
///@}

/// Largest |x|.
double GetLargest(const std::vector<double>& x);

/// How many values are negative or not finite.
double CountBad(const std::vector<double>& x);

/// Slope of log y against log x by least squares.
double FitSlope(const std::vector<double>& x, const std::vector<double>& y);

class StabilityRenderer : public OffscreenScene
{
public:
  /// A unit sphere; the context learns the renderer's name.
  explicit StabilityRenderer(Context& context);

  vtkMeasuredBRDFMapper* GetMapper() { return this->Mapper; }
  vtkActor* GetActor() { return this->Actor; }
  vtkRenderer* GetRenderer() { return this->Renderer; }

  /// The integrator, its material and its environment.
  void SetIntegrator(vtkRadianceIntegrator* integrator);

  /// Radiance, with the camera placed as SetView said, or as it is. Throws Error.
  Picture Draw(int size);
  Picture DrawAsIs(int width, int height);

  /// How many values of the last picture were negative or not finite.
  double GetNumberOfBad() const { return this->NumberOfBad; }

private:
  StabilityRenderer(Context& context, vtkMeasuredBRDFMapper* mapper);

  vtkSmartPointer<vtkMeasuredBRDFMapper> Mapper;
  double NumberOfBad = 0.0;
};

/// A sphere's picture by each method, and by the reference, under one exposure.
Picture MakeSphereSheet(Context& context, const std::string& title, vtkBRDF* brdf,
  vtkEnvironment* environment, const std::vector<MethodUnderTest>& contenders);

/// Covered pixels' radiance; and mean |a - b| / mean b over pixels that both cover.
std::vector<double> GetCovered(const Picture& picture);
double GetPictureDifference(const Picture& a, const Picture& b);
} // namespace tool::stability

#endif
