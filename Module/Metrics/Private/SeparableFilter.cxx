// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SeparableFilter.h"

#include "ParallelFor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
//------------------------------------------------------------------------------
// result(x, y) = sum over k of kernel[k] plane(x + k dx, y + k dy).
Plane FilterAlong(const Plane& plane, const Kernel& kernel, int dx, int dy)
{
  Plane result{ plane.Width, plane.Height, std::vector<double>(plane.Values.size()) };
  const int radius = static_cast<int>(kernel.size() / 2);
  measuredbrdf::ParallelFor(0, plane.Height,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      {
        for (int x = 0; x < plane.Width; ++x)
        {
          double sum = 0.0;
          for (int k = -radius; k <= radius; ++k)
          {
            const int column = std::clamp(x + k * dx, 0, plane.Width - 1);
            const int row = std::clamp(y + k * dy, 0, plane.Height - 1);
            sum += kernel[static_cast<std::size_t>(k + radius)] *
                   plane.Values[static_cast<std::size_t>(row) * plane.Width + column];
          }
          result.Values[static_cast<std::size_t>(y) * plane.Width + x] = sum;
        }
      }
    });
  return result;
}
}

//------------------------------------------------------------------------------
Kernel MakeGaussian(double sigma, int radius)
{
  Kernel kernel;
  double sum = 0.0;
  for (int x = -radius; x <= radius; ++x)
  {
    kernel.push_back(std::exp(-x * x / (2.0 * sigma * sigma)));
    sum += kernel.back();
  }
  for (double& weight : kernel)
  {
    weight /= sum;
  }
  return kernel;
}

//------------------------------------------------------------------------------
Plane Filter(const Plane& plane, const Kernel& alongX, const Kernel& alongY)
{
  return FilterAlong(FilterAlong(plane, alongX, 1, 0), alongY, 0, 1);
}

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
