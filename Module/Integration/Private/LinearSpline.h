// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What to store at nodes between which a texture unit interpolates linearly. A function's own
 * values there make the error of one sign between nodes; values that make the squared error over
 * the whole axis least leave about 1/sqrt(6) of it (Blu, Unser 1999, "Quantitative Fourier Analysis
 * of Approximation Techniques I").
 */

#ifndef LinearSpline_h
#define LinearSpline_h

#include "HalfVector.h" // for Pi

#include <cmath>
#include <complex>

namespace measuredbrdf
{
/// For a Fourier series over a circle of nodes: what a term with so many periods per node is
/// multiplied by. The dual spline's spectrum, sinc^2 / ((2 + cos) / 3), beyond half a period, too.
inline double GetLinearSplineGain(double frequency)
{
  const double x = Pi * std::abs(frequency);
  const double sinc = x > 0.0 ? std::sin(x) / x : 1.0;
  return 3.0 * sinc * sinc / (2.0 + std::cos(2.0 * x));
}

/// The same where only a function's values at the nodes are known, to the second order.
inline std::complex<float> FitLinearSpline(const std::complex<float>& before,
  const std::complex<float>& value, const std::complex<float>& after)
{
  return value - (before - 2.0f * value + after) / 12.0f;
}
} // namespace measuredbrdf

#endif
