// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// How a search weighs what a sample says: pooled samples, choices by luck, and what plans of one
// material share.

#include "MaterialStore.h"
#include "PlanComparison.h"
#include "PlanSearch.h"
#include "TableCandidates.h"
#include "vtkBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using measuredbrdf::MaterialStore;
using measuredbrdf::PlanCandidate;
using measuredbrdf::PlanComparison;

namespace
{
// Radiance 1 + Errors[0] where the normal is z, 1 + Errors[1] where it is x.
class Wrong : public vtkRadianceIntegrator
{
public:
  static Wrong* New();
  vtkTypeMacro(Wrong, vtkRadianceIntegrator);
  double Errors[2] = { 0.0, 0.0 };
  double Pruned = 0.0; // for errors up to this one
  bool CanPrune(const std::vector<Attempt>&, double error) override
  {
    return error <= this->Pruned;
  }

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

constexpr double TextureUnits = 0.0013; // what each comparison adds for them

// At 2 %.
measuredbrdf::PlanTask MakeTask(vtkIdType maximumBytes)
{
  measuredbrdf::PlanTask task;
  task.BRDF = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("pink-felt"));
  task.Tolerance = 0.02;
  task.MaximumBytes = maximumBytes;
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
TEST(PlanComparison, PoolsSamplesAndAddsTheReferencesError)
{
  PlanComparison first = MakeComparison(2, false);
  first.Pairs.Weights = { 1.0, 3.0 };
  PlanComparison second = MakeComparison(1, false);
  second.Pairs.Weights = { 4.0 };
  second.ReferenceError = 0.03;
  vtkNew<vtkDoubleArray> radiance, other;
  radiance->SetNumberOfComponents(3);
  other->SetNumberOfComponents(3);
  radiance->InsertNextTuple3(1.1, 0.9, 1.1); // differences of 0.3, 0, 0.12 of 3
  radiance->InsertNextTuple3(1.0, 1.0, 1.0);
  other->InsertNextTuple3(1.04, 1.04, 0.96);
  const auto found = measuredbrdf::Compare({ &first, &second }, { radiance, other });
  const double error = (0.3 + 4.0 * 0.12) / 24.0;
  const double squares =
    std::pow(0.3 - 3.0 * error, 2) + std::pow(9.0 * error, 2) + std::pow(0.48 - 12.0 * error, 2);
  EXPECT_NEAR(
    found.Uncertainty, std::hypot(2.0 * std::sqrt(squares) / 24.0, 0.03, TextureUnits), 1e-12);
  EXPECT_NEAR(found.Error, error + found.Uncertainty, 1e-12);
}

//------------------------------------------------------------------------------
// Pairs about the same point, in both samples, are no draws of their own: residues are summed
// first.
TEST(PlanComparison, KnowsWhatLiesAboutTheSamePoint)
{
  PlanComparison first = MakeComparison(3, false);
  first.Pairs.Points = { 4, 4, 0 };
  first.Pairs.Weights = { 1.0, 2.0, 1.0 };
  PlanComparison second = MakeComparison(1, false);
  second.Pairs.Points = { 4 };
  vtkNew<vtkDoubleArray> radiance, other;
  radiance->SetNumberOfComponents(3);
  other->SetNumberOfComponents(3);
  radiance->InsertNextTuple3(1.1, 0.9, 1.1); // differences of 0.3, 0.3, 0, 0.12 of 3
  radiance->InsertNextTuple3(1.1, 0.9, 1.1);
  radiance->InsertNextTuple3(1.0, 1.0, 1.0);
  other->InsertNextTuple3(1.04, 1.04, 0.96);
  const auto found = measuredbrdf::Compare({ &first, &second }, { radiance, other });
  const double error = 1.02 / 15.0;
  const double squares = std::pow(1.02 - 12.0 * error, 2) + std::pow(3.0 * error, 2);
  EXPECT_NEAR(found.Uncertainty, std::hypot(2.0 * std::sqrt(squares) / 15.0, TextureUnits), 1e-12);
  EXPECT_NEAR(found.Error, error + found.Uncertainty, 1e-12);
}

//------------------------------------------------------------------------------
// Where the tolerance is missed, more than 12 MB have to leave two thirds of the error, and a tenth
// less.
TEST(PlanSearch, WeighsMemoryWhereNothingMeets)
{
  measuredbrdf::PlanTask task = MakeTask(96000000);
  const PlanComparison comparison = MakeComparison(20, false);
  const auto make = [](double error, vtkIdType bytes, double pruned = 0.0)
  {
    PlanCandidate candidate = MakeCandidate(1, error, error);
    candidate.Method = "table"; // one that a search knows
    candidate.Bytes = bytes;
    Wrong::SafeDownCast(candidate.Integrator)->Pruned = pruned;
    return candidate;
  };
  const auto run = [&](const std::vector<PlanCandidate>& candidates)
  {
    measuredbrdf::PlanSearch search(task, comparison, []() { return false; });
    EXPECT_TRUE(search.Run(candidates)) << search.GetProblem();
    return search.GetPlan();
  };
  constexpr vtkIdType small = 11900000;
  constexpr vtkIdType large = 17000000;
  EXPECT_EQ(run({ make(0.5, 1000), make(0.2, small), make(0.13, large) }).Choice, 1);
  EXPECT_EQ(run({ make(0.5, 1000), make(0.2, small), make(0.11, large) }).Choice, 2);
  EXPECT_EQ(run({ make(0.5, 1000), make(0.15, large), make(0.19, small) }).Choice, 2);
  EXPECT_EQ(run({ make(0.5, 1000), make(0.15, large), make(0.21, small) }).Choice, 1);
  const measuredbrdf::Plan meeting =
    run({ make(0.5, 1000), make(0.03, small), make(0.0185, large) });
  EXPECT_EQ(meeting.Choice, 2);
  EXPECT_TRUE(meeting.Meets);

  // Of those that were skipped the largest of these is tried in the end.
  const measuredbrdf::Plan skipped =
    run({ make(0.5, 1000), make(0.3, 5000, 0.02), make(0.2, small, 0.02), make(0.1, large, 0.02) });
  ASSERT_EQ(skipped.Candidates.size(), 2u);
  EXPECT_EQ(skipped.Candidates[1].Bytes, small);
  EXPECT_EQ(skipped.Choice, 1);
}

//------------------------------------------------------------------------------
// The fifth looks good on the pairs that all are compared on, and is not: the sixth is chosen. With
// fewer tried before, or far below the tolerance, no other pairs are asked for.
TEST(PlanSearch, DoesNotTakeLuckForMerit)
{
  measuredbrdf::PlanTask task = MakeTask(1000);
  PlanComparison first = MakeComparison(20, false);
  first.ReferenceError = 1e-3; // some uncertainty: here all pairs have the same error
  PlanComparison second = MakeComparison(20, true);
  const auto run = [&](const std::vector<PlanCandidate>& candidates, int& asked)
  {
    measuredbrdf::PlanSearch search(task, first, []() { return false; });
    search.GetSecond = [&]()
    {
      ++asked;
      return &second;
    };
    EXPECT_TRUE(search.Run(candidates)) << search.GetProblem();
    return search.GetPlan();
  };
  int asked = 0;
  const std::vector<PlanCandidate> many = { MakeCandidate(1, 0.5, 0.5), MakeCandidate(2, 0.4, 0.4),
    MakeCandidate(3, 0.3, 0.3), MakeCandidate(4, 0.2, 0.2), MakeCandidate(5, 0.0183, 0.06),
    MakeCandidate(6, 0.0183, 0.017) };
  const measuredbrdf::Plan plan = run(many, asked);
  EXPECT_EQ(plan.Choice, 5);
  EXPECT_TRUE(plan.Meets);
  EXPECT_EQ(asked, 2);
  EXPECT_NEAR(plan.Candidates[5].Error - plan.Candidates[5].Uncertainty, 0.01765, 1e-9);
  EXPECT_NEAR(plan.Candidates[4].Error - plan.Candidates[4].Uncertainty, 0.03915, 1e-9);

  asked = 0;
  EXPECT_EQ(run({ MakeCandidate(1, 0.5, 0.5), MakeCandidate(2, 0.0183, 0.06) }, asked).Choice, 1);
  EXPECT_EQ(asked, 0);
  const std::vector<PlanCandidate> sure = { MakeCandidate(1, 0.5, 0.5), MakeCandidate(2, 0.4, 0.4),
    MakeCandidate(3, 0.3, 0.3), MakeCandidate(4, 0.01, 0.06) };
  EXPECT_EQ(run(sure, asked).Choice, 3);
  EXPECT_EQ(asked, 0);

  // The best that misses says what it has on both, too.
  const std::vector<PlanCandidate> missed(many.begin(), many.begin() + 4);
  const measuredbrdf::Plan best = run(missed, asked);
  EXPECT_EQ(asked, 1);
  EXPECT_FALSE(best.Meets);
  asked = 0;
  std::vector<PlanCandidate> unlucky = missed;
  unlucky.push_back(MakeCandidate(5, 0.0203, 0.015));
  EXPECT_TRUE(run(unlucky, asked).Meets);
  EXPECT_EQ(asked, 1);
}

//------------------------------------------------------------------------------
// What misses the tolerance by no more than stands for chance is compared on other pairs, too,
// before a candidate that costs clearly more is tried; and that is not tried if chance may be all,
// and it would take twice the frame of the cheapest.
TEST(PlanSearch, LooksTwiceAtNearMisses)
{
  measuredbrdf::PlanTask task = MakeTask(1000);
  PlanComparison first = MakeComparison(20, false);
  first.ReferenceError = 1e-3;
  PlanComparison second = MakeComparison(20, true);
  int asked = 0;
  const auto run = [&](double onSecond, double cost)
  {
    asked = 0;
    std::vector<PlanCandidate> candidates = { MakeCandidate(1, 0.5, 0.5),
      MakeCandidate(2, 0.4, 0.4), MakeCandidate(3, 0.3, 0.3), MakeCandidate(4, 0.0195, onSecond),
      MakeCandidate(5, 0.001, 0.001) };
    for (PlanCandidate& candidate : candidates)
    {
      candidate.Cost = 1.0;
    }
    candidates.back().Cost = cost;
    measuredbrdf::PlanSearch search(task, first, []() { return false; });
    search.GetSecond = [&]()
    {
      ++asked;
      return &second;
    };
    EXPECT_TRUE(search.Run(candidates)) << search.GetProblem();
    return search.GetPlan();
  };
  const measuredbrdf::Plan near = run(0.017, 1.1);
  EXPECT_EQ(near.Choice, 3);
  EXPECT_TRUE(near.Meets);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(run(0.017, 1.0).Choice, 4); // which costs no more
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(run(0.03, 1.1).Choice, 4); // luck
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(run(0.03, 2.1).Choice, 4);
  EXPECT_EQ(run(0.0195, 1.9).Choice, 4); // not on both
  const measuredbrdf::Plan kept = run(0.0195, 2.1);
  EXPECT_EQ(kept.Choice, 3);
  EXPECT_FALSE(kept.Meets);
  EXPECT_EQ(kept.Candidates.size(), 4u);
}

//------------------------------------------------------------------------------
// Whoever wants to see all candidates gets the same choice: the others are only listed, each in its
// place, whether the search left them out, had found enough, or keeps them for the end.
TEST(PlanSearch, ChoosesTheSameWhereAllAreTried)
{
  measuredbrdf::PlanTask task = MakeTask(1000);
  PlanComparison first = MakeComparison(20, false);
  first.ReferenceError = 1e-3;
  PlanComparison second = MakeComparison(20, true);
  const auto run = [&](bool all, double luck, std::size_t count = 8)
  {
    std::vector<PlanCandidate> candidates = { MakeCandidate(1, 0.5, 0.5),
      MakeCandidate(2, 0.015, 0.015), MakeCandidate(3, 0.4, 0.4), MakeCandidate(4, 0.3, 0.3),
      MakeCandidate(5, 0.2, 0.2), MakeCandidate(6, 0.0183, luck), MakeCandidate(7, 0.01, 0.01),
      MakeCandidate(8, 0.001, 0.001) };
    Wrong::SafeDownCast(candidates[1].Integrator)->Pruned = 1.0; // its rules take it for hopeless
    candidates.resize(count);
    task.All = all;
    PlanCandidate listed = MakeCandidate(9, 0.001, 0.001); // only
    listed.MayBeChosen = false;
    if (all)
    {
      candidates.insert(candidates.begin(), listed);
    }
    measuredbrdf::PlanSearch search(task, first, []() { return false; });
    search.GetSecond = [&]() { return &second; };
    double last = 0.0;
    search.Progress = [&last](double share)
    {
      EXPECT_GE(share, last);
      last = share;
    };
    EXPECT_TRUE(search.Run(candidates)) << search.GetProblem();
    return search.GetPlan();
  };
  for (const double luck : { 0.017, 0.06 }) // is its error on the other sample
  {
    const measuredbrdf::Plan quick = run(false, luck);
    const measuredbrdf::Plan whole = run(true, luck);
    ASSERT_EQ(whole.Candidates.size(), 9u);
    ASSERT_EQ(whole.Choice, luck < 0.02 ? 6 : 7);
    EXPECT_EQ(whole.First, whole.Choice);
    const PlanCandidate& chosen = whole.Candidates[static_cast<std::size_t>(whole.Choice)];
    EXPECT_TRUE(chosen.Integrator);
    EXPECT_EQ(chosen.Sizes, quick.Candidates[static_cast<std::size_t>(quick.Choice)].Sizes);
    EXPECT_NEAR(whole.Candidates[2].Error - whole.Candidates[2].Uncertainty, 0.015, 5e-3);
    EXPECT_FALSE(whole.Candidates[2].Integrator);
  }
  // Not even where what is hopeless by its rules is all that meets the tolerance.
  for (const bool all : { false, true })
  {
    const measuredbrdf::Plan missed = run(all, 0.06, 5);
    EXPECT_FALSE(missed.Meets);
    EXPECT_EQ(missed.Candidates.size(), all ? 6u : 4u);
    EXPECT_EQ(missed.Candidates[static_cast<std::size_t>(missed.Choice)].Sizes[0], 5);
  }
}

//------------------------------------------------------------------------------
// One camera sees the pairs whose normal is z, another those where it is x. What meets the
// tolerance in the mean of both gives way to what does so in each, if that costs little.
TEST(PlanSearch, HoldsInSinglePictures)
{
  measuredbrdf::PlanTask task = MakeTask(96000000);
  PlanComparison comparison = MakeComparison(40, false);
  for (vtkIdType k = 20; k < 40; ++k)
  {
    comparison.Pairs.Normals->SetTuple3(k, 1.0, 0.0, 0.0);
  }
  const auto run = [&](double z, double x, vtkIdType bytes = 2000000, double cost = 1.0)
  {
    std::vector<PlanCandidate> candidates = { MakeCandidate(1, 0.0039, 0.0273),
      MakeCandidate(2, z, x) };
    candidates[0].Cost = 1.0;
    candidates[1].Cost = cost;
    candidates[1].Bytes = bytes;
    measuredbrdf::PlanSearch search(task, comparison, []() { return false; });
    EXPECT_TRUE(search.Run(candidates)) << search.GetProblem();
    EXPECT_TRUE(search.GetPlan().Meets);
    return search.GetPlan();
  };
  EXPECT_EQ(run(0.012, 0.012).Choice, 0); // all of it is one picture
  comparison.Pairs.Cameras = { 0.0, 0.0, 1.0, 1.0, 0.0, 0.0 };
  const measuredbrdf::Plan plan = run(0.012, 0.012);
  EXPECT_EQ(plan.Choice, 1);
  EXPECT_NEAR(plan.Candidates[0].Picture, 1.75 * plan.Candidates[0].Error, 1e-9);
  EXPECT_NEAR(plan.Candidates[1].Picture, plan.Candidates[1].Error, 1e-9);
  EXPECT_EQ(plan.First, 0);
  EXPECT_EQ(run(0.012, 0.012, 4100000).Choice, 0);
  EXPECT_EQ(run(0.012, 0.012, 2000000, 1.1).Choice, 0);
  EXPECT_EQ(run(0.004, 0.020).Choice, 0);   // little is gained
  EXPECT_EQ(run(0.0029, 0.0174).Choice, 1); // two thirds of what a picture has

  // What a cheap candidate has at the cameras says half of it.
  comparison.Pairs.Ratios = { 1.0, 1.0 };
  const measuredbrdf::Plan milder = run(0.012, 0.012);
  EXPECT_NEAR(milder.Candidates[0].Picture, std::sqrt(1.75) * milder.Candidates[0].Error, 1e-9);
}

//------------------------------------------------------------------------------
TEST(MaterialStore, KeepsTheLastOnes)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("pink-felt"));
  brdf->Prepare();
  const std::atomic<bool> never{ false };
  const auto make = [&](MaterialStore& store, const std::string& key)
  {
    MaterialStore::Parts parts = store.Take(key);
    parts->GetKernels(brdf, 8, 16, never);
    parts->GetKernels(brdf, 24, 16, never); // which are not kept
    store.PutBack(key, parts);
    return parts.get();
  };
  MaterialStore one(1000000);
  make(one, "a");
  const std::size_t bytes = one.GetBytes();
  EXPECT_GT(bytes, 8 * 16 * 16 * sizeof(double) * 3);
  EXPECT_LT(bytes, 1.5 * 8 * 16 * 16 * sizeof(double) * 3);
  MaterialStore two(bytes * 5 / 2);
  const auto* a = make(two, "a");
  make(two, "b");
  EXPECT_EQ(two.GetBytes(), 2 * bytes);
  const MaterialStore::Parts taken = two.Take("a");
  EXPECT_EQ(taken.get(), a);
  EXPECT_NE(two.Take("a").get(), a); // nobody else's
  EXPECT_EQ(two.GetBytes(), bytes);
  two.PutBack("a", taken);
  make(two, "c"); // b goes
  EXPECT_EQ(two.GetBytes(), 2 * bytes);
  EXPECT_EQ(two.Take("a").get(), a);
  make(two, ""); // says not what it is
  EXPECT_EQ(two.GetBytes(), bytes);
}

