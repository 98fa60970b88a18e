// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The steps of a plan: pairs that are drawn, the reference, the climb on the ladder.
#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "MaterialPrecomputation.h"
#include "PlanSearch.h"
#include "RecentlyUsed.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

using measuredbrdf::ChoosePairs;
using measuredbrdf::PlanCandidate;
using measuredbrdf::PlanComparison;
using measuredbrdf::PlanPairs;
using measuredbrdf::SharedCache;

namespace
{
constexpr int Many = 8192;

// A lamp that only normals within 6 degrees of +x see: 1 there, 0 elsewhere.
double GetLamp(vtkDoubleArray* normals, vtkIdType k)
{
  return normals->GetComponent(k, 0) > 0.9945 ? 1.0 : 0.0;
}

vtkNew<vtkDoubleArray> NewRadiance(vtkDoubleArray* normals, double everywhere, double lamp)
{
  vtkNew<vtkDoubleArray> radiance;
  radiance->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < normals->GetNumberOfTuples(); ++k)
  {
    const double value = everywhere + lamp * GetLamp(normals, k);
    radiance->InsertNextTuple3(value, value, value);
  }
  return radiance;
}

// What a weighted sample says that a share of the pixels sees the lamp.
double GetLampShare(const PlanPairs& pairs)
{
  double sum = 0.0;
  double all = 0.0;
  for (std::size_t k = 0; k < pairs.Weights.size(); ++k)
  {
    sum += pairs.Weights[k] * GetLamp(pairs.Normals, static_cast<vtkIdType>(k));
    all += pairs.Weights[k];
  }
  return sum / all;
}

int CountLamp(const PlanPairs& pairs)
{
  int count = 0;
  for (vtkIdType k = 0; k < pairs.Normals->GetNumberOfTuples(); ++k)
  {
    count += GetLamp(pairs.Normals, k) > 0.0 ? 1 : 0;
  }
  return count;
}

PlanPairs DrawMany() { return measuredbrdf::DrawSpherePairs(Many); }
}

//------------------------------------------------------------------------------
// Two methods that differ on a lamp only, which 0.3 % of the pixels see: nearly all pairs that see
// it are chosen, and the weights make up for it.
TEST(PlanSample, LooksWhereMethodsDiffer)
{
  const PlanPairs all = DrawMany();
  const auto coarse = NewRadiance(all.Normals, 1.0, 1.0);
  const auto fine = NewRadiance(all.Normals, 1.0, 3.0);
  const PlanPairs chosen = ChoosePairs(all, coarse, fine, 512);
  EXPECT_NEAR(chosen.Normals->GetNumberOfTuples(), 512, 1);
  EXPECT_EQ(chosen.Views->GetNumberOfTuples(), chosen.Normals->GetNumberOfTuples());
  ASSERT_EQ(static_cast<vtkIdType>(chosen.Weights.size()), chosen.Normals->GetNumberOfTuples());
  EXPECT_GE(CountLamp(chosen), 0.8 * CountLamp(all));
  const double share = GetLampShare(all);
  EXPECT_NEAR(GetLampShare(chosen), share, 0.05 * share);
  const double weight = std::accumulate(all.Weights.begin(), all.Weights.end(), 0.0);
  EXPECT_NEAR(
    std::accumulate(chosen.Weights.begin(), chosen.Weights.end(), 0.0), weight, 0.05 * weight);
}

