// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Narrow lobes that send light back: i about o, where samplers made for mirror lobes do not look.

#include "HalfVector.h"
#include "LocalFrame.h"
#include "MaterialPrecomputation.h"
#include "PlanSearch.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDF.h"
#include "vtkBRDFAnalysis.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

using namespace measuredbrdf;

namespace
{
// A matte base and a lobe k (n + 1) / (2 pi) cos^n(angle of i and o) / max(cos i, cos o):
// reciprocal and, with the default sampling, found by nobody.
class RetroBRDF : public vtkBRDF
{
public:
  static RetroBRDF* New();
  vtkTypeMacro(RetroBRDF, vtkBRDF);

  double Exponent = 2000.0;

  void GetShaderInputs(vtkBRDFShaderInputs&) override {}

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    const double cosine = i[0] * o[0] + i[1] * o[1] + i[2] * o[2];
    const double lobe = 0.4 * (this->Exponent + 1.0) / (2.0 * Pi) *
                        std::pow(std::max(cosine, 0.0), this->Exponent) / std::max(i[2], o[2]);
    f[0] = 0.25 / Pi + lobe;
    f[1] = 0.20 / Pi + 0.5 * lobe;
    f[2] = 0.15 / Pi;
  }
};

vtkStandardNewMacro(RetroBRDF);

vtkSmartPointer<RetroBRDF> NewRetro(double exponent)
{
  auto brdf = vtkSmartPointer<RetroBRDF>::New();
  brdf->Exponent = exponent;
  brdf->SetName("retro");
  return brdf;
}

// The same in a table of degrees, as MERL's are.
vtkSmartPointer<vtkTabulatedBRDF> Tabulate(vtkBRDF* brdf)
{
  const int dimensions[3] = { 1, 90, 90 };
  std::vector<float> rgb;
  for (int h = 0; h < 90; ++h)
  {
    for (int d = 0; d < 90; ++d)
    {
      glm::dvec3 i, o, f;
      FromHalfDifference(
        { UnitToThetaH((h + 0.5) / 90), 0.5 * Pi * (d + 0.5) / 90, 0.5 * Pi }, i, o);
      brdf->Evaluate(&i.x, &o.x, &f.x);
      rgb.insert(
        rgb.end(), { static_cast<float>(f.x), static_cast<float>(f.y), static_cast<float>(f.z) });
    }
  }
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  EXPECT_TRUE(table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, rgb));
  table->Prepare();
  return table;
}

// Integral of f cos(theta_i) L(i), by brute force in polar coordinates about the view.
template <typename Light>
glm::dvec3 Integrate(vtkBRDF* brdf, const glm::dvec3& o, Light&& light)
{
  constexpr int rings = 700, spokes = 400;
  const Frame about = FrameAbout(o);
  glm::dvec3 sum(0.0);
  for (int r = 0; r < rings; ++r)
  {
    const double s = (r + 0.5) / rings;
    const double angle = Pi * s * s * s;
    for (int k = 0; k < spokes; ++k)
    {
      const double phi = 2.0 * Pi * (k + 0.5) / spokes;
      const glm::dvec3 i = about * glm::dvec3(std::sin(angle) * std::cos(phi),
                                     std::sin(angle) * std::sin(phi), std::cos(angle));
      if (i.z > 0.0)
      {
        glm::dvec3 f;
        brdf->Evaluate(&i.x, &o.x, &f.x);
        sum +=
          f * light(i) * (i.z * std::sin(angle) * 3.0 * Pi * s * s / rings * 2.0 * Pi / spokes);
      }
    }
  }
  return sum;
}

glm::dvec3 GetAlbedo(vtkBRDF* brdf, const glm::dvec3& o)
{
  return Integrate(brdf, o, [](const glm::dvec3&) { return glm::dvec3(1.0); });
}

glm::dvec3 AtAngle(double degrees)
{
  return { std::sin(degrees * Pi / 180.0), 0.0, std::cos(degrees * Pi / 180.0) };
}
} // namespace

//------------------------------------------------------------------------------
TEST(RetroReflection, AlbedoCountsIt)
{
  std::vector<vtkSmartPointer<vtkBRDF>> materials = { NewRetro(50000.0),
    Tabulate(NewRetro(2000.0)) };
  for (const auto& brdf : materials)
  {
    vtkNew<vtkBRDFAnalysis> analysis;
    analysis->SetBRDF(brdf);
    ASSERT_TRUE(analysis->Update());
    for (const double degrees : { 0.0, 45.0, 70.0 })
    {
      const glm::dvec3 o = AtAngle(degrees);
      const glm::dvec3 expected = GetAlbedo(brdf, o);
      glm::dvec3 albedo;
      brdf->GetDirectionalAlbedo(&o.x, &albedo.x);
      std::printf("%s at %g degrees: albedo %.4f, by brute force %.4f\n", brdf->GetClassName(),
        degrees, albedo.x, expected.x);
      EXPECT_GT(expected.x, 0.5);
      EXPECT_NEAR(albedo.x, expected.x, 0.01 * expected.x);
      EXPECT_NEAR(albedo.z, expected.z, 0.01 * expected.z);
    }
    for (int k = 0; k < analysis->GetNumberOfAngles(); ++k)
    {
      glm::dvec3 albedo, reflectance; // reciprocal: equal
      analysis->GetAlbedo(k, &albedo.x);
      analysis->GetReflectance(k, &reflectance.x);
      EXPECT_NEAR(reflectance.x, albedo.x, 0.02 * albedo.x) << analysis->GetAngle(k);
    }
  }
}

