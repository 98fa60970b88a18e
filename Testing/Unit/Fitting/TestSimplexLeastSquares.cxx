// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Small least squares under constraints, against what is near their solutions and closed forms.

#include "LinearLeastSquares.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

//------------------------------------------------------------------------------
TEST(SimplexLeastSquares, NothingNearbyIsBetter)
{
  using namespace measuredbrdf;
  std::mt19937 random(7);
  const auto number = [&]() { return random() * 0x1p-32 - 0.5; };
  for (int trial = 0; trial < 300; ++trial)
  {
    const int n = 1 + trial % 5;
    SmallMatrix factor(n, n);
    SmallVector g(n);
    for (int a = 0; a < n; ++a)
    {
      g[a] = 2.0 * number();
      for (int b = 0; b < n; ++b)
      {
        factor(a, b) = number();
      }
    }
    const SmallMatrix H = factor.transpose() * factor + 1e-3 * SmallMatrix::Identity(n, n);
    const auto value = [&](const SmallVector& x) { return 0.5 * x.dot(H * x) - g.dot(x); };
    const SmallVector shares = SolveConstrained(H, g, UnknownsAre::Shares);
    const SmallVector free = SolveConstrained(H, g, UnknownsAre::NonNegative);
    EXPECT_NEAR(shares.sum(), 1.0, 1e-12);
    EXPECT_GE(shares.minCoeff(), 0.0);
    EXPECT_GE(free.minCoeff(), 0.0);
    // No point of a lattice is better, nor a small step from the solution towards it.
    for (int k = 0; k < 200; ++k)
    {
      SmallVector other(n);
      for (int a = 0; a < n; ++a)
      {
        other[a] = std::max(number(), 0.0);
      }
      EXPECT_GE(value(SmallVector(free + 0.01 * (other - free))), value(free) - 1e-12);
      if (other.sum() > 0.0)
      {
        other /= other.sum();
        EXPECT_GE(value(SmallVector(shares + 0.01 * (other - shares))), value(shares) - 1e-12);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(SimplexLeastSquares, VariancesAreThoseOfTheDifference)
{
  using namespace measuredbrdf;
  // One measured value, w_0 a + w_1 b: its variance over (a - b)^2.
  SmallMatrix H(2, 2);
  H << 9.0, 3.0, 3.0, 1.0;
  EXPECT_NEAR(GetShareVariances(H)[0], 0.25, 1e-12);
  H << 4.0, 4.0, 4.0, 4.0; // the same material twice
  EXPECT_TRUE(std::isinf(GetShareVariances(H)[1]));
}
