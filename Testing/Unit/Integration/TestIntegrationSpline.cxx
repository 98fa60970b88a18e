// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What is stored for linear interpolation: the spline of least squared error.

#include "FieldSynthesis.h"
#include "HalfVector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

using measuredbrdf::FitLinearSpline;
using measuredbrdf::GetLinearSplineGain;

namespace
{
using measuredbrdf::Pi;

// Mean squared error of gain cos(2 pi periods x) at so many nodes a turn, interpolated linearly.
double GetSquaredError(int nodes, int periods, double gain)
{
  constexpr int Points = 64; // of an interval
  double sum = 0.0;
  for (int k = 0; k < nodes * Points; ++k)
  {
    const double t = (k % Points + 0.5) / Points;
    const auto wave = [&](double node) { return std::cos(2.0 * Pi * periods * node / nodes); };
    const int node = k / Points;
    const double spline = gain * ((1.0 - t) * wave(node) + t * wave(node + 1));
    sum += std::pow(spline - wave(node + t), 2);
  }
  return sum / (nodes * Points);
}
}

//------------------------------------------------------------------------------
TEST(LinearSpline, GainHasTheLeastSquaredError)
{
  constexpr int Nodes = 48;
  for (const int periods : { 1, 3, 6, 12, 20, 30, 37 })
  {
    const double gain = GetLinearSplineGain(static_cast<double>(periods) / Nodes);
    const double error = GetSquaredError(Nodes, periods, gain);
    EXPECT_LT(error, GetSquaredError(Nodes, periods, gain + 1e-3)) << periods;
    EXPECT_LT(error, GetSquaredError(Nodes, periods, gain - 1e-3)) << periods;
    EXPECT_LT(error, GetSquaredError(Nodes, periods, 1.0)) << periods;
  }
  // A sixth of the squared error of interpolation where the function is smooth.
  EXPECT_NEAR(
    GetSquaredError(Nodes, 1, GetLinearSplineGain(1.0 / Nodes)) / GetSquaredError(Nodes, 1, 1.0),
    1.0 / 6.0, 0.01);
  EXPECT_EQ(GetLinearSplineGain(0.0), 1.0);
  EXPECT_EQ(GetLinearSplineGain(-0.3), GetLinearSplineGain(0.3));
}

//------------------------------------------------------------------------------
// From values alone: the same to the second order.
TEST(LinearSpline, FitFollowsTheGain)
{
  for (const double frequency : { 0.01, 0.05, 0.1 })
  {
    const auto wave = [&](int k)
    { return std::polar(1.0f, static_cast<float>(2.0 * Pi * frequency * k)); };
    const std::complex<float> fitted = FitLinearSpline(wave(-1), wave(0), wave(1));
    EXPECT_NEAR(
      fitted.real(), GetLinearSplineGain(frequency), 30.0 * std::pow(frequency, 4) + 1e-6);
    EXPECT_NEAR(fitted.imag(), 0.0, 1e-6);
  }
}
