// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a person sees of an error, against other programs' figures: FLIP and HDR-FLIP of the
// authors' own (flip-evaluator 1.7, which is NVlabs/flip, in single precision), SSIM and CIEDE2000
// of scikit-image 0.26.0 (whose CIEDE2000 got CIELAB of 8-bit pictures by the exact matrix of Rec.
// 709, not by its own with six digits), on small pictures made by formula. Other figures by hand.

#include "ErrorCatcher.h"
#include "ExpectStops.h"

#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPictureDifference.h"
#include "vtkPointData.h"
#include "vtkRadianceMetrics.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{
constexpr int Width = 64;
constexpr int Height = 48;

using RGB = glm::dvec3;
using Formula = RGB (*)(int x, int y);

vtkSmartPointer<vtkDoubleArray> Draw(Formula formula, double exponent = 1.0)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(3);
  for (int k = 0; k < Width * Height; ++k)
  {
    const RGB rgb = glm::pow(formula(k % Width, k / Width), RGB(exponent));
    array->InsertNextTuple(&rgb.x);
  }
  return array;
}

// In [0,1), of a seed for each channel.
RGB Noise(int x, int y, const glm::ivec3& seeds)
{
  return RGB((seeds + x * 73 + y * 151 + x * y * 7) % 101) / 100.0;
}

// Pictures as displayed, in [0,1]; more than 1 % of each reference's channels are 1.
RGB Gradient(int x, int y)
{
  return x < 4 ? RGB{ 1.0, 1.0, 1.0 } : RGB{ x / 64.0, y / 48.0, (x + y) / 112.0 };
}

RGB GradientDarker(int x, int y) { return RGB(0.9, 0.95, 1.0) * Gradient(x, y); }

RGB Stripe(int x, int y)
{
  return (x / 6 + y / 8) % 2 ? RGB{ 0.9, 0.2, 0.1 } : RGB{ 0.1, 0.4, 0.8 };
}

RGB Stripes(int x, int y) { return y < 4 ? RGB{ 1.0, 1.0, 1.0 } : Stripe(x, y); }

RGB StripesMoved(int x, int y) { return y < 4 ? RGB{ 1.0, 1.0, 1.0 } : Stripe(x + 1, y); }

RGB Flat(int x, int) { return x >= 60 ? RGB{ 1.0, 1.0, 1.0 } : RGB{ 0.3, 0.5, 0.2 }; }

RGB FlatNoisy(int x, int y)
{
  return glm::min(Flat(x, y) * (0.8 + 0.4 * Noise(x, y, { 0, 31, 62 })), 1.0);
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
  return std::exp2(10.0 * std::exp(-distance / 50.0) - 3.0) * RGB(1.0, 0.8, 0.5);
}

RGB Sun(int x, int y) { return SunAt(x, y, 40); }

RGB SunMoved(int x, int y) { return SunAt(x, y, 41); }

RGB Ramp(int x, int y) { return glm::exp2(RGB(x / 8.0, y / 8.0, (x + y) / 16.0) - 6.0); }

RGB RampTinted(int x, int y) { return Ramp(x, y) * RGB(1.1, 1.0, x > 30 ? 0.8 : 1.0); }

RGB Steps(int x, int y)
{
  return std::pow(4.0, (x / 16 + 2 * (y / 16)) % 5 - 2) * RGB(1.0, 0.7, 1.3);
}

RGB StepsNoisy(int x, int y) { return Steps(x, y) * (0.9 + 0.2 * Noise(x, y, { 0, 17, 34 })); }

vtkSmartPointer<vtkDoubleArray> MakeArray(const std::vector<double>& values, int components = 3)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(components);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  return array;
}

using Image = vtkSmartPointer<vtkImageData>;

Image MakeImage(int type, int width, int height, int components, const std::vector<double>& values)
{
  auto image = Image::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(type, components);
  for (int k = 0; k < width * height * components; ++k)
  {
    image->GetPointData()->GetScalars()->SetComponent(
      k / components, k % components, values[static_cast<std::size_t>(k) % values.size()]);
  }
  return image;
}

double Compare(
  vtkPictureDifference* difference, int metric, vtkImageData* picture, vtkImageData* reference)
{
  difference->SetMetric(metric);
  EXPECT_TRUE(difference->Compare(picture, reference)) << difference->GetErrorMessage();
  return difference->GetValue();
}

