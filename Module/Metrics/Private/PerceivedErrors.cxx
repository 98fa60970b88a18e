// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PerceivedErrors.h"

#include "HalfVector.h" // for angles
#include "ParallelFor.h"
#include "SRGB.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
// 3840 pixels on 0.7 m, from 0.7 m away.
constexpr double PixelsPerDegree = 3840.0 * Pi / 180.0;

// FLIP's parameters: of the color difference's exponent and redistribution, of the features' width
// in degrees and exponent.
constexpr double ColorExponent = 0.7;
constexpr double ColorKnee = 0.4;
constexpr double KneeValue = 0.95;
constexpr double FeatureWidth = 0.082;
constexpr double FeatureExponent = 0.5;

// Of the ACES curve (Narkowicz 2015), input times 0.6: (A x^2 + B x) / (C x^2 + D x + E).
constexpr double ACES[5] = { 0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14 };
// What an exposure brings to the display's brightest.
constexpr double ExposureTarget = 0.85;
constexpr double DarkestMedian = 0x1p-23;

/// Weights at -radius ... radius of a pixel.
using Kernel = Eigen::ArrayXd;

//------------------------------------------------------------------------------
Colors Multiply(const double (&matrix)[3][3], const Colors& colors)
{
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  return (Eigen::Map<const Rows>(&matrix[0][0]) * colors.matrix()).array();
}

// XYZ of white.
Eigen::Array3d GetWhite() { return Multiply(RGBToXYZ, Colors::Ones(3, 1)).col(0); }

Colors ToRelativeXYZ(const Colors& linear)
{
  return Multiply(RGBToXYZ, linear).colwise() / GetWhite();
}

// A lightness and two differences: CIELAB of cube roots of XYZ, YCxCz of XYZ itself.
Colors ToOpponent(const Colors& t)
{
  Colors opponent(3, t.cols());
  opponent << 116.0 * t.row(1) - 16.0, 500.0 * (t.row(0) - t.row(1)), 200.0 * (t.row(1) - t.row(2));
  return opponent;
}

//------------------------------------------------------------------------------
// Hue in [0,360), 0 of grays.
double GetHue(double a, double b)
{
  const double hue = a == 0.0 && b == 0.0 ? 0.0 : ToDegrees(std::atan2(b, a));
  return hue < 0.0 ? hue + 360.0 : hue;
}

// c^7 / (c^7 + 25^7), which tells grays from colors.
double GetChromaShare(double c)
{
  const double c7 = std::pow(c, 7.0);
  return c7 / (c7 + std::pow(25.0, 7.0));
}

double CosDegrees(double angle) { return std::cos(ToRadians(angle)); }

//------------------------------------------------------------------------------
Kernel MakeGaussian(double sigma, int radius)
{
  const Kernel x = Kernel::LinSpaced(2 * radius + 1, -radius, radius);
  const Kernel weights = (-x * x / (2.0 * sigma * sigma)).exp();
  return weights / weights.sum();
}

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

// The sum under a kernel that is the product of both.
Plane Filter(const Plane& plane, const Kernel& alongX, const Kernel& alongY)
{
  return FilterColumns(FilterColumns(plane.transpose(), alongX).transpose(), alongY);
}

Plane Blur(const Plane& plane, const Kernel& kernel) { return Filter(plane, kernel, kernel); }

Plane GetPlane(int width, int height, const Values& values)
{
  return Eigen::Map<const Plane>(values.data(), width, height);
}

Values GetValues(const Plane& plane)
{
  return Eigen::Map<const Values>(plane.data(), plane.size());
}

//------------------------------------------------------------------------------
// CIELAB with Hunt's adjustment: color counts for less where it is dark.
Colors ToHuntLab(const Colors& linear)
{
  Colors lab = ToLab(linear);
  lab.bottomRows<2>().rowwise() *= 0.01 * Values(lab.row(0));
  return lab;
}

