// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Flip.h"

#include "ColorDifference.h"
#include "HalfVector.h" // for Pi
#include "ParallelFor.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
// 3840 pixels on 0.7 m, from 0.7 m away.
constexpr double PixelsPerDegree = 3840.0 * Pi / 180.0;

// The paper's parameters: of the color difference's exponent and redistribution, of the features'
// width in degrees and exponent.
constexpr double ColorExponent = 0.7;
constexpr double ColorKnee = 0.4;
constexpr double KneeValue = 0.95;
constexpr double FeatureWidth = 0.082;
constexpr double FeatureExponent = 0.5;

// Of the ACES curve, input times 0.6: (A x^2 + B x) / (C x^2 + D x + E).
constexpr double ACES[5] = { 0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14 };
// What an exposure brings to the display's brightest.
constexpr double ExposureTarget = 0.85;
constexpr double DarkestMedian = 0x1p-23;

using Opponent = std::array<Plane, 3>;

/// Weights at -radius ... radius of a pixel.
using Kernel = Eigen::ArrayXd;

//------------------------------------------------------------------------------
Kernel MakeGaussian(double sigma, int radius)
{
  const Kernel x = Kernel::LinSpaced(2 * radius + 1, -radius, radius);
  const Kernel weights = (-x * x / (2.0 * sigma * sigma)).exp();
  return weights / weights.sum();
}

//------------------------------------------------------------------------------
// First or second derivative of a Gaussian; the positive weights' sum is 1, the negative ones' -1.
Kernel MakeDerivative(int order, double sigma, int radius)
{
  const Kernel x = Kernel::LinSpaced(2 * radius + 1, -radius, radius);
  Kernel weights = (-x * x / (2.0 * sigma * sigma)).exp();
  weights *= order == 1 ? Kernel(-x) : Kernel(x * x / (sigma * sigma) - 1.0);
  const Kernel positive = weights.max(0.0);
  const Kernel negative = weights.min(0.0);
  return positive / positive.sum() - negative / negative.sum();
}

//------------------------------------------------------------------------------
// Beyond the border, the border's pixels are repeated.
Plane FilterColumns(const Plane& plane, const Kernel& kernel)
{
  Plane result = Plane::Zero(plane.rows(), plane.cols());
  ParallelFor(0, static_cast<vtkIdType>(plane.cols()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (Eigen::Index y = begin; y < end; ++y)
      {
        for (Eigen::Index k = 0; k < kernel.size(); ++k)
        {
          const Eigen::Index from =
            std::clamp<Eigen::Index>(y + k - kernel.size() / 2, 0, plane.cols() - 1);
          result.col(y) += kernel[k] * plane.col(from);
        }
      }
    });
  return result;
}

//------------------------------------------------------------------------------
// The sum under a kernel that is the product of both.
Plane Filter(const Plane& plane, const Kernel& alongX, const Kernel& alongY)
{
  return FilterColumns(FilterColumns(plane.transpose(), alongX).transpose(), alongY);
}

//------------------------------------------------------------------------------
// CIELAB with Hunt's adjustment: color counts for less where it is dark.
Color ToHuntLab(const Color& linear)
{
  const Color lab = ToLab(ToRelativeXYZ(linear));
  return { lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2] };
}

//------------------------------------------------------------------------------
double HyAB(const Color& a, const Color& b)
{
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

//------------------------------------------------------------------------------
// HyAB -> [0,1]; small differences take most of the range.
double Redistribute(double hyab)
{
  static const double largest =
    std::pow(HyAB(ToHuntLab({ 0.0, 1.0, 0.0 }), ToHuntLab({ 0.0, 0.0, 1.0 })), ColorExponent);
  const double value = std::pow(hyab, ColorExponent);
  const double knee = ColorKnee * largest;
  return value < knee ? KneeValue / knee * value
                      : KneeValue + (value - knee) / (largest - knee) * (1.0 - KneeValue);
}

//------------------------------------------------------------------------------
// YCxCz: CIELAB without its cube roots.
Opponent MakeOpponent(int width, int height, const std::vector<double>& linear)
{
  Opponent planes;
  planes.fill(Plane(width, height));
  for (std::size_t k = 0; k < linear.size() / 3; ++k)
  {
    const Color t = ToRelativeXYZ(glm::make_vec3(&linear[3 * k]));
    planes[0].data()[k] = 116.0 * t[1] - 16.0;
    planes[1].data()[k] = 500.0 * (t[0] - t[1]);
    planes[2].data()[k] = 200.0 * (t[1] - t[2]);
  }
  return planes;
}

//------------------------------------------------------------------------------
// exp(-pi^2 d^2 / b) of the distance in degrees, the Fourier transform of a Gaussian of frequency.
struct Sensitivity
{
  explicit Sensitivity(double b)
  {
    constexpr double widest = 0.04; // of all b
    const double degree = 1.0 / (Pi * std::sqrt(2.0));
    const int radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(widest) * degree * PixelsPerDegree));
    const double sigma = std::sqrt(b) * degree * PixelsPerDegree;
    this->Weights = MakeGaussian(sigma, radius);
    const double share = this->Weights[radius];
    this->Sum = std::sqrt(Pi / b) / (share * share);
  }

  Kernel Weights;
  double Sum; // over both axes of sqrt(pi/b) exp(...)
};

