// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a sample says of an error, the climb on the ladder, and what plans of one material share.

#include "MaterialPrecomputation.h"
#include "PlanSearch.h"
#include "RecentlyUsed.h"
#include "vtkBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using measuredbrdf::PlanCandidate;
using measuredbrdf::PlanComparison;
using measuredbrdf::SharedCache;

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
  void IntegratePart(int vtkNotUsed(part), const double n[3], const double vtkNotUsed(o)[3],
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
    EXPECT_TRUE(Climb(
      task, comparison, ladder, plan, [&last](double share) { last = std::max(last, share); }))
      << task.Problem;
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
  ASSERT_TRUE(Climb(task, comparison, ladder, plan));
  EXPECT_EQ(plan.Candidates.size(), 2u);
  EXPECT_EQ(plan.Candidates.back().Sizes[0], 2);
  task.IsAborted = []() { return true; };
  measuredbrdf::Plan stopped;
  EXPECT_FALSE(Climb(task, comparison, ladder, stopped));
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
    EXPECT_TRUE(Climb(task, comparison, { MakeCandidate(1, 0.0039, 0.0273) }, plan));
    return plan.Candidates.front();
  };
  EXPECT_NEAR(run().Picture, run().Error, 1e-9); // all of it is one picture
  comparison.Pairs.Cameras = { 0.0, 0.0, 1.0, 1.0, 0.0, 0.0 };
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