//------------------------------------------------------------------------------
// Every pair can be chosen, whatever two methods say; a sample is the same every time.
TEST(PlanSample, LeavesNothingOut)
{
  const PlanPairs all = DrawMany();
  const auto dark = NewRadiance(all.Normals, 0.0, 0.0);
  const auto lit = NewRadiance(all.Normals, 0.0, 0.0);
  const auto isLit = [](vtkDoubleArray* normals, vtkIdType k)
  { return normals->GetComponent(k, 1) > 0.0; };
  for (vtkIdType k = 0; k < Many; ++k)
  {
    lit->SetComponent(k, 0, isLit(all.Normals, k) ? 1.0 : 0.0);
  }
  const PlanPairs chosen = ChoosePairs(all, dark, lit, 512);
  int unlit = 0; // half of a quarter, that goes by weight, and of a fifth, of all alike
  for (vtkIdType k = 0; k < chosen.Normals->GetNumberOfTuples(); ++k)
  {
    unlit += isLit(chosen.Normals, k) ? 0 : 1;
  }
  EXPECT_NEAR(unlit, 0.5 * (0.25 + 0.2) * 512, 0.02 * 512);
  const PlanPairs again = ChoosePairs(all, dark, lit, 512);
  EXPECT_EQ(chosen.Weights, again.Weights);

  const PlanPairs black = ChoosePairs(all, dark, dark, 512);
  EXPECT_NEAR(black.Normals->GetNumberOfTuples(), 512, 1);
  const PlanPairs blind = ChoosePairs(all, nullptr, nullptr, 512);
  EXPECT_NEAR(blind.Normals->GetNumberOfTuples(), 512, 1);
  double weights = 0.0;
  double cosines = 0.0; // a disc's mean is 2/3
  for (vtkIdType k = 0; k < blind.Normals->GetNumberOfTuples(); ++k)
  {
    glm::dvec3 n, o;
    blind.Normals->GetTuple(k, &n.x);
    blind.Views->GetTuple(k, &o.x);
    weights += blind.Weights[static_cast<std::size_t>(k)];
    cosines += blind.Weights[static_cast<std::size_t>(k)] * glm::dot(n, o);
  }
  EXPECT_NEAR(weights, Many, 0.08 * Many);
  EXPECT_NEAR(cosines / weights, 2.0 / 3.0, 0.03);
}

//------------------------------------------------------------------------------
// What the pairs of all views say of single cameras is what these see: an error that grows towards
// grazing views, of light from one side.
TEST(PlanPictures, AreWhatCamerasSee)
{
  const auto getLight = [](const glm::dvec3& normal, const glm::dvec3& view)
  {
    const glm::dvec3 mirror = 2.0 * glm::dot(normal, view) * normal - view;
    return 0.1 + std::max(mirror.x, 0.0);
  };
  const auto getError = [](const glm::dvec3& normal, const glm::dvec3& view)
  { return 0.01 + 0.05 * std::pow(1.0 - glm::dot(normal, view), 2.0); };
  const PlanPairs pairs = DrawMany();
  const std::vector<glm::dvec3> cameras = measuredbrdf::GetPictureCameras();
  ASSERT_EQ(cameras.size(), 14u);
  EXPECT_EQ(pairs.Cameras, cameras);
  std::vector<double> differences, references;
  for (vtkIdType k = 0; k < Many; ++k)
  {
    const glm::dvec3 normal = glm::make_vec3(pairs.Normals->GetTuple3(k));
    const glm::dvec3 view = glm::make_vec3(pairs.Views->GetTuple3(k));
    const double weight = pairs.Weights[static_cast<std::size_t>(k)];
    references.push_back(weight * getLight(normal, view));
    differences.push_back(weight * getError(normal, view));
  }
  EXPECT_TRUE(measuredbrdf::GetPictureRatios(pairs, 12.0, {}, {}).empty());
  const std::vector<double> ratios =
    measuredbrdf::GetPictureRatios(pairs, 12.0, differences, references);
  ASSERT_EQ(ratios.size(), 14u);
  const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) /
                      std::accumulate(references.begin(), references.end(), 0.0);
  for (std::size_t c = 0; c < ratios.size(); ++c)
  {
    const glm::dvec3& view = cameras[c];
    double error = 0.0;
    double light = 0.0;
    for (int k = 0; k < 4000; ++k) // uniform over the disc
    {
      const double r = std::sqrt((k + 0.5) / 4000.0);
      const double turn = 2.4 * k;
      const glm::dvec3 u = glm::normalize(glm::cross(view, glm::dvec3(0.3, 0.8, 0.5)));
      const glm::dvec3 normal = r * (std::cos(turn) * u + std::sin(turn) * glm::cross(view, u)) +
                                std::sqrt(1.0 - r * r) * view;
      error += getError(normal, view);
      light += getLight(normal, view);
    }
    EXPECT_NEAR(ratios[c] * mean * light / error, 1.0, 0.15) << c; // of 0.7 to 1.7
  }
}

