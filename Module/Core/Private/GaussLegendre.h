// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Gauss-Legendre quadrature: exact for polynomials up to degree 2n - 1.
 */

#ifndef GaussLegendre_h
#define GaussLegendre_h

#include "HalfVector.h" // Pi

#include <cmath>
#include <vector>

namespace measuredbrdf
{
struct Quadrature
{
  std::vector<double> Nodes; // descending
  std::vector<double> Weights;
};

/// n >= 1 nodes on [-1, 1], the roots of P_n by Newton's method.
inline Quadrature GaussLegendre(int n)
{
  Quadrature rule;
  for (int k = 0; k < n; ++k)
  {
    double x = std::cos(Pi * (k + 0.75) / (n + 0.5));
    double derivative = 1.0;
    for (int iteration = 0; iteration < 20; ++iteration)
    {
      double p0 = 1.0;
      double p1 = x;
      for (int l = 2; l <= n; ++l)
      {
        const double p2 = ((2.0 * l - 1.0) * x * p1 - (l - 1.0) * p0) / l;
        p0 = p1;
        p1 = p2;
      }
      derivative = n * (x * p1 - p0) / (x * x - 1.0);
      const double step = p1 / derivative;
      x -= step;
      if (std::abs(step) < 1e-15)
      {
        break;
      }
    }
    rule.Nodes.push_back(x);
    rule.Weights.push_back(2.0 / ((1.0 - x * x) * derivative * derivative));
  }
  return rule;
}
} // namespace measuredbrdf

#endif
