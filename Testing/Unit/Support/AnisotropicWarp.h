// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Anisotropic materials: as RGL's files hold them, made of another, for tests have no such file;
 * and brushed metal.
 */

#ifndef AnisotropicWarp_h
#define AnisotropicWarp_h

#include "vtkAdaptiveWarpBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

struct AnisotropicWarpSizes
{
  int Thetas = 16; // of the incident direction
  int Phis = 17;   // over its span; 1: isotropic
  int Parts = 1;   // of a turn that the span is
  int Side = 65;   // odd, of the grids over the half vector
};

/**
 * f cos(theta_o) of a source for each incident direction and half vector. The warp is the identity
 * (vndf and luminance are constant) and the jacobian flag is off, so the values are f cos(theta_o)
 * themselves. Grids are over (sqrt(theta_h 2/pi), phi_h / 2 pi + 1/2).
 */
inline vtkAdaptiveWarpBRDF::Tables MakeAnisotropicTables(
  vtkBRDF* source, const AnisotropicWarpSizes& sizes)
{
  constexpr double pi = 3.14159265358979323846;
  vtkAdaptiveWarpBRDF::Tables tables;
  tables.Jacobian = false;
  for (int t = 0; t < sizes.Thetas; ++t)
  {
    tables.ThetaI.push_back(static_cast<float>(1.56 * t / (sizes.Thetas - 1)));
  }
  for (int p = 0; p < sizes.Phis; ++p) // files begin at -pi
  {
    const double phi = -pi + 2.0 * pi / sizes.Parts * p / std::max(sizes.Phis - 1, 1);
    tables.PhiI.push_back(sizes.Phis > 1 ? static_cast<float>(phi) : 0.0f);
  }
  const auto flat = [](std::vector<int> shape)
  {
    const int count = std::accumulate(shape.begin(), shape.end(), 1, std::multiplies<int>());
    return vtkAdaptiveWarpBRDF::Table{ shape, std::vector<float>(count, 1.0f) };
  };
  tables.Ndf = flat({ 4, 4 });
  tables.Sigma = flat({ 4, 4 });
  tables.Vndf = flat({ sizes.Phis, sizes.Thetas, 4, 4 });
  tables.Luminance = flat({ sizes.Phis, sizes.Thetas, 4, 4 });
  tables.Rgb = flat({ sizes.Phis, sizes.Thetas, 3, sizes.Side, sizes.Side });
  std::size_t at = 0;
  const std::size_t plane =
    static_cast<std::size_t>(sizes.Side) * static_cast<std::size_t>(sizes.Side);
  for (const float phi : tables.PhiI)
  {
    for (const float theta : tables.ThetaI)
    {
      const glm::dvec3 i(
        std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      for (int y = 0; y < sizes.Side; ++y)
      {
        for (int x = 0; x < sizes.Side; ++x)
        {
          const double root = static_cast<double>(x) / (sizes.Side - 1);
          const double thetaH = 0.5 * pi * root * root;
          const double phiH = (2.0 * y / (sizes.Side - 1) - 1.0) * pi;
          const glm::dvec3 h(
            std::sin(thetaH) * std::cos(phiH), std::sin(thetaH) * std::sin(phiH), std::cos(thetaH));
          glm::dvec3 o = 2.0 * glm::dot(i, h) * h - i;
          o.z = std::max(o.z, 1e-3); // below: seen by interpolation only
          o = glm::normalize(o);
          double f[3];
          source->Evaluate(&i.x, &o.x, f);
          for (std::size_t c = 0; c < 3; ++c)
          {
            tables.Rgb.Values[at + c * plane + static_cast<std::size_t>(y * sizes.Side + x)] =
              static_cast<float>(f[c] * o.z);
          }
        }
      }
      at += 3 * plane;
    }
  }
  return tables;
}

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
