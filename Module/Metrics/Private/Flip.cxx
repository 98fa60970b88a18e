// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Flip.h"

#include "ColorDifference.h"
#include "HalfVector.h" // for Pi
#include "SeparableFilter.h"

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
  const Plane empty{ width, height, {} };
  Opponent planes{ empty, empty, empty };
  for (std::size_t k = 0; k < linear.size(); k += 3)
  {
    const Color t = ToRelativeXYZ({ linear[k], linear[k + 1], linear[k + 2] });
    planes[0].Values.push_back(116.0 * t[1] - 16.0);
    planes[1].Values.push_back(500.0 * (t[0] - t[1]));
    planes[2].Values.push_back(200.0 * (t[1] - t[2]));
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
    const double share = this->Weights[static_cast<std::size_t>(radius)];
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
  const Plane cz1 = Filter(planes[2], wide.Weights, wide.Weights);
  const Plane cz2 = Filter(planes[2], narrow.Weights, narrow.Weights);
  const double sum1 = amplitudes[0] * wide.Sum;
  const double sum2 = amplitudes[1] * narrow.Sum;
  std::vector<Color> seen;
  for (std::size_t k = 0; k < y.Values.size(); ++k)
  {
    const double cz = (sum1 * cz1.Values[k] + sum2 * cz2.Values[k]) / (sum1 + sum2);
    const double luminance = (y.Values[k] + 16.0) / 116.0;
    Color linear =
      FromRelativeXYZ({ luminance + cx.Values[k] / 500.0, luminance, luminance - cz / 200.0 });
    for (double& value : linear)
    {
      value = std::clamp(value, 0.0, 1.0);
    }
    seen.push_back(ToHuntLab(linear));
  }
  return seen;
}

//------------------------------------------------------------------------------
// First or second derivative of a Gaussian; the positive weights' sum is 1, the negative ones' -1.
Kernel MakeDerivative(int order, double sigma, int radius)
{
  Kernel kernel;
  double positive = 0.0;
  double negative = 0.0;
  for (int x = -radius; x <= radius; ++x)
  {
    const double g = std::exp(-x * x / (2.0 * sigma * sigma));
    kernel.push_back(order == 1 ? -x * g : (x * x / (sigma * sigma) - 1.0) * g);
    (kernel.back() > 0.0 ? positive : negative) += std::abs(kernel.back());
  }
  for (double& weight : kernel)
  {
    weight /= weight > 0.0 ? positive : negative;
  }
  return kernel;
}

//------------------------------------------------------------------------------
// Strength of the edge (order 1) or of the point (2) at each pixel, of luminance in [0,1].
std::vector<double> FindFeatures(const Plane& luminance, int order)
{
  constexpr double sigma = 0.5 * FeatureWidth * PixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  const Kernel smooth = MakeGaussian(sigma, radius);
  const Kernel derivative = MakeDerivative(order, sigma, radius);
  const Plane alongX = Filter(luminance, derivative, smooth);
  const Plane alongY = Filter(luminance, smooth, derivative);
  std::vector<double> strength;
  for (std::size_t k = 0; k < alongX.Values.size(); ++k)
  {
    // The offset of Y falls out.
    strength.push_back(std::hypot(alongX.Values[k], alongY.Values[k]) / 116.0);
  }
  return strength;
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
  std::vector<double> features(seenA.size(), 0.0);
  for (const int order : { 1, 2 })
  {
    const std::vector<double> f = FindFeatures(a[0], order);
    const std::vector<double> g = FindFeatures(b[0], order);
    for (std::size_t k = 0; k < features.size(); ++k)
    {
      features[k] = std::max(features[k], std::abs(f[k] - g[k]));
    }
  }
  std::vector<double> flip;
  for (std::size_t k = 0; k < features.size(); ++k)
  {
    const double feature = std::pow(features[k] / std::sqrt(2.0), FeatureExponent);
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
} // namespace measuredbrdf