//------------------------------------------------------------------------------
// What the eye sees of each pixel.
std::vector<Color> SeeColors(const Opponent& planes)
{
  static const Sensitivity light(0.0047), redGreen(0.0053), wide(0.04), narrow(0.025);
  constexpr double amplitudes[2] = { 34.1, 13.5 }; // of blue-yellow
  const Plane y = Filter(planes[0], light.Weights, light.Weights);
  const Plane cx = Filter(planes[1], redGreen.Weights, redGreen.Weights);
  const double sum1 = amplitudes[0] * wide.Sum;
  const double sum2 = amplitudes[1] * narrow.Sum;
  const Plane cz = (sum1 * Filter(planes[2], wide.Weights, wide.Weights) +
                     sum2 * Filter(planes[2], narrow.Weights, narrow.Weights)) /
                   (sum1 + sum2);
  std::vector<Color> seen;
  for (Eigen::Index k = 0; k < y.size(); ++k)
  {
    const double luminance = (y.data()[k] + 16.0) / 116.0;
    const Color linear = FromRelativeXYZ(
      { luminance + cx.data()[k] / 500.0, luminance, luminance - cz.data()[k] / 200.0 });
    seen.push_back(ToHuntLab(glm::clamp(linear, 0.0, 1.0)));
  }
  return seen;
}

//------------------------------------------------------------------------------
// Strength of the edge (order 1) or of the point (2) at each pixel, of luminance in [0,1].
Plane FindFeatures(const Plane& luminance, int order)
{
  constexpr double sigma = 0.5 * FeatureWidth * PixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  const Kernel smooth = MakeGaussian(sigma, radius);
  const Kernel derivative = MakeDerivative(order, sigma, radius);
  const Plane alongX = Filter(luminance, derivative, smooth);
  const Plane alongY = Filter(luminance, smooth, derivative);
  return (alongX.square() + alongY.square()).sqrt() / 116.0; // the offset of Y falls out
}
}

//------------------------------------------------------------------------------
std::vector<double> ComputeFlip(
  int width, int height, const std::vector<double>& picture, const std::vector<double>& reference)
{
  const Opponent a = MakeOpponent(width, height, picture);
  const Opponent b = MakeOpponent(width, height, reference);
  const std::vector<Color> seenA = SeeColors(a);
  const std::vector<Color> seenB = SeeColors(b);
  const Plane features = (FindFeatures(a[0], 1) - FindFeatures(b[0], 1))
                           .abs()
                           .max((FindFeatures(a[0], 2) - FindFeatures(b[0], 2)).abs());
  std::vector<double> flip;
  for (std::size_t k = 0; k < seenA.size(); ++k)
  {
    const double feature = std::pow(features.data()[k] / std::sqrt(2.0), FeatureExponent);
    flip.push_back(std::pow(Redistribute(HyAB(seenA[k], seenB[k])), 1.0 - feature));
  }
  return flip;
}

//------------------------------------------------------------------------------
double ToneMapACES(double value)
{
  const double mapped =
    (ACES[0] * value + ACES[1]) * value / ((ACES[2] * value + ACES[3]) * value + ACES[4]);
  return std::clamp(mapped, 0.0, 1.0);
}

//------------------------------------------------------------------------------
std::vector<double> FindExposures(std::vector<double> luminances)
{
  // The value that the curve maps to the target: a root of a x^2 + b x + c.
  constexpr double a = ACES[0] - ExposureTarget * ACES[2];
  constexpr double b = ACES[1] - ExposureTarget * ACES[3];
  constexpr double c = -ExposureTarget * ACES[4];
  const double target = (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);

  const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  const double largest = *std::max_element(middle, luminances.end());
  const double median = std::max(*middle, DarkestMedian * largest);
  const double start = std::log2(target / largest);
  const double stop = std::log2(target / median);
  const int count = std::max(2, static_cast<int>(std::ceil(stop - start)));
  std::vector<double> exposures;
  for (int k = 0; k < count; ++k)
  {
    exposures.push_back(std::exp2(start + k * (stop - start) / (count - 1)));
  }
  return exposures;
}

//------------------------------------------------------------------------------
std::vector<double> ComputeHDRFlip(int width, int height, const std::vector<double>& picture,
  const std::vector<double>& reference, const std::vector<double>& exposures,
  const std::function<bool(double)>& goOn)
{
  const auto expose = [](std::vector<double> values, double exposure)
  {
    std::transform(values.begin(), values.end(), values.begin(),
      [exposure](double value) { return ToneMapACES(exposure * value); });
    return values;
  };
  std::vector<double> largest(reference.size() / 3, 0.0);
  for (std::size_t step = 0; step < exposures.size(); ++step)
  {
    if (goOn && !goOn(static_cast<double>(step + 1) / (exposures.size() + 1.0)))
    {
      return {};
    }
    const std::vector<double> exposed = ComputeFlip(
      width, height, expose(picture, exposures[step]), expose(reference, exposures[step]));
    for (std::size_t k = 0; k < largest.size(); ++k)
    {
      largest[k] = std::max(largest[k], exposed[k]);
    }
  }
  return largest;
}

//------------------------------------------------------------------------------
Plane ComputeSimilarity(const Plane& picture, const Plane& reference)
{
  constexpr double c1 = 0.01 * 0.01;
  constexpr double c2 = 0.03 * 0.03;
  const Kernel window = MakeGaussian(1.5, SimilarityRadius);
  const auto getMean = [&window](const Plane& plane) { return Filter(plane, window, window); };
  const Plane x = getMean(picture);
  const Plane r = getMean(reference);
  const Plane variances =
    getMean(picture.square()) - x.square() + getMean(reference.square()) - r.square();
  const Plane covariance = getMean(picture * reference) - x * r;
  return (2.0 * x * r + c1) * (2.0 * covariance + c2) /
         ((x.square() + r.square() + c1) * (variances + c2));
}
} // namespace measuredbrdf