//------------------------------------------------------------------------------
// What large tables' kernels were expanded to goes before any material does, the oldest one's
// first.
TEST(MaterialStore, ForgetsWhatFewPlansNeedFirst)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("pink-felt"));
  brdf->Prepare();
  const std::atomic<bool> never{ false };
  constexpr std::size_t expanded = 24 * 3 * 9 * 61 * sizeof(float);
  const auto make = [&](MaterialStore& store, const std::string& key)
  {
    const std::size_t before = store.GetBytes();
    MaterialStore::Parts parts = store.Take(key);
    parts->GetViews(brdf, never);
    parts->GetExpanded(parts->GetKernels(brdf, 24, 16, never), 60, 8);
    store.PutBack(key, parts);
    return store.GetBytes() - before;
  };
  MaterialStore roomy(100000000);
  const std::size_t whole = make(roomy, "a");
  EXPECT_GT(whole, expanded);
  EXPECT_EQ(make(roomy, "b"), whole);
  MaterialStore store(2 * whole + whole - expanded);
  make(store, "a");
  make(store, "b");
  EXPECT_EQ(store.GetBytes(), 2 * whole);
  make(store, "c");
  EXPECT_LT(store.GetBytes(), 3 * whole - 2 * expanded + expanded / 2);
  EXPECT_GT(store.GetBytes(), whole + (whole - expanded)); // all three
  const auto isExpanded = [&](const char* key)
  {
    const MaterialStore::Parts parts = store.Take(key);
    return !parts->GetKernels(brdf, 24, 16, never, { false, 60, 8 })[0]->HasNodes();
  };
  EXPECT_FALSE(isExpanded("a"));
  EXPECT_FALSE(isExpanded("b"));
  EXPECT_TRUE(isExpanded("c"));
}

