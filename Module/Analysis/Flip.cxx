// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Flip.h"

#include "SRGB.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace measuredbrdf
{
namespace
{
using Vector = std::array<double, 3>;

constexpr double Pi = 3.14159265358979323846;
constexpr double PixelsPerDegree = 67.0;

// The paper's parameters: of the colour difference's exponent and redistribution, of the features'
// width in degrees and exponent.
constexpr double ColourExponent = 0.7;
constexpr double ColourKnee = 0.4;
constexpr double KneeValue = 0.95;
constexpr double FeatureWidth = 0.082;
constexpr double FeatureExponent = 0.5;

// Linear Rec. 709 -> XYZ, D65.
constexpr double ToXYZ[3][3] = { { 0.4123907993, 0.3575843394, 0.1804807884 },
  { 0.2126390059, 0.7151686788, 0.0721923154 }, { 0.0193308187, 0.1191947798, 0.9505321522 } };
constexpr double FromXYZ[3][3] = { { 3.2409699419, -1.5373831776, -0.4986107603 },
  { -0.9692436363, 1.8759675015, 0.0415550574 }, { 0.0556300797, -0.2039769589, 1.0569715142 } };

Vector Multiply(const double matrix[3][3], const Vector& v)
{
  Vector result;
  for (int r = 0; r < 3; ++r)
  {
    result[r] = matrix[r][0] * v[0] + matrix[r][1] * v[1] + matrix[r][2] * v[2];
  }
  return result;
}

// XYZ over that of white.
Vector ToRelativeXYZ(const Vector& linear)
{
  static const Vector white = Multiply(ToXYZ, { 1.0, 1.0, 1.0 });
  const Vector xyz = Multiply(ToXYZ, linear);
  return { xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2] };
}

Vector ToOpponent(const Vector& linear)
{
  const Vector t = ToRelativeXYZ(linear);
  return { 116.0 * t[1] - 16.0, 500.0 * (t[0] - t[1]), 200.0 * (t[1] - t[2]) };
}

Vector FromOpponent(const Vector& opponent)
{
  static const Vector white = Multiply(ToXYZ, { 1.0, 1.0, 1.0 });
  const double y = (opponent[0] + 16.0) / 116.0;
  return Multiply(FromXYZ,
    { white[0] * (y + opponent[1] / 500.0), white[1] * y, white[2] * (y - opponent[2] / 200.0) });
}

// CIELAB with Hunt's adjustment: colour counts for less where it is dark.
Vector ToHuntLab(const Vector& linear)
{
  Vector t = ToRelativeXYZ(linear);
  for (double& value : t)
  {
    constexpr double delta = 6.0 / 29.0;
    value =
      value > delta * delta * delta ? std::cbrt(value) : value / (3.0 * delta * delta) + 4.0 / 29.0;
  }
  const double l = 116.0 * t[1] - 16.0;
  return { l, 0.01 * l * 500.0 * (t[0] - t[1]), 0.01 * l * 200.0 * (t[1] - t[2]) };
}

double HyAB(const Vector& a, const Vector& b)
{
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// HyAB -> [0,1]; small differences take most of the range.
double Redistribute(double hyab)
{
  static const double largest =
    std::pow(HyAB(ToHuntLab({ 0.0, 1.0, 0.0 }), ToHuntLab({ 0.0, 0.0, 1.0 })), ColourExponent);
  const double value = std::pow(hyab, ColourExponent);
  const double knee = ColourKnee * largest;
  return value < knee ? KneeValue / knee * value
                      : KneeValue + (value - knee) / (largest - knee) * (1.0 - KneeValue);
}

// Square weights about a pixel.
struct Kernel
{
  int Radius;
  std::vector<double> Weights;

  template <typename Function>
  Kernel(int radius, Function weight)
    : Radius(radius)
  {
    for (int y = -radius; y <= radius; ++y)
    {
      for (int x = -radius; x <= radius; ++x)
      {
        this->Weights.push_back(weight(static_cast<double>(x), static_cast<double>(y)));
      }
    }
  }

  // The positive weights' sum becomes 1, the negative ones' -1.
  void Normalize()
  {
    double positive = 0.0;
    double negative = 0.0;
    for (const double weight : this->Weights)
    {
      (weight > 0.0 ? positive : negative) += std::abs(weight);
    }
    for (double& weight : this->Weights)
    {
      weight /= weight > 0.0 ? positive : negative;
    }
  }
};

struct Image
{
  int Width;
  int Height;
  std::vector<Vector> Pixels;

  // One channel's sum under a kernel.
  double Filter(const Kernel& kernel, int x0, int y0, int channel) const
  {
    double sum = 0.0;
    const double* weight = kernel.Weights.data();
    for (int y = y0 - kernel.Radius; y <= y0 + kernel.Radius; ++y)
    {
      const int row = std::clamp(y, 0, this->Height - 1) * this->Width;
      for (int x = x0 - kernel.Radius; x <= x0 + kernel.Radius; ++x)
      {
        sum += *weight++ * this->Pixels[row + std::clamp(x, 0, this->Width - 1)][channel];
      }
    }
    return sum;
  }
};

Image MakeOpponent(int width, int height, const std::vector<double>& encoded)
{
  Image image{ width, height, {} };
  for (std::size_t k = 0; k < encoded.size(); k += 3)
  {
    image.Pixels.push_back(ToOpponent(
      { DecodeSRGB(encoded[k]), DecodeSRGB(encoded[k + 1]), DecodeSRGB(encoded[k + 2]) }));
  }
  return image;
}

// Contrast sensitivity of a channel as a sum of two Gaussians of the distance in degrees.
Kernel MakeSensitivity(double a1, double b1, double a2, double b2)
{
  constexpr double widest = 0.04; // of all b
  const int radius =
    static_cast<int>(std::ceil(3.0 * std::sqrt(widest / (2.0 * Pi * Pi)) * PixelsPerDegree));
  Kernel kernel(radius,
    [&](double x, double y)
    {
      const double z = Pi * Pi * (x * x + y * y) / (PixelsPerDegree * PixelsPerDegree);
      return a1 * std::sqrt(Pi / b1) * std::exp(-z / b1) +
             a2 * std::sqrt(Pi / b2) * std::exp(-z / b2);
    });
  kernel.Normalize();
  return kernel;
}

// What the eye sees of a pixel.
Vector SeeColour(const Image& image, int x, int y)
{
  static const Kernel sensitivity[3] = { MakeSensitivity(1.0, 0.0047, 0.0, 1e-5),
    MakeSensitivity(1.0, 0.0053, 0.0, 1e-5), MakeSensitivity(34.1, 0.04, 13.5, 0.025) };
  Vector filtered;
  for (int c = 0; c < 3; ++c)
  {
    filtered[c] = image.Filter(sensitivity[c], x, y, c);
  }
  Vector linear = FromOpponent(filtered);
  for (double& value : linear)
  {
    value = std::clamp(value, 0.0, 1.0);
  }
  return ToHuntLab(linear);
}

// Derivatives of a Gaussian along x or y: first (edges) or second (points).
Kernel MakeDetector(bool point, bool alongY)
{
  constexpr double sigma = 0.5 * FeatureWidth * PixelsPerDegree;
  Kernel kernel(static_cast<int>(std::ceil(3.0 * sigma)),
    [&](double x, double y)
    {
      const double t = alongY ? y : x;
      const double g = std::exp(-(x * x + y * y) / (2.0 * sigma * sigma));
      return point ? (t * t / (sigma * sigma) - 1.0) * g : -t * g;
    });
  kernel.Normalize();
  return kernel;
}

// Strength of the edge and of the point at a pixel.
std::array<double, 2> FindFeatures(const Image& image, int x, int y)
{
  static const Kernel detectors[2][2] = { { MakeDetector(false, false), MakeDetector(false, true) },
    { MakeDetector(true, false), MakeDetector(true, true) } };
  std::array<double, 2> strength;
  for (int k = 0; k < 2; ++k)
  {
    // Of luminance in [0,1]; the offset of Y falls out.
    strength[k] =
      std::hypot(image.Filter(detectors[k][0], x, y, 0), image.Filter(detectors[k][1], x, y, 0)) /
      116.0;
  }
  return strength;
}
}

//------------------------------------------------------------------------------
std::vector<double> ComputeFlip(
  int width, int height, const std::vector<double>& picture, const std::vector<double>& reference)
{
  const Image a = MakeOpponent(width, height, picture);
  const Image b = MakeOpponent(width, height, reference);
  std::vector<double> flip(a.Pixels.size());
  vtkSMPTools::For(0, height,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      {
        for (int x = 0; x < width; ++x)
        {
          const double colour = Redistribute(HyAB(SeeColour(a, x, y), SeeColour(b, x, y)));
          const std::array<double, 2> f = FindFeatures(a, x, y);
          const std::array<double, 2> g = FindFeatures(b, x, y);
          const double feature =
            std::pow(std::max(std::abs(f[0] - g[0]), std::abs(f[1] - g[1])) / std::sqrt(2.0),
              FeatureExponent);
          flip[static_cast<std::size_t>(y) * width + x] = std::pow(colour, 1.0 - feature);
        }
      }
    });
  return flip;
}
} // namespace measuredbrdf
