// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StructuralSimilarity.h"

#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr double Sigma = 1.5;
constexpr double C1 = 0.01 * 0.01;
constexpr double C2 = 0.03 * 0.03;

//------------------------------------------------------------------------------
// Mean of a b under the window.
Plane MeanProduct(const Plane& a, const Plane& b, const Kernel& window)
{
  Plane product = a;
  for (std::size_t k = 0; k < product.Values.size(); ++k)
  {
    product.Values[k] *= b.Values[k];
  }
  return Filter(product, window, window);
}
}

//------------------------------------------------------------------------------
Plane ComputeSimilarity(const Plane& picture, const Plane& reference)
{
  const Kernel window = MakeGaussian(Sigma, SimilarityRadius);
  const Plane meanX = Filter(picture, window, window);
  const Plane meanR = Filter(reference, window, window);
  const Plane xx = MeanProduct(picture, picture, window);
  const Plane rr = MeanProduct(reference, reference, window);
  const Plane xr = MeanProduct(picture, reference, window);
  Plane result = meanX;
  for (std::size_t k = 0; k < result.Values.size(); ++k)
  {
    const double x = meanX.Values[k];
    const double r = meanR.Values[k];
    const double variances = xx.Values[k] - x * x + rr.Values[k] - r * r;
    const double covariance = xr.Values[k] - x * r;
    result.Values[k] =
      (2.0 * x * r + C1) * (2.0 * covariance + C2) / ((x * x + r * r + C1) * (variances + C2));
  }
  return result;
}
} // namespace measuredbrdf
