// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a person sees of an error, against other programs' figures: FLIP and HDR-FLIP of the
// authors' own (flip-evaluator 1.7, which is NVlabs/flip, in single precision), SSIM and CIEDE2000
// of scikit-image 0.26.0, on small pictures made by formula.

#include "ErrorCatcher.h"
#include "ExpectStops.h"

#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkRadianceMetrics.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace
{
constexpr int Width = 64;
constexpr int Height = 48;

using RGB = std::array<double, 3>;
using Formula = RGB (*)(int x, int y);

vtkSmartPointer<vtkDoubleArray> Draw(Formula formula, double exponent = 1.0)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(3);
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      for (const double value : formula(x, y))
      {
        array->InsertNextValue(std::pow(value, exponent));
      }
    }
  }
  return array;
}

// In [0,1).
double Noise(int x, int y, int seed)
{
  return ((x * 73 + y * 151 + x * y * 7 + seed) % 101) / 100.0;
}

// Pictures as displayed, in [0,1]; more than 1 % of each reference's channels are 1.
RGB Gradient(int x, int y)
{
  return x < 4 ? RGB{ 1.0, 1.0, 1.0 } : RGB{ x / 64.0, y / 48.0, (x + y) / 112.0 };
}

RGB GradientDarker(int x, int y)
{
  const RGB rgb = Gradient(x, y);
  return { 0.9 * rgb[0], 0.95 * rgb[1], rgb[2] };
}

RGB Stripe(int x, int y)
{
  return (x / 6 + y / 8) % 2 ? RGB{ 0.9, 0.2, 0.1 } : RGB{ 0.1, 0.4, 0.8 };
}

RGB Stripes(int x, int y) { return y < 4 ? RGB{ 1.0, 1.0, 1.0 } : Stripe(x, y); }

RGB StripesMoved(int x, int y) { return y < 4 ? RGB{ 1.0, 1.0, 1.0 } : Stripe(x + 1, y); }

RGB Flat(int x, int) { return x >= 60 ? RGB{ 1.0, 1.0, 1.0 } : RGB{ 0.3, 0.5, 0.2 }; }

RGB FlatNoisy(int x, int y)
{
  RGB rgb = Flat(x, y);
  for (int c = 0; c < 3; ++c)
  {
    rgb[c] = std::min(1.0, rgb[c] * (0.8 + 0.4 * Noise(x, y, 31 * c)));
  }
  return rgb;
}

RGB Spot(int x, int y, int squaredRadius)
{
  const int u = x % 16 - 8;
  const int v = y % 16 - 8;
  return u * u + v * v < squaredRadius ? RGB{ 1.0, 0.95, 0.8 } : RGB{ 0.15, 0.12, 0.2 };
}

RGB Spots(int x, int y) { return Spot(x, y, 12); }

RGB SpotsSmaller(int x, int y) { return Spot(x, y, 8); }

// Radiance: ranges of 10 stops and more.
RGB SunAt(int x, int y, int center)
{
  const double distance = (x - center) * (x - center) + (y - 20) * (y - 20);
  const double value = std::exp2(10.0 * std::exp(-distance / 50.0) - 3.0);
  return { value, 0.8 * value, 0.5 * value };
}

RGB Sun(int x, int y) { return SunAt(x, y, 40); }

RGB SunMoved(int x, int y) { return SunAt(x, y, 41); }

RGB Ramp(int x, int y)
{
  return { std::exp2(x / 8.0 - 6.0), std::exp2(y / 8.0 - 6.0), std::exp2((x + y) / 16.0 - 6.0) };
}

RGB RampTinted(int x, int y)
{
  const RGB rgb = Ramp(x, y);
  return { 1.1 * rgb[0], rgb[1], (x > 30 ? 0.8 : 1.0) * rgb[2] };
}

RGB Steps(int x, int y)
{
  const double value = std::pow(4.0, (x / 16 + 2 * (y / 16)) % 5 - 2);
  return { value, 0.7 * value, 1.3 * value };
}

RGB StepsNoisy(int x, int y)
{
  RGB rgb = Steps(x, y);
  for (int c = 0; c < 3; ++c)
  {
    rgb[c] *= 0.9 + 0.2 * Noise(x, y, 17 * c);
  }
  return rgb;
}
}