RGB FlatBytes(int, int) { return { 77.0, 128.0, 51.0 }; }

RGB NoisyBytes(int x, int y)
{
  const double noise = (x * 73 + y * 151 + x * y * 7) % 41 - 20;
  return { 77.0 + noise, 128.0 + noise, 51.0 - noise };
}

Image DrawBytes(Formula formula)
{
  std::vector<double> values;
  for (int k = 0; k < Width * Height; ++k)
  {
    const RGB bytes = formula(k % Width, k / Width);
    values.insert(values.end(), &bytes.x, &bytes.x + 3);
  }
  return MakeImage(VTK_UNSIGNED_CHAR, Width, Height, 3, values);
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

// By hand.
TEST(RadianceMetrics, ByHand)
{
  vtkNew<vtkRadianceMetrics> metrics;
  // Sums over channels: 3 of 6, 0 of 3, 1 of 1; the last pixel's reference is black.
  const auto reference = MakeArray({ 1, 2, 3, 1, 1, 1, 1, 0, 0, 0, 0, 0 });
  const auto radiance = MakeArray({ 2, 2, 1, 1, 1, 1, 0, 0, 0, 0, 0, 2 });
  ASSERT_TRUE(metrics->Compare(radiance, reference));
  EXPECT_NEAR(metrics->GetRelativeL1(), 6.0 / 10.0, 1e-12);
  EXPECT_NEAR(metrics->GetRelativeRMSE(), std::sqrt(10.0 / 12.0) / (10.0 / 12.0), 1e-12);
  // Against r^2 + (10/12)^2 / 100 = r^2 + 1/144, with r = 1, 3, 1, 0.
  EXPECT_NEAR(metrics->GetRelMSE(),
    (144.0 / 145.0 + 4.0 * 144.0 / 1297.0 + 144.0 / 145.0 + 4.0 * 144.0) / 12.0, 1e-12);
  EXPECT_NEAR(metrics->GetMedianRelative(), 0.5, 1e-12); // of 0, 0.5, 1
  EXPECT_NEAR(metrics->GetP99Relative(), 0.99, 1e-12);
  // Of 0, 1, 2, 3 over a mean of 10/4.
  EXPECT_NEAR(metrics->GetPercentile95(), 2.85 / 2.5, 1e-12);
  EXPECT_NEAR(metrics->GetPercentile99(), 2.97 / 2.5, 1e-12);
  EXPECT_NEAR(metrics->GetSMAPE(), (1.0 / 3.0 + 2.0 / 4.0 + 1.0 + 1.0) / 12.0, 1e-12);

  ASSERT_TRUE(metrics->Compare(reference, reference));
  for (const double figure : { metrics->GetRelativeL1(), metrics->GetRelativeRMSE(),
         metrics->GetRelMSE(), metrics->GetMedianRelative(), metrics->GetP99Relative(),
         metrics->GetPercentile99(), metrics->GetSMAPE() })
  {
    EXPECT_EQ(figure, 0.0);
  }
}

TEST(RadianceMetrics, BadInput)
{
  vtkNew<vtkRadianceMetrics> metrics;
  ErrorCatcher errors(metrics);
  const auto good = MakeArray({ 1, 2, 3, 1, 1, 1 });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(metrics->Compare(nullptr, good));
  EXPECT_FALSE(metrics->Compare(good, MakeArray({ 1, 2, 3 })));
  EXPECT_FALSE(metrics->Compare(MakeArray({ 1, 2, nan, 1, 1, 1 }), good));
  EXPECT_FALSE(metrics->Compare(good, MakeArray({ 1, 2, -1, 1, 1, 1 })));
  EXPECT_FALSE(metrics->Compare(good, MakeArray({ 0, 0, 0, 0, 0, 0 })));
  EXPECT_FALSE(metrics->ComparePictures(2, 2, good, good));
  EXPECT_FALSE(metrics->ComparePictures(2, 1, good, good, good));
  EXPECT_EQ(errors.Take(), 7);
  EXPECT_EQ(metrics->GetRelativeL1(), 0.0);
  EXPECT_TRUE(metrics->ComparePictures(2, 1, good, good));
  EXPECT_EQ(errors.Take(), 0);
}

TEST(PictureDifference, AgreesWithOtherPrograms)
{
  vtkNew<vtkPictureDifference> difference;
  const Image picture = DrawBytes(NoisyBytes);
  const Image reference = DrawBytes(FlatBytes);
  using D = vtkPictureDifference;
  EXPECT_NEAR(Compare(difference, D::FLIP, picture, reference), 0.109003030, 3e-5);
  EXPECT_NEAR(Compare(difference, D::SSIM, picture, reference), 0.373014026206, 1e-10);
  EXPECT_NEAR(Compare(difference, D::DELTA_E_2000, picture, reference), 5.25466461186, 1e-8);
  for (int metric = 0; metric < D::NUMBER_OF_METRICS; ++metric)
  {
    EXPECT_NEAR(Compare(difference, metric, reference, reference), metric == D::SSIM, 1e-12);
  }
}

TEST(PictureDifference, FiguresByHand)
{
  vtkNew<vtkPictureDifference> difference;
  const Image reference = MakeImage(VTK_FLOAT, 2, 1, 1, { 1.0, 3.0 });
  const Image picture = MakeImage(VTK_DOUBLE, 2, 1, 3, { 1.5, 1.0, 1.0, 3.0, 3.0, 3.0 });
  // 0.5 of 3 * (1 + 3) in all; each pixel's share of the mean.
  EXPECT_NEAR(
    Compare(difference, vtkPictureDifference::RELATIVE_L1, picture, reference), 0.5 / 12.0, 1e-12);
  EXPECT_NEAR(difference->GetMap()->GetScalarComponentAsDouble(0, 0, 0, 0), 0.5 / 6.0, 1e-7);
  EXPECT_EQ(difference->GetMap()->GetScalarComponentAsDouble(1, 0, 0, 0), 0.0);
  EXPECT_EQ(Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, picture, reference), 0.5);

  // Bytes are decoded by IEC 61966-2-1: 188 to 0.502886.
  const Image white = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 3, { 255.0 });
  const Image gray = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 3, { 188.0 });
  EXPECT_NEAR(
    Compare(difference, vtkPictureDifference::RELATIVE_L1, gray, white), 1.0 - 0.502886, 1e-6);
  EXPECT_NEAR(
    Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, gray, white), 67.0 / 255.0, 1e-12);
  const Image words = MakeImage(VTK_UNSIGNED_SHORT, 2, 1, 3, { 188.0 * 257.0 });
  EXPECT_NEAR(Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, words, gray), 0.0, 1e-12);
}