//------------------------------------------------------------------------------
// Pairs crowd where they see a lamp, and weights make up for it: shares of pixels whose mirror
// directions are within some angle of it.
TEST(PlanSample, CrowdsAboutLamps)
{
  const glm::dvec3 lamp = glm::normalize(glm::dvec3(0.3, 0.5, -0.4));
  const glm::dvec3 aside = glm::normalize(lamp + glm::dvec3(0.0, 0.0, 0.2)); // overlapping
  const PlanPairs pairs = measuredbrdf::DrawSpherePairs(
    Many, { { lamp, glm::dvec3(5.0) }, { -lamp, glm::dvec3(0.0) }, { aside, glm::dvec3(1.0) } });
  double all = 0.0;
  for (const double weight : pairs.Weights)
  {
    ASSERT_TRUE(std::isfinite(weight));
    EXPECT_GT(weight, 0.0);
    all += weight;
  }
  EXPECT_NEAR(all / Many, 1.0, 0.02);
  double cosines = 0.0;
  for (const double degrees : { 0.2, 1.0, 5.0, 30.0 })
  {
    double share = 0.0;
    int count = 0;
    cosines = 0.0;
    for (vtkIdType k = 0; k < Many; ++k)
    {
      glm::dvec3 n, o;
      pairs.Normals->GetTuple(k, &n.x);
      pairs.Views->GetTuple(k, &o.x);
      const double weight = pairs.Weights[static_cast<std::size_t>(k)];
      EXPECT_GE(glm::dot(n, o), -1e-12);
      cosines += weight * glm::dot(n, o) / all;
      const double apart = glm::length(2.0 * glm::dot(n, o) * n - o - lamp);
      if (apart < 2.0 * std::sin(0.5 * glm::radians(degrees)))
      {
        ++count;
        share += weight / all;
      }
    }
    // Mirror directions of a sphere are uniform.
    const double expected = 0.5 * (1.0 - std::cos(glm::radians(degrees)));
    EXPECT_NEAR(share, expected, 0.15 * expected);
    EXPECT_GT(count, 300);
  }
  EXPECT_NEAR(cosines, 2.0 / 3.0, 0.02); // a disc's mean
}

//------------------------------------------------------------------------------
// Lamps turn with the environment, and the pairs with them: the same plan, the same figures.
TEST(PlanSample, TurnsWithTheEnvironment)
{
  vtkNew<vtkEnvironment> environment;
  std::vector<float> pixels(3 * 64 * 32, 0.1f);
  std::fill_n(&pixels[3 * (64 * 8 + 20)], 3, 2000.0f);
  environment->SetPixels(64, 32, pixels);
  const auto brdf =
    vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-metallic-paint3"));
  std::vector<std::string> plans;
  std::vector<double> errors;
  for (const double degrees : { 0.0, 40.0 })
  {
    environment->SetRotationY(degrees);
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(brdf);
    planner->SetEnvironment(environment);
    ASSERT_TRUE(planner->Update());
    plans.push_back(planner->GetDescription(planner->GetChoice()));
    errors.push_back(planner->GetPredictedError(planner->GetChoice()));
  }
  EXPECT_EQ(plans[0], plans[1]);
  EXPECT_NEAR(errors[0], errors[1], 1e-3 * errors[0]);
}