TEST(PictureMetrics, AgreeWithOtherPrograms)
{
  const struct
  {
    Formula Picture;
    Formula Reference;
    double FLIP;
    double SSIM;
    double DeltaE2000;
  } pairs[] = { { GradientDarker, Gradient, 0.272276223, 0.997387109528, 4.22898952451 },
    { StripesMoved, Stripes, 0.157704681, 0.932571087678, 6.87718973523 },
    { FlatNoisy, Flat, 0.142451823, 0.402350140716, 6.14372473239 },
    { SpotsSmaller, Spots, 0.312436730, 0.544149614956, 5.22163838591 } };
  for (const auto& pair : pairs)
  {
    vtkNew<vtkRadianceMetrics> metrics;
    // The display's encoding undone: what is compared is the picture of the formula.
    ASSERT_TRUE(
      metrics->ComparePictures(Width, Height, Draw(pair.Picture, 2.2), Draw(pair.Reference, 2.2)));
    EXPECT_NEAR(metrics->GetFLIP(), pair.FLIP, 3e-5); // single precision: 2e-5
    EXPECT_NEAR(metrics->GetSSIM(), pair.SSIM, 1e-10);
    EXPECT_NEAR(metrics->GetDeltaE2000(), pair.DeltaE2000, 1e-8);
    ASSERT_TRUE(metrics->ComparePictures(
      Width, Height, Draw(pair.Reference, 2.2), Draw(pair.Reference, 2.2)));
    EXPECT_EQ(metrics->GetFLIP(), 0.0);
    EXPECT_EQ(metrics->GetHDRFLIP(), 0.0);
    EXPECT_NEAR(metrics->GetSSIM(), 1.0, 1e-12);
    EXPECT_EQ(metrics->GetDeltaE2000(), 0.0);
  }
}

TEST(PictureMetrics, HDRFlipAgreesWithTheAuthors)
{
  const struct
  {
    Formula Picture;
    Formula Reference;
    double HDRFLIP;
  } pairs[] = { { SunMoved, Sun, 0.0711380222 }, { RampTinted, Ramp, 0.1433122823 },
    { StepsNoisy, Steps, 0.0385226437 } }; // 10, 3 and 4 exposures
  for (const auto& pair : pairs)
  {
    vtkNew<vtkRadianceMetrics> metrics;
    ASSERT_TRUE(metrics->ComparePictures(Width, Height, Draw(pair.Picture), Draw(pair.Reference)));
    EXPECT_NEAR(metrics->GetHDRFLIP(), pair.HDRFLIP, 1e-5);
  }
}

// Where the median is black its exposure has no end of its own: the authors' program goes 2^-23
// below 1, this class 2^-23 below the largest luminance, which is 1 here.
TEST(PictureMetrics, HDRFlipOfABlackBackground)
{
  const Formula square = [](int x, int y) {
    return x < 16 && y < 16 ? RGB{ 1.0, 1.0, 1.0 } : RGB{ 0.0, 0.0, 0.0 };
  };
  const Formula darker = [](int x, int y) {
    return x < 16 && y < 16 ? RGB{ 0.9, 0.9, 0.9 } : RGB{ 0.0, 0.0, 0.0 };
  };
  vtkNew<vtkRadianceMetrics> metrics;
  ASSERT_TRUE(metrics->ComparePictures(Width, Height, Draw(darker), Draw(square)));
  EXPECT_NEAR(metrics->GetHDRFLIP(), 0.0062487132, 1e-6);
}

TEST(PictureMetrics, CoverageAndSize)
{
  vtkNew<vtkRadianceMetrics> metrics;
  vtkNew<vtkDoubleArray> left;
  for (int k = 0; k < Width * Height; ++k)
  {
    left->InsertNextValue(k % Width < Width / 2 ? 1.0 : 0.0);
  }
  // Alike where it counts, whatever there is elsewhere.
  const Formula half = [](int x, int y) {
    return x < Width / 2 ? Steps(x, y) : RGB{ 9.0, 0.0, 9.0 };
  };
  ASSERT_TRUE(metrics->ComparePictures(Width, Height, Draw(half), Draw(Steps), left));
  EXPECT_EQ(metrics->GetHDRFLIP(), 0.0);
  EXPECT_NEAR(metrics->GetSSIM(), 1.0, 1e-12);
  EXPECT_EQ(metrics->GetDeltaE2000(), 0.0);
  ASSERT_TRUE(metrics->ComparePictures(Width, Height, Draw(half), Draw(Steps)));
  EXPECT_GT(metrics->GetHDRFLIP(), 0.1);
  EXPECT_LT(metrics->GetSSIM(), 0.9);
  // No window of 11 x 11 fits into 10 rows of 64: there is no SSIM, but all else.
  const auto cut = Draw(Steps);
  cut->SetNumberOfTuples(10 * Width);
  ASSERT_TRUE(metrics->ComparePictures(Width, 10, cut, cut));
  EXPECT_TRUE(std::isnan(metrics->GetSSIM()));
  EXPECT_EQ(metrics->GetFLIP(), 0.0);
}