TEST(PictureDifference, BorderAndMask)
{
  vtkNew<vtkPictureDifference> difference;
  std::vector<double> values(3 * 16 * 16, 100.0), mask(16 * 16, 255.0);
  const Image reference = MakeImage(VTK_UNSIGNED_CHAR, 16, 16, 3, values);
  values[0] = 200.0; // at the corner
  const Image corner = MakeImage(VTK_UNSIGNED_CHAR, 16, 16, 3, values);
  mask[0] = 127.0;
  const Image hides = MakeImage(VTK_UNSIGNED_CHAR, 16, 16, 1, mask);
  mask[0] = 128.0;
  const Image shows = MakeImage(VTK_UNSIGNED_CHAR, 16, 16, 1, mask);
  for (int metric = 0; metric < vtkPictureDifference::NUMBER_OF_METRICS; ++metric)
  {
    const bool similarity = vtkPictureDifference::IsSimilarity(metric);
    difference->SetMask(hides);
    EXPECT_NEAR(Compare(difference, metric, corner, reference), similarity, 1e-12);
    EXPECT_TRUE(difference->IsWithin(similarity ? 1.0 - 1e-12 : 0.0));
    difference->SetMask(nullptr);
    difference->SetBorder(1);
    EXPECT_NEAR(Compare(difference, metric, corner, reference), similarity, 1e-12);
    difference->SetBorder(0);
    difference->SetMask(shows);
    const double value = Compare(difference, metric, corner, reference);
    // SSIM's windows about the pixels in the middle do not reach the corner.
    EXPECT_EQ(value > 0.0 && !similarity, !similarity) << metric;
  }
}

