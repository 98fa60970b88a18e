// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Brushed metal for tests and benchmarks.
 */

#ifndef BrushedMetal_h
#define BrushedMetal_h

#include "vtkDistributionBRDF.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <cmath>
#include <vector>

/// Trowbridge, Reitz 1975's distribution (GGX) of widths along the tangent and across it.
inline vtkNew<vtkDistributionBRDF> NewBrushedMetal(double along, double across)
{
  constexpr int Thetas = 128, Phis = 128;
  std::vector<float> rgb;
  for (int phi = 0; phi < Phis; ++phi)
  {
    for (int theta = 0; theta < Thetas; ++theta)
    {
      const double part = (theta + 0.5) / Thetas;
      const double angle = 0.5 * vtkMath::Pi() * part * part;
      const double azimuth = 2.0 * vtkMath::Pi() * (phi + 0.5) / Phis;
      const double x = std::sin(angle) * std::cos(azimuth) / along;
      const double y = std::sin(angle) * std::sin(azimuth) / across;
      const double z = std::cos(angle);
      const double d = x * x + y * y + z * z;
      rgb.insert(rgb.end(), 3, static_cast<float>(1.0 / (vtkMath::Pi() * along * across * d * d)));
    }
  }
  vtkNew<vtkDistributionBRDF> brdf;
  brdf->SetDistribution(Thetas, Phis, rgb);
  const double f0[3] = { 0.95, 0.7, 0.4 };
  brdf->SetSchlickFresnel(f0);
  return brdf;
}

#endif
