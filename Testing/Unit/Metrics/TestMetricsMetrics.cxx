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