//------------------------------------------------------------------------------
// A known material under another map: the same plan as if it were new.
TEST(MaterialStore, ChangesNoPlan)
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
  MaterialStore::Get().Take(brdf->GetContentKey()); // nothing known
  const std::string expected = plan(brdf, other);
  plan(brdf, known);
  EXPECT_GT(MaterialStore::Get().GetBytes(), 100000u);
  EXPECT_EQ(plan(brdf, other), expected);
  EXPECT_LE(MaterialStore::Get().GetBytes(), MaterialStore::MostBytes);
}

//------------------------------------------------------------------------------
// More maps of no more rows are left out where fewer are too far away, not where rows were missing.
TEST(MapCandidates, TooManyAreLeftOut)
{
  using Attempts = std::vector<vtkRadianceIntegrator::Attempt>;
  const Attempts far = { { { 256, 12, 8, 4, 0, 0 }, 0.06 } };
  EXPECT_TRUE(measuredbrdf::CanPruneMaps(256, 8, far, {}, 0.02));
  EXPECT_TRUE(measuredbrdf::CanPruneMaps(128, 16, far, {}, 0.02));
  const Attempts near = { { { 256, 12, 8, 4, 0, 0 }, 0.025 } };
  EXPECT_FALSE(measuredbrdf::CanPruneMaps(256, 8, near, {}, 0.02));
  const Attempts coarse = { { { 128, 12, 8, 4, 0, 0 }, 0.36 } };
  EXPECT_FALSE(measuredbrdf::CanPruneMaps(256, 4, coarse, {}, 0.01));
}

