// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// One rule for bad values in every setter: what is no number or no enumerator is refused with one
// error, and the value stays; numbers out of range are clamped with one warning, or refused.

#include "ErrorCatcher.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFAnalysis.h"
#include "vtkBRDFFailureMap.h"
#include "vtkBRDFResampler.h"
#include "vtkBasisBRDF.h"
#include "vtkBasisProjector.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCommand.h"
#include "vtkDistributionBRDF.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLobeBRDFFitter.h"
#include "vtkRadiancePlanner.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTabulatedBRDF.h"

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
const double NaN = std::nan("");

// An object's errors and warnings.
struct Listener
{
  explicit Listener(vtkObject* object)
    : Errors(object)
    , Warnings(object, vtkCommand::WarningEvent)
  {
  }

  // What was said since the last call, by number.
  void Expect(const std::string& setter, int errors, int warnings)
  {
    const std::string text = errors > 0 ? this->Errors.GetText() : this->Warnings.GetText();
    EXPECT_EQ(this->Errors.Take(), errors) << setter << " " << text;
    EXPECT_EQ(this->Warnings.Take(), warnings) << setter << " " << text;
    EXPECT_TRUE(errors + warnings == 0 || text.find(setter) != std::string::npos) << text;
  }

  ErrorCatcher Errors;
  ErrorCatcher Warnings;
};

// Finite numbers out of [low, high] are clamped or refused; `bad` are refused.
template <typename Object, typename S, typename G, typename T>
void ExpectRule(const char* setter, bool clamps, Object* object, void (S::*set)(T), T (G::*get)(),
  double low, double high, std::vector<double> bad = {})
{
  Listener listener(object);
  const T before = (object->*get)();
  const vtkMTimeType time = object->GetMTime();
  std::vector<std::pair<double, double>> clamped = { { low - 1.0, low } };
  if (high < 1e9)
  {
    clamped.emplace_back(high + 1.0, high);
  }
  if (std::is_floating_point<T>::value)
  {
    bad.insert(bad.end(), { NaN, Infinity, -Infinity });
  }
  for (const auto& [value, taken] : clamped)
  {
    if (!clamps)
    {
      bad.push_back(value);
    }
  }
  for (const double value : bad)
  {
    (object->*set)(static_cast<T>(value));
    listener.Expect(setter, 1, 0);
    EXPECT_EQ((object->*get)(), before) << setter << " " << value;
    EXPECT_EQ(object->GetMTime(), time) << setter;
  }
  for (const auto& [value, taken] : clamped)
  {
    (object->*set)(static_cast<T>(clamps ? value : taken));
    listener.Expect(setter, 0, clamps ? 1 : 0);
    EXPECT_EQ((object->*get)(), static_cast<T>(taken)) << setter;
  }
  (object->*set)(before);
  listener.Expect(setter, 0, 0);
}

template <typename Object>
void ExpectFinite3(const char* setter, Object* object, void (Object::*set)(double, double, double),
  void (Object::*setArray)(const double*), double* (Object::*get)())
{
  Listener listener(object);
  const std::vector<double> before((object->*get)(), (object->*get)() + 3);
  for (const double bad : { NaN, Infinity, -Infinity })
  {
    for (int k = 0; k < 3; ++k)
    {
      double values[3] = { 0.25, 0.5, 0.75 };
      values[k] = bad;
      (object->*set)(values[0], values[1], values[2]);
      listener.Expect(setter, 1, 0);
      (object->*setArray)(values);
      listener.Expect(setter, 1, 0);
      EXPECT_EQ(std::vector<double>((object->*get)(), (object->*get)() + 3), before) << setter;
    }
  }
  (object->*set)(0.25, 0.5, 0.75);
  listener.Expect(setter, 0, 0);
  EXPECT_EQ((object->*get)()[1], 0.5) << setter;
}

