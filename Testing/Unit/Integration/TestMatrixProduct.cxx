// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What the synthesis of tables is made of: sums in wide vectors, and kernels' harmonics that are
// kept for other sizes.

#include "LaneForms.h"
#include "LobeHarmonics.h"
#include "MaterialPrecomputation.h"
#include "ParallelFor.h"
#include "SpherePairs.h"
#include "vtkBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkSmartPointer.h"
#include "vtkTableRadianceIntegrator.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace measuredbrdf;

//------------------------------------------------------------------------------
// Products, transforms, Wigner's functions and the limiter of dark rings, in a table with tiles and
// in maps; with all vectors that the processor has they give what TableReference expects.
TEST(MaterialPrecomputation, TablesAreTheSameInAllVectors)
{
  SpherePairs pairs;
  pairs.AddRandom(60);
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("nickel"));
  for (const std::vector<int>& sizes : { std::vector<int>{ 121, 4, 9 }, { 17, 5, 8 } })
  {
    std::vector<std::vector<glm::dvec3>> results;
    ForEachLaneForm(
      [&]()
      {
        vtkNew<vtkTableRadianceIntegrator> table;
        table->SetSizes(sizes);
        table->SetNumberOfMaps(sizes[0] > 100 ? 0 : 4);
        table->SetNumberOfMapRows(29); // 58 columns: a factor that is no power of two
        table->SetBRDF(brdf);
        table->SetEnvironment(NewSmallEnvironment(true));
        results.push_back(pairs.Integrate(table));
      });
    EXPECT_LT(GetRelativeError(results.front(), results.back()), 1e-4);
  }
}

//------------------------------------------------------------------------------
// Smaller sizes are parts of larger ones, and larger ones are made anew.
TEST(MaterialPrecomputation, KeepsExpandedKernels)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("nickel"));
  brdf->Prepare();
  const std::atomic<bool> never{ false };
  MaterialPrecomputation parts;
  const LobeViews& views = parts.GetViews(brdf, never);
  MaterialKernels& kernels = parts.GetKernels(brdf, { 4, 32 }, never);
  const auto expand = [&](int degree, int orders)
  {
    std::vector<TurnedLobe> lobes;
    for (int k = 0; k < 4; ++k)
    {
      lobes.push_back({ &kernels.At[k], views.GetAxis(LobeViews::GetKnotAngle(k, 4)) });
    }
    return ExpandLobes(lobes, degree, orders);
  };
  const int sizes[][2] = { { 20, 4 }, { 12, 2 }, { 30, 3 }, { 30, 4 }, { 9, 0 } };
  for (const auto& [degree, orders] : sizes)
  {
    const auto wanted = expand(degree, orders);
    const auto known = kernels.Expand(degree, orders);
    ASSERT_EQ(known.size(), wanted.size());
    for (std::size_t k = 0; k < known.size(); ++k)
    {
      ASSERT_EQ(known[k].size(), wanted[k].size());
      for (std::size_t n = 0; n < known[k].size(); ++n)
      {
        ASSERT_NEAR(known[k][n], wanted[k][n], 1e-6f) << degree << " " << orders << ": " << n;
      }
    }
  }
}

//------------------------------------------------------------------------------
// Where loops throw, for lack of memory say, nothing half made is kept.
TEST(MaterialPrecomputation, KeepsWholeKernelsOnly)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("nickel"));
  brdf->Prepare();
  const std::atomic<bool> never{ false };
  MaterialPrecomputation parts, others;
  parts.GetViews(brdf, never);
  const auto expectThrown = [](const auto& work)
  {
    std::atomic<int> begun{ 0 };
    const StoppableLoops loops([&begun]() { return ++begun > 1; });
    EXPECT_THROW(work(), std::runtime_error);
  };
  expectThrown([&]() { parts.GetKernels(brdf, { 4, 32 }, never); });
  MaterialKernels& kernels = parts.GetKernels(brdf, { 4, 32 }, never);
  expectThrown([&]() { kernels.Expand(12, 2); });
  EXPECT_EQ(kernels.Expand(12, 2), others.GetKernels(brdf, { 4, 32 }, never).Expand(12, 2));
}

//------------------------------------------------------------------------------
// Without nodes, kernels serve what was expanded, and are made again for all else.
TEST(MaterialPrecomputation, MakesForgottenNodesAgain)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("nickel"));
  brdf->Prepare();
  const std::atomic<bool> never{ false };
  MaterialPrecomputation parts;
  const auto get = [&](const MaterialPrecomputation::Use& use) -> auto&
  {
    return parts.GetKernels(brdf, { 4, 32 }, never, use);
  };
  const auto expected = get({}).Expand(20, 4);
  const glm::dvec3 amplitude = get({}).At[1].Means.Amplitude;
  const auto forget = [&](int mostAngles, int mostNodes)
  {
    parts.Trim(mostAngles, mostNodes);
    EXPECT_FALSE(get({ false, 20, 4 }).At[1].HasNodes());
    EXPECT_FALSE(get({ false, 12, 2 }).At[1].HasNodes());
  };
  forget(3, 1024);
  EXPECT_EQ(get({ false, 20, 4 }).At[1].Means.Amplitude, amplitude);
  EXPECT_EQ(get({ false, 20, 4 }).Expand(20, 4), expected);
  EXPECT_TRUE(get({}).At[1].HasNodes());
  EXPECT_EQ(get({}).Expand(20, 4), expected);
  forget(4, 31);
  EXPECT_TRUE(get({ false, 21, 4 }).At[1].HasNodes());
  forget(3, 1024);
  EXPECT_TRUE(get({ false, 20, 5 }).At[1].HasNodes());
  const auto more = get({ false, 20, 5 }).Expand(20, 5);
  for (std::size_t k = 0; k < expected[1].size(); ++k)
  {
    ASSERT_NEAR(more[1][k], expected[1][k], 1e-6f);
  }
}