//------------------------------------------------------------------------------
// Under a constant sky. Without draws of its own the lobe, most of the albedo, would be lost.
TEST(RetroReflection, FilteredSamplesDrawIt)
{
  vtkNew<vtkEnvironment> white;
  ASSERT_TRUE(white->SetPixels(8, 4, std::vector<float>(96, 1.0f)));
  for (const double exponent : { 300.0, 2000.0, 50000.0 })
  {
    const auto brdf = NewRetro(exponent);
    vtkNew<vtkFilteredRadianceIntegrator> filtered;
    filtered->SetBRDF(brdf);
    filtered->SetEnvironment(white);
    filtered->SetNumberOfSamples(1024);
    for (const double degrees : { 0.0, 20.0, 45.0, 70.0 })
    {
      const glm::dvec3 o = AtAngle(degrees);
      const glm::dvec3 expected = GetAlbedo(brdf, o);
      vtkNew<vtkDoubleArray> n, view, result;
      for (vtkDoubleArray* array : { n.Get(), view.Get(), result.Get() })
      {
        array->SetNumberOfComponents(3);
      }
      n->InsertNextTuple3(0.0, 0.0, 1.0);
      view->InsertNextTuple(&o.x);
      ASSERT_TRUE(filtered->Integrate(n, view, result));
      const double radiance = result->GetComponent(0, 0);
      std::printf("exponent %g at %g degrees: %.4f, by brute force %.4f\n", exponent, degrees,
        radiance, expected.x);
      EXPECT_NEAR(radiance, expected.x, 0.03 * expected.x);
    }
  }
}

//------------------------------------------------------------------------------
// Where its views are no tabulated ones.
TEST(RetroReflection, ReferenceFindsNarrowLobes)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(NewRetro(50000.0));
  reference->SetEnvironment(environment);
  SpherePairs pairs;
  pairs.AddRandom(300, 3);
  reference->SetTolerance(1e-4);
  const std::vector<glm::dvec3> expected = pairs.Integrate(reference.Get());
  reference->SetTolerance(0.01);
  const std::vector<glm::dvec3> found = pairs.Integrate(reference.Get());
  double worst = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    worst = std::max(worst, std::abs(found[k].x / expected[k].x - 1.0));
  }
  EXPECT_LT(worst, 0.01);
}

//------------------------------------------------------------------------------
// Planned radiance, and what plans are measured against, against brute force.
TEST(RetroReflection, PlansCountIt)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  std::vector<float> rgb = environment->GetPixels(); // no sun: brute force would miss its edges
  for (float& value : rgb)
  {
    value = std::min(value, 2.0f);
  }
  ASSERT_TRUE(environment->SetPixels(environment->GetWidth(), environment->GetHeight(), rgb));
  SpherePairs pairs;
  pairs.AddRandom(12, 3);
  std::vector<vtkSmartPointer<vtkBRDF>> materials = { NewRetro(500.0), Tabulate(NewRetro(500.0)) };
  for (const auto& brdf : materials)
  {
    std::vector<glm::dvec3> expected;
    for (vtkIdType k = 0; k < pairs.Normals->GetNumberOfTuples(); ++k)
    {
      glm::dvec3 n, v;
      pairs.Normals->GetTuple(k, &n.x);
      pairs.Views->GetTuple(k, &v.x);
      const Frame frame = FrameAbout(n);
      expected.push_back(Integrate(brdf, LiftView(ToLocal(frame, v)),
        [&](const glm::dvec3& i)
        {
          const glm::dvec3 d = frame * i;
          glm::dvec3 radiance;
          environment->GetRadiance(&d.x, &radiance.x);
          return radiance;
        }));
    }
    PlanTask task;
    task.BRDF = brdf;
    task.Environment = environment;
    task.Tolerance = 0.03;
    task.Shared = std::make_shared<vtkRadianceIntegrator::Precomputation>();
    PlanComparison comparison;
    comparison.Pairs = MakeEmptyPairs();
    comparison.Pairs.Normals = pairs.Normals;
    comparison.Pairs.Views = pairs.Views;
    const auto reference = MakeReference(task, comparison);
    const double off = GetRelativeError(pairs.Integrate(reference), expected);
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(brdf);
    planner->SetEnvironment(environment);
    planner->SetErrorTolerance(0.03);
    ASSERT_TRUE(planner->Update());
    const auto chosen = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
    const double actual = GetRelativeError(pairs.Integrate(chosen), expected);
    std::printf("%s: reference off by %.4f, plan by %.4f; %s\n", brdf->GetClassName(), off, actual,
      planner->GetPlan().c_str());
    EXPECT_LT(off, 0.01);
    EXPECT_LT(actual, 2.0 * std::max(planner->GetPredictedError(planner->GetChoice()), 0.01));
  }
}