//------------------------------------------------------------------------------
// An abort, values that are no numbers, and a task without candidates.
TEST(PlanSample, StopsAndTakesAnything)
{
  const PlanPairs all = DrawMany();
  const auto dark = NewRadiance(all.Normals, 0.0, 0.0);
  const auto broken = NewRadiance(all.Normals, 1.0, 1.0);
  broken->SetComponent(3, 0, std::nan(""));
  broken->SetComponent(4, 1, HUGE_VAL);
  const PlanPairs chosen = ChoosePairs(all, dark, broken, 512);
  EXPECT_NEAR(chosen.Normals->GetNumberOfTuples(), 512, 1);
  for (const double weight : chosen.Weights)
  {
    EXPECT_TRUE(std::isfinite(weight));
  }
  measuredbrdf::PlanTask task;
  std::vector<measuredbrdf::PlanCandidate> none;
  PlanPairs pairs = all;
  task.IsAborted = []() { return true; };
  EXPECT_THROW(measuredbrdf::SamplePairs(task, none, pairs), measuredbrdf::PlanFailure);
  EXPECT_EQ(pairs.Normals->GetNumberOfTuples(), Many);
  task.IsAborted = []() { return false; };
  measuredbrdf::SamplePairs(task, none, pairs);
  EXPECT_NEAR(pairs.Normals->GetNumberOfTuples(), measuredbrdf::PairsToCompare, 1);
}

//------------------------------------------------------------------------------
// What plans are measured against, against dense sums.
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
  MakeReference(task, comparison);
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
    for (const auto& [share, exponent] :
      { std::pair(0.3, 2000.0), { 0.1, 20000.0 }, { 0.02, 200000.0 }, { 0.3, 200000.0 } })
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

//------------------------------------------------------------------------------
// What a sample says of an error, the climb on the ladder, and what plans of one material share.
namespace
{
// Radiance 1 + Errors[0] where the normal is z, 1 + Errors[1] where it is x.
class Wrong : public vtkRadianceIntegrator
{
public:
  static Wrong* New();
  vtkTypeMacro(Wrong, vtkRadianceIntegrator);
  double Errors[2] = { 0.0, 0.0 };

protected:
  bool Begin() override { return true; }
  void IntegratePair(const double n[3], const double vtkNotUsed(o)[3],
    const double vtkNotUsed(t)[3], double radiance[3]) override
  {
    for (int c = 0; c < 3; ++c)
    {
      radiance[c] = 1.0 + this->Errors[n[0] > 0.5 ? 1 : 0];
    }
  }
};
vtkStandardNewMacro(Wrong);

// Radiance 1 of so many pairs.
PlanComparison MakeComparison(int count, bool alongX)
{
  PlanComparison comparison;
  vtkNew<vtkDoubleArray> directions;
  directions->SetNumberOfComponents(3);
  comparison.Reference = vtkSmartPointer<vtkDoubleArray>::New();
  comparison.Reference->SetNumberOfComponents(3);
  for (int k = 0; k < count; ++k)
  {
    directions->InsertNextTuple3(alongX ? 1.0 : 0.0, 0.0, alongX ? 0.0 : 1.0);
    comparison.Reference->InsertNextTuple3(1.0, 1.0, 1.0);
  }
  comparison.Pairs.Normals = comparison.Pairs.Views = directions;
  return comparison;
}

PlanCandidate MakeCandidate(int size, double first, double second)
{
  PlanCandidate candidate;
  candidate.Method = "wrong";
  candidate.Sizes = { size };
  const auto integrator = vtkSmartPointer<Wrong>::New();
  integrator->Errors[0] = first;
  integrator->Errors[1] = second;
  integrator->SetBRDF(vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("pink-felt")));
  candidate.Integrator = integrator;
  return candidate;
}

// At 2 %.
measuredbrdf::PlanTask MakeTask(vtkIdType maximumBytes)
{
  measuredbrdf::PlanTask task;
  task.BRDF = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("pink-felt"));
  task.Tolerance = 0.02;
  task.MaximumBytes = maximumBytes;
  task.MaximumCost = 1000.0;
  return task;
}

vtkSmartPointer<vtkEnvironment> NewEnvironment(double share)
{
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  std::vector<float> pixels(3 * 64 * 32, 0.2f);
  for (std::size_t k = 0; k < pixels.size() / 3; ++k)
  {
    pixels[3 * k] += static_cast<float>(share * static_cast<double>(k % 64) / 64.0);
  }
  environment->SetPixels(64, 32, pixels);
  return environment;
}
} // namespace

