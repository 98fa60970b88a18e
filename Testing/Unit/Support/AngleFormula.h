// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A formula of angles that tables of readings interpolate exactly, and comparisons with it.
 */

#ifndef AngleFormula_h
#define AngleFormula_h

#include "TestDirections.h"
#include "vtkBRDF.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace testio
{
/// f of light and view in degrees.
inline glm::dvec3 EvaluateAt(vtkBRDF* brdf, double thetaI, double phiI, double thetaO, double phiO)
{
  return Evaluate(brdf, FromDegrees(thetaI, phiI), FromDegrees(thetaO, phiO));
}

/// Linear in each angle, and one value along the normals: interpolation between any nodes is exact.
inline double Shape(double thetaI, double thetaO, double phi)
{
  const double tent = std::abs(std::remainder(phi, 360.0)) / 180.0;
  return 0.05 + 0.001 * thetaI + 0.0005 * thetaO + 1e-5 * thetaI * thetaO * tent;
}

/// Largest and root mean square difference from the color times the formula.
inline void Compare(
  vtkBRDF* brdf, const double color[3], double horizon, double& largest, double& rms)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  largest = 0.0;
  double sum = 0.0;
  constexpr int pairs = 1000;
  for (int k = 0; k < pairs; ++k)
  {
    const double light = 360.0 * number(random);
    const double angles[3] = { horizon * number(random), horizon * number(random),
      360.0 * number(random) };
    const glm::dvec3 f = EvaluateAt(brdf, angles[0], light, angles[1], light + angles[2]);
    for (int c = 0; c < 3; ++c)
    {
      const double difference = f[c] - color[c] * Shape(angles[0], angles[1], angles[2]);
      largest = std::max(largest, std::abs(difference));
      sum += difference * difference;
    }
  }
  rms = std::sqrt(sum / (3 * pairs));
}

inline void ExpectFormula(
  vtkBRDF* brdf, const double color[3], double tolerance, double horizon = 89.0)
{
  ASSERT_TRUE(brdf);
  double largest = 0.0;
  double rms = 0.0;
  Compare(brdf, color, horizon, largest, rms);
  EXPECT_LT(largest, tolerance);
}
} // namespace testio

#endif
