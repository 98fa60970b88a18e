// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkPictureDifference: by hand, and against other programs' figures (TestMetricsPictures has more)
// (flip-evaluator 1.7, which is NVlabs/flip, in single precision; scikit-image 0.26.0, whose
// CIEDE2000 got CIELAB by the exact matrix of Rec. 709, not by its own with six digits) on 8-bit
// pictures made by formula.
#include "ErrorCatcher.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPictureDifference.h"
#include "vtkRadianceMetrics.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace
{
using Image = vtkSmartPointer<vtkImageData>;

Image MakeImage(int type, int width, int height, int components, const std::vector<double>& values)
{
  auto image = Image::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(type, components);
  std::size_t k = 0;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      for (int c = 0; c < components; ++c)
      {
        image->SetScalarComponentFromDouble(x, y, 0, c, values[k++ % values.size()]);
      }
    }
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

constexpr int Width = 64;
constexpr int Height = 48;

using Bytes = std::array<double, 3>;
using Formula = Bytes (*)(int x, int y);

Image Draw(Formula formula)
{
  std::vector<double> values;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      const Bytes bytes = formula(x, y);
      values.insert(values.end(), bytes.begin(), bytes.end());
    }
  }
  return MakeImage(VTK_UNSIGNED_CHAR, Width, Height, 3, values);
}

Bytes Flat(int, int) { return { 77.0, 128.0, 51.0 }; }

Bytes FlatNoisy(int x, int y)
{
  const double noise = (x * 73 + y * 151 + x * y * 7) % 41 - 20;
  return { 77.0 + noise, 128.0 + noise, 51.0 - noise };
}
}

TEST(PictureDifference, AgreesWithOtherPrograms)
{
  vtkNew<vtkPictureDifference> difference;
  const Image picture = Draw(FlatNoisy);
  const Image reference = Draw(Flat);
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
  const double ends[2][3] = { { 0.0, 0.0, 4.0 }, { 252.0, 253.0, 191.0 } };
  for (int x = 0; x < 2; ++x)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_EQ(heat->GetScalarComponentAsDouble(x, 0, 0, c), ends[x][c]);
    }
  }
  // The middle of matplotlib's: (183, 55, 121) at 128 of 255.
  const Image gray = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 3, { 128.0 });
  Compare(difference, vtkPictureDifference::MAX_DIFFERENCE, gray, black);
  const auto middle = Image::Take(difference->NewHeatMap());
  EXPECT_NEAR(middle->GetScalarComponentAsDouble(0, 0, 0, 0), 183.0, 3.0);
  EXPECT_NEAR(middle->GetScalarComponentAsDouble(0, 0, 0, 1), 55.0, 3.0);
  EXPECT_NEAR(middle->GetScalarComponentAsDouble(0, 0, 0, 2), 121.0, 3.0);
  // CIEDE2000 is brightest at 10.
  const Image lighter = MakeImage(VTK_UNSIGNED_CHAR, 2, 1, 3, { 141.0 });
  EXPECT_NEAR(Compare(difference, vtkPictureDifference::DELTA_E_2000, lighter, gray), 5.0, 0.3);
  const auto half = Image::Take(difference->NewHeatMap());
  EXPECT_NEAR(half->GetScalarComponentAsDouble(0, 0, 0, 0), 183.0, 15.0);
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