// Each of the four edges.
TEST(PictureDifference, BorderOnAllSides)
{
  vtkNew<vtkPictureDifference> difference;
  const Image reference = MakeImage(VTK_UNSIGNED_CHAR, 16, 16, 3, { 100.0 });
  for (const int pixel : { 8, 8 * 16, 8 * 16 + 15, 15 * 16 + 8 })
  {
    std::vector<double> values(3 * 16 * 16, 100.0);
    values[3 * static_cast<std::size_t>(pixel)] = 200.0;
    const Image picture = MakeImage(VTK_UNSIGNED_CHAR, 16, 16, 3, values);
    difference->SetBorder(0);
    EXPECT_GT(Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, picture, reference), 0.3);
    difference->SetBorder(1);
    EXPECT_EQ(Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, picture, reference), 0.0);
  }
}

TEST(PictureDifference, AlphaOverBlackAndWhite)
{
  vtkNew<vtkPictureDifference> difference;
  // Black: over black its alpha does not show; over white it does.
  const Image opaque = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 4, { 0.0, 0.0, 0.0, 255.0 });
  const Image half = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 4, { 0.0, 0.0, 0.0, 51.0 });
  EXPECT_GT(Compare(difference, vtkPictureDifference::FLIP, half, opaque), 0.5);
  EXPECT_NEAR(Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, half, opaque), 0.8, 1e-12);
  difference->IgnoreAlphaOn();
  EXPECT_EQ(Compare(difference, vtkPictureDifference::FLIP, half, opaque), 0.0);
  EXPECT_EQ(Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, half, opaque), 0.0);
  difference->IgnoreAlphaOff();
  // White over white; integers' colors are not multiplied by alpha, floats' are.
  const Image white = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 4, { 255.0, 255.0, 255.0, 51.0 });
  const Image multiplied = MakeImage(VTK_FLOAT, 2, 1, 4, { 0.0, 0.0, 0.0, 0.0 });
  const Image clear = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 2, { 255.0, 0.0 });
  EXPECT_EQ(Compare(difference, vtkPictureDifference::FLIP, clear, multiplied), 0.0);
  EXPECT_GT(Compare(difference, vtkPictureDifference::FLIP, white, multiplied), 0.1);
}

TEST(PictureDifference, HeatMap)
{
  vtkNew<vtkPictureDifference> difference;
  EXPECT_EQ(difference->NewHeatMap(), nullptr);
  EXPECT_EQ(difference->GetMap(), nullptr);
  const Image black = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 3, { 0.0 });
  const Image white = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 3, { 0.0, 0.0, 0.0, 255.0, 255.0, 255.0 });
  Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, white, black);
  difference->SetMetric(vtkPictureDifference::DELTA_E_2000); // the map is of the last Compare
  const auto heat = Image::Take(difference->NewHeatMap());
  // The ends of magma.
  const auto getColor = [](vtkImageData* image, vtkIdType pixel)
  {
    RGB color;
    image->GetPointData()->GetScalars()->GetTuple(pixel, &color.x);
    return color;
  };
  EXPECT_EQ(getColor(heat, 0), RGB(0.0, 0.0, 4.0));
  EXPECT_EQ(getColor(heat, 1), RGB(252.0, 253.0, 191.0));
  // The middle of matplotlib's: (183, 55, 121) at 128 of 255.
  const Image gray = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 3, { 128.0 });
  Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, gray, black);
  const auto middle = Image::Take(difference->NewHeatMap());
  EXPECT_LT(glm::distance(getColor(middle, 0), RGB(183.0, 55.0, 121.0)), 5.0);
  // CIEDE2000 is brightest at 10.
  const Image lighter = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 3, { 141.0 });
  EXPECT_NEAR(Compare(difference, vtkPictureDifference::DELTA_E_2000, lighter, gray), 5.0, 0.3);
  const auto half = Image::Take(difference->NewHeatMap());
  EXPECT_NEAR(getColor(half, 0).x, 183.0, 15.0);
}