//------------------------------------------------------------------------------
// Against the ratio and its residues by hand.
TEST(PlanComparison, AddsChanceAndTheReferencesError)
{
  PlanComparison comparison = MakeComparison(3, false);
  comparison.Pairs.Weights = { 1.0, 3.0, 4.0 };
  comparison.ReferenceError = 0.03;
  vtkNew<vtkDoubleArray> radiance;
  radiance->SetNumberOfComponents(3);
  radiance->InsertNextTuple3(1.1, 0.9, 1.1); // differences of 0.3, 0, 0.12 of 3
  radiance->InsertNextTuple3(1.0, 1.0, 1.0);
  radiance->InsertNextTuple3(1.04, 1.04, 0.96);
  const auto found = measuredbrdf::Compare(comparison, radiance);
  const double error = (0.3 + 4.0 * 0.12) / 24.0;
  const double squares =
    std::pow(0.3 - 3.0 * error, 2) + std::pow(9.0 * error, 2) + std::pow(0.48 - 12.0 * error, 2);
  EXPECT_NEAR(found.Uncertainty, std::hypot(2.0 * std::sqrt(squares) / 24.0, 0.03), 1e-12);
  EXPECT_NEAR(found.Error, error + found.Uncertainty, 1e-12);
  // Seven eighths of the pixels, by weight, are within 0.12 of 3.
  EXPECT_NEAR(found.Percentiles[0], 0.1, 1e-12);
  EXPECT_NEAR(found.Percentiles[1], 0.1, 1e-12);
  comparison.Pairs.Weights = { 1.0, 3.0, 26.0 };
  EXPECT_NEAR(measuredbrdf::Compare(comparison, radiance).Percentiles[0], 0.04, 1e-12);
}

//------------------------------------------------------------------------------
// From the lowest up to the first within the tolerance; past what has no finite radiance.
TEST(PlanSearch, ClimbsToTheCheapestWithinTheTolerance)
{
  measuredbrdf::PlanTask task = MakeTask(1000);
  const PlanComparison comparison = MakeComparison(20, false);
  std::vector<int> tried;
  std::vector<std::size_t> listed; // only
  const auto run = [&](const std::vector<double>& errors)
  {
    std::vector<PlanCandidate> ladder;
    for (std::size_t k = 0; k < errors.size(); ++k)
    {
      ladder.push_back(MakeCandidate(static_cast<int>(k), errors[k], errors[k]));
      ladder.back().Cost = 2.0 * k + 1.0;
      ladder.back().MayBeChosen = std::count(listed.begin(), listed.end(), k) == 0;
    }
    measuredbrdf::Plan plan;
    double last = 0.0;
    Climb(task, comparison, ladder, plan, [&last](double share) { last = std::max(last, share); });
    EXPECT_GT(last, 0.0);
    tried.clear();
    for (const PlanCandidate& candidate : plan.Candidates)
    {
      tried.push_back(candidate.Sizes[0]);
    }
    const PlanCandidate& choice = plan.Candidates[static_cast<std::size_t>(plan.Choice)];
    EXPECT_EQ(plan.Meets, choice.Error <= task.Tolerance);
    EXPECT_TRUE(choice.Integrator);
    // The best that costs at most four times a table; the choice where that is one of them.
    const PlanCandidate& quick = plan.Candidates[static_cast<std::size_t>(plan.Interactive)];
    EXPECT_LE(quick.Cost, 4.0);
    EXPECT_TRUE(quick.Integrator);
    EXPECT_EQ(choice.Cost <= 4.0, plan.Interactive == plan.Choice);
    return choice.Sizes[0];
  };
  using Rungs = std::vector<int>;
  EXPECT_EQ(run({ 0.01, 0.001, 0.001 }), 0);
  EXPECT_EQ(tried, Rungs({ 0 }));
  EXPECT_EQ(run({ 0.1, 0.09, 0.08, 0.01, 0.001 }), 3);
  EXPECT_EQ(tried, Rungs({ 0, 1, 2, 3 }));
  EXPECT_EQ(run({ 0.1, 0.09, 0.03, 0.08 }), 2); // nothing: the most accurate
  EXPECT_EQ(tried, Rungs({ 0, 1, 2, 3 }));
  EXPECT_EQ(run({ 0.1, std::nan(""), 0.01 }), 2);
  EXPECT_EQ(tried, Rungs({ 0, 2 }));

  // Whoever wants to see all gets the same choice; what is only listed is none.
  task.All = true;
  listed = { 1 };
  EXPECT_EQ(run({ 0.1, 0.001, 0.01, 0.001, 0.01 }), 2);
  EXPECT_EQ(tried, Rungs({ 0, 1, 2, 3, 4 }));
}

