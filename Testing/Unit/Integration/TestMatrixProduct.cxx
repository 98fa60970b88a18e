// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What the synthesis of tables is made of: products in wide vectors, and kernels' harmonics that
// are kept for other sizes.

#include "LaneForms.h"
#include "LobeHarmonics.h"
#include "MaterialPrecomputation.h"
#include "SynthesisLanes.h"
#include "vtkBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace measuredbrdf;

//------------------------------------------------------------------------------
// Each second item, of columns that fill vectors in all ways; memory need not be aligned.
TEST(MatrixProduct, AgreesWithSumsInDouble)
{
  const std::size_t rows = 3 * ProductRows;
  for (const std::size_t columns : { 8u, 16u, 24u, 40u })
  {
    for (const std::size_t depth : { 0u, 1u, 77u })
    {
      const std::size_t leftStep = 2 * rows;
      const std::size_t rightStep = 2 * columns;
      std::vector<float> left(leftStep * depth + 1), right(rightStep * depth + 1);
      for (std::size_t k = 0; k < left.size(); ++k)
      {
        left[k] = static_cast<float>(std::sin(0.7 * static_cast<double>(k)));
      }
      for (std::size_t k = 0; k < right.size(); ++k)
      {
        right[k] = static_cast<float>(std::cos(1.3 * static_cast<double>(k)));
      }
      ForEachLaneForm(
        [&]()
        {
          std::vector<float> result(rows * columns + 2, -1.0f);
          Multiply({ left.data() + 1, leftStep }, { right.data() + 1, rightStep }, rows, depth,
            columns, result.data() + 1);
          for (std::size_t row = 0; row < rows; ++row)
          {
            for (std::size_t column = 0; column < columns; ++column)
            {
              double sum = 0.0;
              for (std::size_t k = 0; k < depth; ++k)
              {
                sum += static_cast<double>(left[1 + k * leftStep + row]) *
                       static_cast<double>(right[1 + k * rightStep + column]);
              }
              ASSERT_NEAR(static_cast<double>(result[1 + row * columns + column]), sum, 1e-5)
                << row << " " << column << " of " << columns << ", " << depth;
            }
          }
          EXPECT_EQ(result.front(), -1.0f);
          EXPECT_EQ(result.back(), -1.0f);
        });
    }
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