// HyAB -> [0,1]; small differences take most of the range.
Values GetColorDifference(const Colors& a, const Colors& b)
{
  const auto getDistance = [](const Colors& d) -> Values
  { return d.row(0).abs() + d.bottomRows<2>().matrix().colwise().norm().array(); };
  static const double largest = std::pow(
    getDistance(ToHuntLab(Eigen::Array3d(0, 1, 0)) - ToHuntLab(Eigen::Array3d(0, 0, 1))).sum(),
    ColorExponent);
  constexpr double rest = 1.0 - KneeValue;
  const double knee = ColorKnee * largest;
  const Values value = getDistance(a - b).pow(ColorExponent);
  return (value < knee)
    .select(KneeValue / knee * value, KneeValue + (value - knee) / (largest - knee) * rest);
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
    this->Weights = MakeGaussian(std::sqrt(b) * degree * PixelsPerDegree, radius);
    const double share = this->Weights[radius];
    this->Sum = std::sqrt(Pi / b) / (share * share);
  }

  Kernel Weights;
  double Sum; // over both axes of sqrt(pi/b) exp(...)
};

// What the eye sees of each pixel.
Colors SeeColors(int width, int height, const Colors& opponent)
{
  static const Sensitivity light(0.0047), redGreen(0.0053), wide(0.04), narrow(0.025);
  constexpr double amplitudes[2] = { 34.1, 13.5 }; // of blue-yellow
  const double sum1 = amplitudes[0] * wide.Sum;
  const double sum2 = amplitudes[1] * narrow.Sum;
  const Plane blueYellow = GetPlane(width, height, opponent.row(2));
  const Plane y = Blur(GetPlane(width, height, opponent.row(0)), light.Weights);
  const Plane cx = Blur(GetPlane(width, height, opponent.row(1)), redGreen.Weights);
  const Plane cz =
    (sum1 * Blur(blueYellow, wide.Weights) + sum2 * Blur(blueYellow, narrow.Weights)) /
    (sum1 + sum2);
  const Values luminance = (GetValues(y) + 16.0) / 116.0;
  Colors xyz(3, luminance.size());
  xyz << luminance + GetValues(cx) / 500.0, luminance, luminance - GetValues(cz) / 200.0;
  return ToHuntLab(Multiply(XYZToRGB, xyz.colwise() * GetWhite()).max(0.0).min(1.0));
}

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
Colors ToLab(const Colors& linear)
{
  constexpr double delta = 6.0 / 29.0;
  return ToOpponent(ToRelativeXYZ(linear).unaryExpr(
    [](double value)
    {
      return value > delta * delta * delta ? std::cbrt(value)
                                           : value / (3.0 * delta * delta) + 4.0 / 29.0;
    }));
}