template <typename Object>
void ExpectZone(
  const char* setter, Object* object, void (Object::*set)(double, double), double* (Object::*get)())
{
  Listener listener(object);
  const double begin = (object->*get)()[0], end = (object->*get)()[1];
  for (const auto& bad : { std::pair<double, double>(NaN, 57.0), { 9.0, Infinity }, { 57.0, 9.0 },
         { -1.0, 57.0 }, { 9.0, 91.0 } })
  {
    (object->*set)(bad.first, bad.second);
    listener.Expect(setter, 1, 0);
    EXPECT_EQ((object->*get)()[0], begin);
    EXPECT_EQ((object->*get)()[1], end);
  }
  (object->*set)(10.0, 50.0);
  listener.Expect(setter, 0, 0);
  EXPECT_EQ((object->*get)()[0], 10.0);
}
}

// Members may be of a superclass.
#define CLAMPED(type, name, low, high)                                                \
  ExpectRule("Set" #name, true, vtkSmartPointer<type>::New().Get(), &type::Set##name, \
    &type::Get##name, low, high)
#define REFUSED(type, name, low, ...)                                                  \
  ExpectRule("Set" #name, false, vtkSmartPointer<type>::New().Get(), &type::Set##name, \
    &type::Get##name, low, __VA_ARGS__)
#define FINITE3(type, name)                                                        \
  ExpectFinite3("Set" #name, vtkSmartPointer<type>::New().Get(), &type::Set##name, \
    &type::Set##name, &type::Get##name)
#define ZONE(type, name) \
  ExpectZone("Set" #name, vtkSmartPointer<type>::New().Get(), &type::Set##name, &type::Get##name)

TEST(Setters, OfMaterials)
{
  CLAMPED(vtkLambertBRDF, ResamplingTolerance, 1e-5, 0.5);
  FINITE3(vtkLambertBRDF, Albedo);
  FINITE3(vtkBlinnPhongBRDF, Specular);
  CLAMPED(vtkBlinnPhongBRDF, Exponent, 0.0, 1e6);
  FINITE3(vtkAshikhminShirleyBRDF, SpecularScale);
  FINITE3(vtkAshikhminShirleyBRDF, Reflectance);
  FINITE3(vtkAshikhminShirleyBRDF, Diffuse);
  CLAMPED(vtkAshikhminShirleyBRDF, ExponentU, 0.0, 1e6);
  CLAMPED(vtkAshikhminShirleyBRDF, ExponentV, 0.0, 1e6);
  CLAMPED(vtkAshikhminShirleyBRDF, IndexOfRefraction, 1.0, 100.0);
  REFUSED(vtkAshikhminShirleyBRDF, FresnelModel, 0, 1);
  REFUSED(vtkTabulatedBRDF, Precision, 0, 3, { 7 });
  CLAMPED(vtkTabulatedBRDF, ResamplingError, 0.0, 1e6);
  CLAMPED(vtkBasisBRDF, ResamplingError, 0.0, 1e6);
  CLAMPED(vtkBRDFResampler, Tolerance, 1e-6, 1.0);

  vtkNew<vtkDistributionBRDF> distribution;
  Listener listener(distribution);
  const std::vector<float> p = distribution->GetDistribution(), f = distribution->GetFresnel();
  for (const double bad : { NaN, Infinity, -1.0 })
  {
    distribution->SetBlinnDistribution(bad);
    listener.Expect("SetBlinnDistribution", 1, 0);
    const double f0[3] = { 0.5, bad, 0.5 };
    distribution->SetSchlickFresnel(f0);
    listener.Expect("SetSchlickFresnel", 1, 0);
  }
  EXPECT_FALSE(distribution->SetDistribution(1, 1, { 1.0f }));
  listener.Expect("SetDistribution", 1, 0);
  EXPECT_FALSE(distribution->SetFresnel(1, { 1.0f, NAN, 1.0f }));
  listener.Expect("SetFresnel", 1, 0);
  EXPECT_EQ(distribution->GetDistribution(), p);
  EXPECT_EQ(distribution->GetFresnel(), f);

  vtkNew<vtkTabulatedBRDF> table;
  Listener tableListener(table);
  const int one[3] = { 1, 1, 1 }, none[3] = { 1, 0, 1 };
  EXPECT_FALSE(table->SetVolume(0, 0, one, { 1.0f }));
  tableListener.Expect("SetVolume", 1, 0);
  EXPECT_FALSE(table->SetVolume(0, 0, none, {}));
  tableListener.Expect("SetVolume", 1, 0);
  EXPECT_FALSE(table->SetVolume(2, 0, one, { 1.0f, 1.0f, 1.0f }));
  tableListener.Expect("SetVolume", 1, 0);
}

TEST(Setters, OfLightingAndReaders)
{
  REFUSED(vtkEnvironmentReader, Projection, -1, vtkEnvironmentReader::CUBE_VERTICAL_STRIP);
  vtkNew<vtkEnvironment> environment;
  Listener listener(environment);
  environment->SetRotationY(NaN);
  listener.Expect("SetWorldToEnvironment", 1, 0);
  const double zeros[9] = {};
  environment->SetWorldToEnvironment(zeros);
  listener.Expect("SetWorldToEnvironment", 1, 0);
}

TEST(Setters, OfIntegrators)
{
  CLAMPED(vtkTableRadianceIntegrator, NumberOfRows, 9, 513);
  CLAMPED(vtkTableRadianceIntegrator, NumberOfViewAngles, 2, 64);
  CLAMPED(vtkTableRadianceIntegrator, NumberOfAzimuths, 4, 64);
  CLAMPED(vtkTableRadianceIntegrator, NumberOfNodes, 16, 1024);
  CLAMPED(vtkFilteredRadianceIntegrator, NumberOfSamples, 1, 1024);
  CLAMPED(vtkHybridRadianceIntegrator, NumberOfRows, 9, 513);
  CLAMPED(vtkHybridRadianceIntegrator, NumberOfViewAngles, 2, 64);
  CLAMPED(vtkHybridRadianceIntegrator, NumberOfAzimuths, 4, 64);
  CLAMPED(vtkHybridRadianceIntegrator, NumberOfMaps, 0, 32);
  CLAMPED(vtkHybridRadianceIntegrator, MaximumNumberOfLights, 0, 1024);
  CLAMPED(vtkHybridRadianceIntegrator, LightAngle, 0.0, 30.0);
  CLAMPED(vtkBRDFAnalysis, NumberOfPairs, 100, 100000000);
  CLAMPED(vtkBRDFFailureMap, NumberOfCells, 2, 720);
  CLAMPED(vtkBRDFFailureMap, NumberOfAzimuths, 2, 3600);
  vtkNew<vtkBRDFAnalysis> analysis;
  Listener listener(analysis);
  for (const double bad : { NaN, Infinity, -1.0, 90.0 })
  {
    analysis->SetAngles(1, &bad);
    listener.Expect("SetAngles", 1, 0);
  }
}

TEST(Setters, OfPlanning)
{
  CLAMPED(vtkRadiancePlanner, ErrorTolerance, 1e-3, 1.0);
  REFUSED(vtkRadiancePlanner, MaximumTextureBytes, 0, 1e300);
}

TEST(Setters, OfFitting)
{
  using Fitter = vtkLobeBRDFFitter;
  REFUSED(Fitter, Loss, 0, 2, { 7, -7 });
  REFUSED(Fitter, NumberOfSamples, 256, 1 << 22, { 0, 2147483647.0 });
  REFUSED(Fitter, NumberOfStarts, 1, 64);
  REFUSED(Fitter, MaximumNumberOfIterations, 1, 10000);
  REFUSED(Fitter, Tolerance, 1e-15, 0.999, { 0.0, 1.0 });
  REFUSED(Fitter, NumberOfLobes, 1, 3);
  REFUSED(Fitter, Anisotropy, 0, 2);
  REFUSED(Fitter, Shape, 0, 1);
  REFUSED(vtkDistributionBRDFFitter, NumberOfPhiSamples, 0, 1024);
  REFUSED(vtkBasisProjector, Basis, 0, 3);
  REFUSED(vtkBasisProjector, Order, 1, 20);
  ZONE(vtkBasisProjector, IncidentZone);
  ZONE(vtkBasisProjector, OutgoingZone);
  REFUSED(vtkBasisProjector, Method, 0, 1);
  CLAMPED(vtkBasisProjector, Regularization, 0.0, 1.0);
  CLAMPED(vtkBasisProjector, NumberOfTheta, 2, 1024);
  CLAMPED(vtkBasisProjector, NumberOfPhi, 4, 1024);
  CLAMPED(vtkBasisProjector, NumberOfNodes, 8, 1024);
}
