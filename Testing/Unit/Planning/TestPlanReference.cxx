// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What plans are measured against, against dense sums.

#include "LocalFrame.h"
#include "MaterialPrecomputation.h"
#include "PlanSearch.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLambertBRDF.h"
#include "vtkSumBRDF.h"

#include <glm/gtc/type_ptr.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr double PlanTolerance = 0.02;

// A matte base under a coat whose albedo is about share at normal view.
struct CoatedBase
{
  vtkNew<vtkLambertBRDF> Base;
  vtkSmartPointer<vtkBRDF> Coat;
  vtkNew<vtkSumBRDF> Sum;

  /// across: of the exponent, how much of it a brushed coat has across its threads.
  CoatedBase(double albedo, double share, double exponent, bool fresnel, double across = 1.0)
  {
    this->Base->SetAlbedo(albedo, 0.9 * albedo, 0.8 * albedo);
    this->Sum->AddTerm(this->Base);
    if (fresnel)
    {
      vtkNew<vtkAshikhminShirleyBRDF> coat;
      coat->SetReflectance(share, share, share);
      coat->SetExponents(exponent, across * exponent);
      this->Coat = coat;
    }
    else
    {
      vtkNew<vtkBlinnPhongBRDF> coat;
      coat->SetSpecular(0.25 * share, 0.25 * share, 0.25 * share);
      coat->SetExponent(exponent);
      this->Coat = coat;
    }
    this->Sum->AddTerm(this->Coat);
  }
};

// The plan's reference on these pairs, and how far it says that it is off.
std::vector<glm::dvec3> Refer(
  vtkBRDF* brdf, vtkEnvironment* environment, const SpherePairs& pairs, double& stated)
{
  PlanTask task;
  task.BRDF = brdf;
  task.Environment = environment;
  task.Tolerance = PlanTolerance;
  task.Shared = std::make_shared<vtkRadianceIntegrator::Precomputation>();
  PlanComparison comparison;
  comparison.Pairs = MakeEmptyPairs();
  comparison.Pairs.Normals = pairs.Normals;
  comparison.Pairs.Views = pairs.Views;
  brdf->Prepare();
  EXPECT_TRUE(MakeReference(task, comparison)) << task.Problem;
  stated = comparison.ReferenceError;
  std::vector<glm::dvec3> values;
  for (vtkIdType k = 0; k < comparison.Reference->GetNumberOfTuples(); ++k)
  {
    values.emplace_back(glm::make_vec3(comparison.Reference->GetTuple(k)));
  }
  return values;
}

// What white Lambert surfaces reflect: a sum over all texels tells that from the integral by
// little.
std::vector<glm::dvec3> SumWhite(vtkEnvironment* environment, const SpherePairs& pairs)
{
  vtkNew<vtkLambertBRDF> white;
  white->SetAlbedo(1.0, 1.0, 1.0);
  return pairs.IntegrateExactly(white, environment);
}

// The base by that, the coat by a dense grid of draws from it: no squares, no lights.
std::vector<glm::dvec3> SumDensely(const CoatedBase& material, vtkEnvironment* environment,
  const SpherePairs& pairs, const std::vector<glm::dvec3>& white, int side = 128)
{
  glm::dvec3 albedo;
  material.Base->GetAlbedo(&albedo.x);
  std::vector<glm::dvec3> sums;
  for (std::size_t k = 0; k < white.size(); ++k)
  {
    glm::dvec3 n, v;
    pairs.Normals->GetTuple(static_cast<vtkIdType>(k), &n.x);
    pairs.Views->GetTuple(static_cast<vtkIdType>(k), &v.x);
    const Frame frame = FrameAbout(n, glm::dvec3(0.0));
    const glm::dvec3 o = LiftView(ToLocal(frame, v));
    glm::dvec3 sum(0.0);
    for (int draw = 0; draw < side * side; ++draw)
    {
      glm::dvec3 i;
      if (material.Coat->Sample(&o.x, (draw % side + 0.5) / side, (draw / side + 0.5) / side, &i.x))
      {
        const glm::dvec3 d = frame * i;
        glm::dvec3 f, radiance;
        material.Coat->Evaluate(&i.x, &o.x, &f.x);
        environment->GetRadiance(&d.x, &radiance.x);
        sum += f * radiance * (i.z / material.Coat->Pdf(&i.x, &o.x));
      }
    }
    sums.push_back(albedo * white[k] + sum / (1.0 * side * side));
  }
  return sums;
}

vtkSmartPointer<vtkEnvironment> NewEmbeddedMap(const char* name)
{
  return vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(name));
}

void ExpectAsStated(const std::string& what, const std::vector<glm::dvec3>& reference,
  double stated, const std::vector<glm::dvec3>& expected, double own)
{
  const double error = GetRelativeError(reference, expected);
  std::printf("%s: off by %.5f, said to be %.5f\n", what.c_str(), error, stated);
  EXPECT_LE(error, stated + own) << what;
  EXPECT_LE(stated, 0.35 * PlanTolerance) << what;
}
}

//------------------------------------------------------------------------------
// Lights miss coats that are narrower than they are apart, whatever their share of the albedo.
TEST(PlanReference, KnowsItsErrorUnderCoats)
{
  SpherePairs pairs;
  pairs.AddRandom(64);
  for (const char* name : { "room", "hall" })
  {
    const auto environment = NewEmbeddedMap(name);
    ASSERT_TRUE(environment);
    const auto white = SumWhite(environment, pairs);
    for (const double exponent : { 2000.0, 20000.0, 200000.0 })
    {
      for (const double share : { 0.02, 0.1, 0.3 })
      {
        const bool fresnel = share == 0.1;
        const CoatedBase material(0.9 - share, share, exponent, fresnel);
        double stated = 0.0;
        const auto reference = Refer(material.Sum, environment, pairs, stated);
        char what[80];
        std::snprintf(what, sizeof(what), "%s, %g of exponent %g", name, share, exponent);
        ExpectAsStated(
          what, reference, stated, SumDensely(material, environment, pairs, white), 2e-3);
      }
    }
  }
  // A brushed one: streaks across small lamps take more draws.
  SpherePairs few;
  few.AddRandom(16);
  const auto room = NewEmbeddedMap("room");
  const CoatedBase brushed(0.6, 0.1, 20000.0, true, 0.1);
  double stated = 0.0;
  const auto reference = Refer(brushed.Sum, room, few, stated);
  ExpectAsStated(
    "brushed", reference, stated, SumDensely(brushed, room, few, SumWhite(room, few), 512), 5e-4);
}

//------------------------------------------------------------------------------
TEST(PlanReference, IsNearlyExact)
{
  SpherePairs pairs;
  pairs.AddRandom(64);
  for (const char* map : { "sky", "room" })
  {
    const auto environment = NewEmbeddedMap(map);
    for (const char* name : { "blue-fabric", "violet-rubber", "white-marble", "nickel", "chrome" })
    {
      const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
      double stated = 0.0;
      const auto reference = Refer(brdf, environment, pairs, stated);
      vtkNew<vtkAdaptiveRadianceIntegrator> adaptive;
      adaptive->SetTolerance(2e-4);
      adaptive->SetBRDF(brdf);
      adaptive->SetEnvironment(environment);
      ExpectAsStated(
        std::string(name) + ", " + map, reference, stated, pairs.Integrate(adaptive), 1e-3);
    }
  }
}
