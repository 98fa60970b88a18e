// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A sphere seen from all directions, as plans for all views count it.
 */

#ifndef EverywherePairs_h
#define EverywherePairs_h

#include "vtkDoubleArray.h"
#include "vtkMath.h"

#include <cmath>

/// Views over all directions, and for each a point of the disc that it shows. In four dimensions
/// evenly: the generalized golden ratio's sequence (Roberts 2018), the root of x^5 = x + 1.
inline void AddEverywherePairs(int count, vtkDoubleArray* normals, vtkDoubleArray* views)
{
  constexpr double ratio = 1.1673039782614187;
  normals->SetNumberOfComponents(3);
  views->SetNumberOfComponents(3);
  for (int k = 0; k < count; ++k)
  {
    double x[4];
    double step = 1.0;
    for (double& value : x)
    {
      step /= ratio;
      value = std::fmod(0.5 + (k + 1) * step, 1.0);
    }
    const double y = 1.0 - 2.0 * x[0];
    const double s = std::sqrt(1.0 - y * y);
    const double around = 2.0 * vtkMath::Pi() * x[1];
    const double view[3] = { s * std::cos(around), y, s * std::sin(around) };
    double u[3], v[3], normal[3];
    vtkMath::Perpendiculars(view, u, v, 0.0);
    const double r = std::sqrt(x[2]);
    const double phi = 2.0 * vtkMath::Pi() * x[3];
    for (int c = 0; c < 3; ++c)
    {
      normal[c] =
        r * std::cos(phi) * u[c] + r * std::sin(phi) * v[c] + std::sqrt(1.0 - r * r) * view[c];
    }
    normals->InsertNextTuple(normal);
    views->InsertNextTuple(view);
  }
}

#endif
