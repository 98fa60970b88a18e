// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Figures of error against values worked out by hand or from the formulas elsewhere.

#include "ErrorCatcher.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkRadianceMetrics.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace
{
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

// Gray pictures, a value a pixel.
double GetFlip(int width, int height, const std::vector<double>& picture,
  const std::vector<double>& reference, vtkDataArray* coverage = nullptr)
{
  std::vector<double> rgb[2];
  for (std::size_t k = 0; k < picture.size(); ++k)
  {
    rgb[0].insert(rgb[0].end(), 3, picture[k]);
    rgb[1].insert(rgb[1].end(), 3, reference[k]);
  }
  vtkNew<vtkRadianceMetrics> metrics;
  EXPECT_TRUE(
    metrics->ComparePictures(width, height, MakeArray(rgb[0]), MakeArray(rgb[1]), coverage));
  return metrics->GetFLIP();
}
}

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
         metrics->GetPercentile99(), metrics->GetSMAPE(), metrics->GetDeltaEITP() })
  {
    EXPECT_EQ(figure, 0.0);
  }
}

// 100 cd/m2 against 200 and against (200, 100, 100), from BT.2100 and BT.2124. (color-science
// 0.4.7 gives 51.15947 and, from a Rec. 2020 matrix of more digits than BT.2087's, 40.36933.)
TEST(RadianceMetrics, DeltaEITP)
{
  vtkNew<vtkRadianceMetrics> metrics;
  for (const double unit : { 1.0, 1e-3 })
  {
    const auto reference = MakeArray({ unit, unit, unit });
    ASSERT_TRUE(metrics->Compare(MakeArray({ 2 * unit, 2 * unit, 2 * unit }), reference));
    EXPECT_NEAR(metrics->GetDeltaEITP(), 51.15947, 1e-4);
    ASSERT_TRUE(metrics->Compare(MakeArray({ 2 * unit, unit, unit }), reference));
    EXPECT_NEAR(metrics->GetDeltaEITP(), 40.36880, 1e-4);
  }
}

// Flat pictures have no features: the paper's color difference alone.
TEST(RadianceMetrics, FlipOfFlatPictures)
{
  const std::vector<double> black(64, 0.0), half(64, 0.5), white(64, 1.0);
  EXPECT_NEAR(GetFlip(8, 8, white, white), 0.0, 1e-12);
  EXPECT_NEAR(GetFlip(8, 8, black, white), 0.967379, 1e-5);
  EXPECT_NEAR(GetFlip(8, 8, half, white), 0.539277, 1e-5);
  // The exposure follows the reference.
  const std::vector<double> dim(64, 1e-3), dimmer(64, 5e-4);
  EXPECT_NEAR(GetFlip(8, 8, dimmer, dim), 0.539277, 1e-5);
}

TEST(RadianceMetrics, FlipOfDetails)
{
  constexpr int side = 32;
  std::vector<double> checks, gray, step, line;
  for (int k = 0; k < side * side; ++k)
  {
    const int x = k % side;
    checks.push_back((x + k / side) % 2 ? 1.0 : 0.0);
    gray.push_back(0.5);
    step.push_back(x < side / 2 ? 0.2 : 1.0);
    line.push_back(x == side / 2 ? 1.0 : 0.2);
  }
  // The eye blurs single pixels into their mean (the encodings 1/2.2 and sRGB differ a little).
  EXPECT_LT(GetFlip(side, side, gray, checks), 0.1);
  // An edge is a difference of its own: more than the mean of both halves' colors.
  const std::vector<double> bright(step.size(), 1.0), low(step.size(), 0.2);
  const double colors = 0.5 * GetFlip(side, side, low, bright);
  EXPECT_GT(GetFlip(side, side, step, bright), 1.02 * colors);
  // A missing line shows, though less than a missing half.
  const double thin = GetFlip(side, side, low, line);
  EXPECT_GT(thin, 0.02);
  EXPECT_LT(thin, 0.5 * GetFlip(side, side, low, step));
  // Only covered pixels count, and what is not covered is black in both.
  const auto coverage = MakeArray(std::vector<double>(side * side, 1.0), 1);
  EXPECT_EQ(GetFlip(side, side, step, bright, coverage), GetFlip(side, side, step, bright));
  std::vector<double> outside = bright;
  for (int k = 0; k < side * side / 2; ++k)
  {
    coverage->SetValue(k, 0.0);
    outside[k] = 7.0;
  }
  EXPECT_NEAR(GetFlip(side, side, outside, bright, coverage), 0.0, 1e-12);
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