TEST(PictureMetrics, StopsWhereItIsAborted)
{
  vtkNew<vtkRadianceMetrics> metrics;
  ExpectStops(
    metrics.Get(),
    [&]() { return metrics->ComparePictures(Width, Height, Draw(SunMoved), Draw(Sun)); },
    [&]() { return metrics->GetFLIP(); }, 1);
  EXPECT_GT(metrics->GetFLIP(), 0.0);
}

// The pairs and differences of Sharma, Wu, Dalal 2005, table 1, which gives four digits.
TEST(PictureMetrics, DeltaE2000OfThePublishedPairs)
{
  const double pairs[34][7] = {
    { 50.0000, 2.6772, -79.7751, 50.0000, 0.0000, -82.7485, 2.0425 },
    { 50.0000, 3.1571, -77.2803, 50.0000, 0.0000, -82.7485, 2.8615 },
    { 50.0000, 2.8361, -74.0200, 50.0000, 0.0000, -82.7485, 3.4412 },
    { 50.0000, -1.3802, -84.2814, 50.0000, 0.0000, -82.7485, 1.0000 },
    { 50.0000, -1.1848, -84.8006, 50.0000, 0.0000, -82.7485, 1.0000 },
    { 50.0000, -0.9009, -85.5211, 50.0000, 0.0000, -82.7485, 1.0000 },
    { 50.0000, 0.0000, 0.0000, 50.0000, -1.0000, 2.0000, 2.3669 },
    { 50.0000, -1.0000, 2.0000, 50.0000, 0.0000, 0.0000, 2.3669 },
    { 50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0009, 7.1792 },
    { 50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0010, 7.1792 },
    { 50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0011, 7.2195 },
    { 50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0012, 7.2195 },
    { 50.0000, -0.0010, 2.4900, 50.0000, 0.0009, -2.4900, 4.8045 },
    { 50.0000, -0.0010, 2.4900, 50.0000, 0.0010, -2.4900, 4.8045 },
    { 50.0000, -0.0010, 2.4900, 50.0000, 0.0011, -2.4900, 4.7461 },
    { 50.0000, 2.5000, 0.0000, 50.0000, 0.0000, -2.5000, 4.3065 },
    { 50.0000, 2.5000, 0.0000, 73.0000, 25.0000, -18.0000, 27.1492 },
    { 50.0000, 2.5000, 0.0000, 61.0000, -5.0000, 29.0000, 22.8977 },
    { 50.0000, 2.5000, 0.0000, 56.0000, -27.0000, -3.0000, 31.9030 },
    { 50.0000, 2.5000, 0.0000, 58.0000, 24.0000, 15.0000, 19.4535 },
    { 50.0000, 2.5000, 0.0000, 50.0000, 3.1736, 0.5854, 1.0000 },
    { 50.0000, 2.5000, 0.0000, 50.0000, 3.2972, 0.0000, 1.0000 },
    { 50.0000, 2.5000, 0.0000, 50.0000, 1.8634, 0.5757, 1.0000 },
    { 50.0000, 2.5000, 0.0000, 50.0000, 3.2592, 0.3350, 1.0000 },
    { 60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644 },
    { 63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.2630 },
    { 61.2901, 3.7196, -5.3901, 61.4292, 2.2480, -4.9620, 1.8731 },
    { 35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645 },
    { 22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373 },
    { 36.4612, 47.8580, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146 },
    { 90.8027, -2.0831, 1.4410, 91.1528, -1.6435, 0.0447, 1.4441 },
    { 90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381 },
    { 6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377 },
    { 2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082 },
  };
  for (const double* pair : pairs)
  {
    EXPECT_NEAR(vtkRadianceMetrics::ComputeDeltaE2000(pair, pair + 3), pair[6], 5.1e-5);
    EXPECT_NEAR(vtkRadianceMetrics::ComputeDeltaE2000(pair + 3, pair), pair[6], 5.1e-5);
    EXPECT_EQ(vtkRadianceMetrics::ComputeDeltaE2000(pair, pair), 0.0);
  }
}