//------------------------------------------------------------------------------
// What a table of fewer rows shows not to be a matter of rows, more maps must leave little of.
TEST(MapCandidates, AreLeftOutWhereFewerRowsHaveMore)
{
  using Attempts = std::vector<vtkRadianceIntegrator::Attempt>;
  const Attempts four = { { { 128, 12, 8, 4, 0, 0 }, 0.123 } };
  const auto table = [](int rows, double error) {
    return Attempts{ { { rows, 12, 16, 0, 0, 0 }, error } };
  };
  EXPECT_FALSE(measuredbrdf::CanPruneMaps(256, 4, four, {}, 0.02));
  EXPECT_TRUE(measuredbrdf::CanPruneMaps(256, 4, four, table(65, 0.03), 0.02));
  EXPECT_TRUE(measuredbrdf::CanPruneMaps(256, 8, four, table(65, 0.03), 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneMaps(256, 4, four, table(65, 0.11), 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneMaps(256, 4, four, table(129, 0.03), 0.02)); // not fewer
  EXPECT_FALSE(measuredbrdf::CanPruneMaps(256, 16, four, table(65, 0.08), 0.02)); // 0.6^2 of it
}

//------------------------------------------------------------------------------
// Without lights they gain what a table's rows do, and that is known from tables of few view
// angles, or these are hopeless. Beside lights no such table is tried.
TEST(MapCandidates, AreLeftOutWhereRowsOfTablesGainLittle)
{
  using Attempts = std::vector<vtkRadianceIntegrator::Attempt>;
  const auto areLeftOut = [](double coarse, double fine)
  {
    const Attempts tables = { { { 65, 8, 8 }, coarse }, { { 257, 8, 8 }, fine } };
    return measuredbrdf::CanPruneMapsAlone(tables, 0.02);
  };
  EXPECT_FALSE(areLeftOut(0.1, 0.055));
  EXPECT_TRUE(areLeftOut(0.1, 0.07));
  EXPECT_FALSE(areLeftOut(0.04, 0.029)); // near the tolerance
  EXPECT_FALSE(measuredbrdf::CanPruneMapsAlone({ { { 257, 8, 8 }, 0.1 } }, 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneMapsAlone({}, 0.02));
  const auto ofViews = [](double few) {
    return Attempts{ { { 65, 8, 8, 0, 0, 12 }, few }, { { 49, 12, 16, 0, 0, 12 }, 0.035 } };
  };
  EXPECT_TRUE(measuredbrdf::CanPruneMapsAlone(ofViews(0.063), 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneMapsAlone(ofViews(0.051), 0.02));
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  EXPECT_TRUE(hybrid->SetSizes({ 256, 12, 8, 4, 0, 12 }));
  EXPECT_TRUE(hybrid->CanPrune(ofViews(0.063), 0.02));
  EXPECT_FALSE(hybrid->CanPrune(ofViews(0.051), 0.02));
  EXPECT_TRUE(hybrid->SetSizes({ 256, 12, 8, 4, 16, 12 }));
  Attempts besideLights = ofViews(0.063);
  for (vtkRadianceIntegrator::Attempt& attempt : besideLights)
  {
    attempt.Sizes[4] = 16;
  }
  EXPECT_FALSE(hybrid->CanPrune(besideLights, 0.02));
}

//------------------------------------------------------------------------------
// A table alone is a hybrid without lights and maps.
TEST(MapCandidates, LearnFromTables)
{
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  EXPECT_TRUE(hybrid->SetSizes({ 256, 12, 8, 4, 0, 12 }));
  const std::vector<int> sizes = hybrid->GetEquivalentSizes("table", { 65, 12, 16 });
  EXPECT_EQ(sizes, (std::vector<int>{ 65, 12, 16, 0, 0, 12 }));
  EXPECT_TRUE(hybrid->GetEquivalentSizes("filtered", { 16 }).empty());
  std::vector<vtkRadianceIntegrator::Attempt> attempts = { { { 128, 12, 8, 4, 0, 12 }, 0.123 } };
  EXPECT_FALSE(hybrid->CanPrune(attempts, 0.02));
  attempts.push_back({ sizes, 0.03 });
  EXPECT_TRUE(hybrid->CanPrune(attempts, 0.02));
}

// From one table with tiles to another an error falls by little more than half, not to the fourth
// part that twice the view angles bring to others.
TEST(TableCandidates, WithTilesGainLittle)
{
  const std::vector<int> larger = { 257, 24, 16 };
  const auto tried = [](std::vector<int> sizes, double error) {
    return std::vector<vtkRadianceIntegrator::Attempt>{ { std::move(sizes), error } };
  };
  EXPECT_TRUE(measuredbrdf::CanPruneTable(larger, tried({ 257, 12, 16 }, 0.053), 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneTable(larger, tried({ 257, 12, 16 }, 0.05), 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneTable({ 65, 24, 16 }, tried({ 65, 12, 16 }, 0.07), 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneTable(larger, tried({ 129, 12, 16 }, 0.07), 0.02));
}

//------------------------------------------------------------------------------
// More rows do not bring what more view angles brought with fewer, and the other way round.
TEST(TableCandidates, AreLeftOutWhereAnotherSizeDecides)
{
  using Attempts = std::vector<vtkRadianceIntegrator::Attempt>;
  const Attempts views = { { { 65, 8, 8 }, 0.063 }, { { 49, 12, 16 }, 0.035 } };
  EXPECT_TRUE(measuredbrdf::CanPruneTable({ 257, 8, 8 }, views, 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneTable({ 129, 12, 16 }, views, 0.02));
  const Attempts less = { { { 65, 8, 8 }, 0.051 }, { { 49, 12, 16 }, 0.035 } };
  EXPECT_FALSE(measuredbrdf::CanPruneTable({ 257, 8, 8 }, less, 0.02));
  const Attempts finer = { { { 65, 8, 8 }, 0.063 }, { { 129, 12, 16 }, 0.035 } };
  EXPECT_TRUE(measuredbrdf::CanPruneTable({ 257, 8, 8 }, finer, 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneTable({ 161, 8, 8 }, finer, 0.02)); // the rows may have it
  const Attempts rows = { { { 65, 12, 16 }, 0.052 }, { { 129, 8, 8 }, 0.031 } };
  EXPECT_TRUE(measuredbrdf::CanPruneTable({ 65, 20, 16 }, rows, 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneTable({ 129, 20, 16 }, rows, 0.02));
}

//------------------------------------------------------------------------------
// Where rows gained a third for each doubling, twice as many do not divide the error by three. More
// view angles help with their part of it only.
TEST(TableCandidates, AreLeftOutWhereRowsGainedLittle)
{
  using Attempts = std::vector<vtkRadianceIntegrator::Attempt>;
  const Attempts slow = { { { 65, 12, 16 }, 0.09 }, { { 129, 12, 16 }, 0.06 } };
  EXPECT_TRUE(measuredbrdf::CanPruneTable({ 257, 12, 16 }, slow, 0.02));
  EXPECT_FALSE(measuredbrdf::CanPruneTable({ 257, 24, 16 }, slow, 0.02));
  const Attempts worse = { { { 65, 12, 16 }, 0.13 }, { { 129, 12, 16 }, 0.085 } };
  EXPECT_TRUE(measuredbrdf::CanPruneTable({ 257, 24, 16 }, worse, 0.02));
  const Attempts quick = { { { 65, 12, 16 }, 0.09 }, { { 129, 12, 16 }, 0.05 } };
  EXPECT_FALSE(measuredbrdf::CanPruneTable({ 257, 12, 16 }, quick, 0.02));
  const Attempts few = { { { 17, 8, 8 }, 0.05 }, { { 33, 8, 8 }, 0.04 } };
  EXPECT_FALSE(measuredbrdf::CanPruneTable({ 65, 8, 8 }, few, 0.02)); // these show little yet
}
