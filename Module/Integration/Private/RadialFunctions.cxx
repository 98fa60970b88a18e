// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadialFunctions.h"

#include "CosinePowerWarp.h"
#include "LocalFrame.h"
#include "vtkBasisBRDF.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
namespace
{
std::vector<glm::dvec3> Upsample(const Eigen::MatrixXd& views, int order, double scale)
{
  std::vector<glm::dvec3> result;
  const int n = static_cast<int>(views.rows());
  for (int k = 0; n > 0 && k < ViewNodes; ++k)
  {
    glm::dvec3 rgb;
    for (int c = 0; c < 3; ++c)
    {
      rgb[c] = scale * InterpolateWarped(views.col(c).data(), n, order, (k + 0.5) / ViewNodes);
    }
    result.push_back(rgb);
  }
  return result;
}

// The coefficients of function k at a polar angle of the view, divided by the cosine they carry.
glm::dvec3 GetCoefficient(vtkBasisBRDF* brdf, int k, double cosine)
{
  const double* zone = brdf->GetOutgoingZone();
  const int n = brdf->GetNumberOfTheta();
  const double theta = std::acos(cosine) * (180.0 / Pi);
  const double x = std::clamp((theta - zone[0]) / (zone[1] - zone[0]), 0.0, 1.0) * (n - 1);
  const int first = std::min(static_cast<int>(x), n - 2);
  const float* rgb = &brdf->GetCoefficients()[3 * static_cast<std::size_t>(k * n + first)];
  glm::dvec3 result;
  for (int c = 0; c < 3; ++c)
  {
    result[c] = rgb[c] + (x - first) * (rgb[3 + c] - rgb[c]);
  }
  if (brdf->GetOutgoingCosine())
  {
    const double near = std::cos(zone[0] * Pi / 180.0);
    const double far = std::cos(zone[1] * Pi / 180.0);
    result /= std::max(std::clamp(cosine, far, near), 0.01); // as vtkBasisBRDF
  }
  return result;
}

}

Radial ToRadial(const AzimuthalBasis::Term& term)
{
  const double scale = term.Order > 0 ? 2.0 : 1.0;
  Radial radial{ term.Order, Eigen::VectorXf(IncidentNodes),
    Upsample(term.Cosine, term.Order, scale), Upsample(term.Sine, term.Order, scale) };
  const int n = AzimuthalBasis::NumberOfNodes;
  Eigen::VectorXd weighted = term.Incident;
  for (int k = 0; k < n; ++k)
  {
    weighted[k] *= WarpToCosine((k + 0.5) / n, 0.0);
  }
  for (int k = 0; k < IncidentNodes; ++k)
  {
    radial.Incident[k] = static_cast<float>(
      InterpolateWarped(weighted.data(), n, term.Order, (k + 0.5) / IncidentNodes));
  }
  return radial;
}

std::vector<Radial> GetOwnBasis(vtkBasisBRDF* brdf)
{
  const bool zonal =
    brdf->GetBasis() == vtkBasisBRDF::ZONAL || brdf->GetBasis() == vtkBasisBRDF::LEGENDRE_FOURIER;
  const double near = zonal ? std::cos(brdf->GetIncidentZone()[0] * Pi / 180.0) : 1.0;
  const double far = zonal ? std::cos(brdf->GetIncidentZone()[1] * Pi / 180.0) : 0.0;
  std::vector<std::vector<double>> values; // of all functions, per incident node, azimuth 0
  for (int q = 0; q < IncidentNodes; ++q)
  {
    const double cosine = WarpToCosine((q + 0.5) / IncidentNodes, 0.0);
    const double inside = std::clamp(cosine, far, near);
    const double i[3] = { std::sqrt(1.0 - inside * inside), 0.0, inside };
    values.push_back(
      vtkBasisBRDF::EvaluateBasis(brdf->GetBasis(), brdf->GetOrder(), brdf->GetIncidentZone(), i));
    const double scale = brdf->GetIncidentCosine() ? cosine / std::max(inside, 0.01) : cosine;
    for (double& value : values.back())
    {
      value *= scale;
    }
  }
  std::vector<Radial> radials;
  for (int m = 0; m <= brdf->GetOrder(); ++m)
  {
    for (int l = m; l <= brdf->GetOrder(); ++l)
    {
      Radial radial{ m, Eigen::VectorXf(IncidentNodes), {}, {} };
      const int cosine = l * (l + 1) + m;
      for (int q = 0; q < IncidentNodes; ++q)
      {
        radial.Incident[q] =
          static_cast<float>(values[static_cast<std::size_t>(q)][static_cast<std::size_t>(cosine)]);
      }
      for (int k = 0; k < ViewNodes; ++k)
      {
        const double c = WarpToCosine((k + 0.5) / ViewNodes, MinimumViewCosine);
        radial.Cosine.push_back(GetCoefficient(brdf, cosine, c));
        if (m > 0)
        {
          radial.Sine.push_back(GetCoefficient(brdf, cosine - 2 * m, c));
        }
      }
      radials.push_back(std::move(radial));
    }
  }
  return radials;
}

} // namespace measuredbrdf