TEST(PictureDifference, BadInput)
{
  const Image good = MakeImage(VTK_UNSIGNED_CHAR, 20, 20, 3, { 9.0 });
  const Image black = MakeImage(VTK_UNSIGNED_CHAR, 20, 20, 3, { 0.0 });
  const Image wide = MakeImage(VTK_UNSIGNED_CHAR, 30, 20, 3, { 9.0 });
  const Image small = MakeImage(VTK_UNSIGNED_CHAR, 3, 2, 3, { 9.0 });
  const Image nan =
    MakeImage(VTK_FLOAT, 2, 1, 3, { 0, 0, 0, 0, std::numeric_limits<double>::quiet_NaN(), 0 });
  const Image negative = MakeImage(VTK_FLOAT, 2, 1, 3, { -0.5, 0, 0, 0, 0, 0 });
  const Image integers = MakeImage(VTK_INT, 20, 20, 3, { 9.0 });
  const Image floats = MakeImage(VTK_FLOAT, 20, 20, 3, { 0.5 });
  const Image many = MakeImage(VTK_UNSIGNED_CHAR, 20, 20, 5, { 9.0 });
  vtkNew<vtkImageData> empty;
  using D = vtkPictureDifference;
  const struct
  {
    int Metric;
    vtkImageData* Picture;
    vtkImageData* Reference;
    std::vector<std::string> Words;
  } cases[] = { { D::FLIP, nullptr, good, { "picture", "none" } },
    { D::FLIP, good, nullptr, { "reference", "none" } },
    { D::FLIP, empty, good, { "picture", "one slice" } },
    { D::FLIP, wide, good, { "picture", "30 x 20", "20 x 20" } },
    { D::FLIP, nan, nan, { "(1, 0)", "channel 1", "nan" } },
    { D::FLIP, negative, negative, { "(0, 0)", "-0.5", "at least 0" } },
    { D::FLIP, good, integers, { "reference", "int", "unsigned char" } },
    { D::FLIP, many, many, { "channels", "5" } }, { D::SSIM, small, small, { "11 x 11" } },
    { D::HDR_FLIP, good, black, { "reference", "black" } },
    { D::RELATIVE_L1, good, black, { "reference", "black" } },
    { D::MAX_DIFFERENCE, good, floats, { "max_difference", "floats" } } };
  vtkNew<vtkPictureDifference> difference;
  ErrorCatcher errors(difference);
  for (const auto& one : cases)
  {
    difference->SetMetric(one.Metric);
    EXPECT_FALSE(difference->Compare(one.Picture, one.Reference));
    EXPECT_EQ(errors.Take(), 1);
    for (const std::string& word : one.Words)
    {
      EXPECT_NE(difference->GetErrorMessage().find(word), std::string::npos)
        << "'" << word << "' in: " << difference->GetErrorMessage();
    }
  }
  difference->SetMetric(D::FLIP);
  difference->SetBorder(10);
  EXPECT_FALSE(difference->Compare(good, good));
  EXPECT_NE(difference->GetErrorMessage().find("no pixel"), std::string::npos);
  difference->SetBorder(0);
  difference->SetMask(wide);
  EXPECT_FALSE(difference->Compare(good, good));
  EXPECT_NE(difference->GetErrorMessage().find("mask: size"), std::string::npos);
  EXPECT_EQ(errors.Take(), 2);
  difference->SetMetric(D::NUMBER_OF_METRICS);
  difference->SetBorder(-1);
  EXPECT_EQ(errors.Take(), 2);
  EXPECT_EQ(difference->GetMetric(), D::FLIP);
  EXPECT_EQ(difference->GetBorder(), 0);
}

TEST(PictureDifference, Names)
{
  using D = vtkPictureDifference;
  const char* names[] = { "flip", "hdr_flip", "ssim", "delta_e_2000", "relative_l1",
    "max_difference" };
  for (int metric = 0; metric < D::NUMBER_OF_METRICS; ++metric)
  {
    EXPECT_EQ(D::GetMetricName(metric), names[metric]);
    EXPECT_EQ(D::FindMetric(names[metric]), metric);
    EXPECT_EQ(D::IsSimilarity(metric), metric == D::SSIM);
    EXPECT_LT(D::GetDefaultThreshold(metric), 1.0);
  }
  EXPECT_EQ(D::GetMetricName(-1), "");
  EXPECT_EQ(D::GetMetricName(D::NUMBER_OF_METRICS), "");
  EXPECT_EQ(D::FindMetric("FLIP"), -1);
}