//------------------------------------------------------------------------------
double GetDeltaE2000(const Eigen::Array3d& lab1, const Eigen::Array3d& lab2)
{
  // Grays' a* is stretched: a' = (1 + G) a*.
  const double share =
    GetChromaShare(0.5 * (std::hypot(lab1[1], lab1[2]) + std::hypot(lab2[1], lab2[2])));
  const double stretch = 1.0 + 0.5 * (1.0 - std::sqrt(share));
  const double c1 = std::hypot(stretch * lab1[1], lab1[2]);
  const double c2 = std::hypot(stretch * lab2[1], lab2[2]);
  const double h1 = GetHue(stretch * lab1[1], lab1[2]);
  const double h2 = GetHue(stretch * lab2[1], lab2[2]);

  // The shorter way round from hue 1 to hue 2, and the hue half-way; a gray has none of its own.
  const bool gray = c1 * c2 == 0.0;
  double turn = gray ? 0.0 : h2 - h1;
  turn += turn > 180.0 ? -360.0 : turn < -180.0 ? 360.0 : 0.0;
  double hue = h1 + h2;
  if (!gray)
  {
    const bool around = std::abs(h1 - h2) > 180.0;
    hue = 0.5 * (hue + (!around ? 0.0 : hue < 360.0 ? 360.0 : -360.0));
  }

  const double dL = lab2[0] - lab1[0];
  const double dC = c2 - c1;
  const double dH = 2.0 * std::sqrt(c1 * c2) * std::sin(ToRadians(0.5 * turn));
  const double chroma = 0.5 * (c1 + c2);
  const double t = 1.0 - 0.17 * CosDegrees(hue - 30.0) + 0.24 * CosDegrees(2.0 * hue) +
                   0.32 * CosDegrees(3.0 * hue + 6.0) - 0.20 * CosDegrees(4.0 * hue - 63.0);
  const double l50 = 0.5 * (lab1[0] + lab2[0]) - 50.0;
  const double sL = 1.0 + 0.015 * l50 * l50 / std::sqrt(20.0 + l50 * l50);
  const double sC = 1.0 + 0.045 * chroma;
  const double sH = 1.0 + 0.015 * chroma * t;
  // Blues: chroma and hue are turned against each other.
  const double bump = (hue - 275.0) / 25.0;
  const double rotation =
    -2.0 * std::sqrt(GetChromaShare(chroma)) * std::sin(ToRadians(60.0 * std::exp(-bump * bump)));
  const double l = dL / sL;
  const double c = dC / sC;
  const double h = dH / sH;
  return std::sqrt(std::max(l * l + c * c + h * h + rotation * c * h, 0.0));
}

//------------------------------------------------------------------------------
Values ComputeFlip(int width, int height, const Colors& picture, const Colors& reference)
{
  const Colors a = ToOpponent(ToRelativeXYZ(picture));
  const Colors b = ToOpponent(ToRelativeXYZ(reference));
  const auto compareFeatures = [&](int order) -> Plane
  {
    return (FindFeatures(GetPlane(width, height, a.row(0)), order) -
            FindFeatures(GetPlane(width, height, b.row(0)), order))
      .abs();
  };
  const Values features = GetValues(compareFeatures(1).max(compareFeatures(2)));
  const Values color = GetColorDifference(SeeColors(width, height, a), SeeColors(width, height, b));
  return color.pow(1.0 - (features / std::sqrt(2.0)).pow(FeatureExponent));
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
Values ComputeHDRFlip(int width, int height, const Colors& picture, const Colors& reference,
  const std::vector<double>& exposures, const std::function<bool(double)>& goOn)
{
  const auto expose = [](const Colors& radiance, double exposure) -> Colors
  {
    const Colors x = exposure * radiance;
    return ((ACES[0] * x + ACES[1]) * x / ((ACES[2] * x + ACES[3]) * x + ACES[4])).min(1.0);
  };
  Values largest = Values::Zero(reference.cols());
  for (std::size_t step = 0; step < exposures.size(); ++step)
  {
    if (goOn && !goOn(static_cast<double>(step + 1) / (exposures.size() + 1.0)))
    {
      return {};
    }
    largest = largest.max(ComputeFlip(
      width, height, expose(picture, exposures[step]), expose(reference, exposures[step])));
  }
  return largest;
}

//------------------------------------------------------------------------------
Plane ComputeSimilarity(const Plane& picture, const Plane& reference)
{
  constexpr double c1 = 0.01 * 0.01;
  constexpr double c2 = 0.03 * 0.03;
  const Kernel window = MakeGaussian(1.5, SimilarityRadius);
  const Plane x = Blur(picture, window);
  const Plane r = Blur(reference, window);
  const Plane variances =
    Blur(picture.square(), window) - x.square() + Blur(reference.square(), window) - r.square();
  const Plane covariance = Blur(picture * reference, window) - x * r;
  return (2.0 * x * r + c1) * (2.0 * covariance + c2) /
         ((x.square() + r.square() + c1) * (variances + c2));
}
} // namespace measuredbrdf