//------------------------------------------------------------------------------
// What takes too much memory with the textures of the material is passed over.
TEST(PlanSearch, PassesOverWhatDoesNotFit)
{
  measuredbrdf::PlanTask task = MakeTask(1000);
  const PlanComparison comparison = MakeComparison(20, false);
  std::vector<PlanCandidate> ladder = { MakeCandidate(0, 0.1, 0.1), MakeCandidate(1, 0.01, 0.01),
    MakeCandidate(2, 0.015, 0.015) };
  ladder[1].Bytes = 1001;
  measuredbrdf::Plan plan;
  Climb(task, comparison, ladder, plan);
  EXPECT_EQ(plan.Candidates.size(), 2u);
  EXPECT_EQ(plan.Candidates.back().Sizes[0], 2);
  task.IsAborted = []() { return true; };
  measuredbrdf::Plan stopped;
  EXPECT_THROW(Climb(task, comparison, ladder, stopped), PlanFailure);
}

//------------------------------------------------------------------------------
// One camera sees the pairs whose normal is z, another those where it is x.
TEST(PlanSearch, EstimatesSinglePictures)
{
  measuredbrdf::PlanTask task = MakeTask(1000);
  PlanComparison comparison = MakeComparison(40, false);
  for (vtkIdType k = 20; k < 40; ++k)
  {
    comparison.Pairs.Normals->SetTuple3(k, 1.0, 0.0, 0.0);
  }
  const auto run = [&]()
  {
    measuredbrdf::Plan plan;
    Climb(task, comparison, { MakeCandidate(1, 0.0039, 0.0273) }, plan);
    return plan.Candidates.front();
  };
  EXPECT_NEAR(run().Picture, run().Error, 1e-9); // all of it is one picture
  comparison.Pairs.Cameras = { { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 } };
  EXPECT_NEAR(run().Picture, 1.75 * run().Error, 1e-9);
  // What a cheap candidate has at the cameras says half of it.
  comparison.Pairs.Ratios = { 1.0, 1.0 };
  EXPECT_NEAR(run().Picture, std::sqrt(1.75) * run().Error, 1e-9);
}

//------------------------------------------------------------------------------
TEST(SharedCache, LendsToOneAndKeepsTheLastOnes)
{
  SharedCache<std::string, int> cache(2);
  cache.Put("a", 1);
  cache.Put("b", 2);
  EXPECT_EQ(cache.Find("a"), 1);
  EXPECT_EQ(cache.Take("b"), 2);
  EXPECT_FALSE(cache.Take("b")); // nobody else's until it is put back
  cache.Put("b", 3);
  EXPECT_EQ(cache.Find("a"), 1);
  cache.Put("c", 4);
  EXPECT_FALSE(cache.Find("b")); // used longest ago
  EXPECT_EQ(cache.Find("c"), 4);
}

//------------------------------------------------------------------------------
// A known material under another map: the same plan as if it were new.
TEST(Planner, KnownMaterialsChangeNoPlan)
{
  const auto known = NewEnvironment(0.1);
  const auto other = NewEnvironment(3.0);
  const auto plan = [](vtkBRDF* brdf, vtkEnvironment* environment)
  {
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(brdf);
    planner->SetEnvironment(environment);
    EXPECT_TRUE(planner->Update());
    std::string text = planner->GetDescription(planner->GetChoice());
    return text + " " + std::to_string(planner->GetPredictedError(planner->GetChoice()));
  };
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("violet-rubber"));
  const std::string expected = plan(brdf, other);
  plan(brdf, known);
  EXPECT_EQ(plan(brdf, other), expected);
}
