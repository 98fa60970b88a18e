// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Which material has which weight: the map apart from data and drawing.

#include "ErrorCatcher.h"
#include "vtkImageData.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialMap.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace
{
class MaterialMap : public testing::Test
{
protected:
  vtkNew<vtkMaterialMap> Map;
  vtkNew<vtkLambertBRDF> A;
  vtkNew<vtkLambertBRDF> B;
  vtkNew<vtkLambertBRDF> C;
};

TEST_F(MaterialMap, ClassesAreFoundByTheirValue)
{
  EXPECT_EQ(this->Map->AddMaterial(this->A, 7.0, "granite"), 0);
  EXPECT_EQ(this->Map->AddMaterial(this->B, -2.5, "basalt"), 1);
  EXPECT_EQ(this->Map->AddMaterial(nullptr, 3.0), 2);
  EXPECT_EQ(this->Map->FindClass(7.0), 0);
  EXPECT_EQ(this->Map->FindClass(-2.5), 1);
  EXPECT_EQ(this->Map->FindClass(3.0), 2);
  EXPECT_EQ(this->Map->FindClass(6.999), -1);
  EXPECT_EQ(this->Map->FindClass(std::numeric_limits<double>::quiet_NaN()), -1);
  EXPECT_EQ(this->Map->GetBRDF(0), this->A);
  EXPECT_EQ(this->Map->GetBRDF(2), nullptr);
  EXPECT_EQ(this->Map->GetName(1), "basalt");
  EXPECT_EQ(this->Map->GetWeight(0, 7.0), 1.0);
  EXPECT_EQ(this->Map->GetWeight(0, 6.0), 0.0);
  // The same value takes the place; without a value they count on.
  EXPECT_EQ(this->Map->AddMaterial(this->C, 7.0, "gneiss"), 0);
  EXPECT_EQ(this->Map->GetBRDF(0), this->C);
  EXPECT_EQ(this->Map->AddMaterial(this->A, "last"), 3);
  EXPECT_EQ(this->Map->GetValue(3), 8.0);
  std::ostringstream text;
  this->Map->Print(text);
  EXPECT_NE(text.str().find("Material 7 \"gneiss\""), std::string::npos) << text.str();
}

TEST_F(MaterialMap, ValuesBlendLinearly)
{
  this->Map->SetModeToValues();
  this->Map->AddMaterial(this->B, 10.0); // not in the order of values
  this->Map->AddMaterial(this->A, 0.0);
  this->Map->AddMaterial(this->C, 30.0);
  const auto expect = [this](double value, double a, double b, double c)
  {
    EXPECT_DOUBLE_EQ(this->Map->GetWeight(1, value), a) << value;
    EXPECT_DOUBLE_EQ(this->Map->GetWeight(0, value), b) << value;
    EXPECT_DOUBLE_EQ(this->Map->GetWeight(2, value), c) << value;
  };
  expect(-5.0, 1.0, 0.0, 0.0);
  expect(0.0, 1.0, 0.0, 0.0);
  expect(2.5, 0.75, 0.25, 0.0);
  expect(10.0, 0.0, 1.0, 0.0);
  expect(15.0, 0.0, 0.75, 0.25);
  expect(30.0, 0.0, 0.0, 1.0);
  expect(1e300, 0.0, 0.0, 1.0);
  expect(std::numeric_limits<double>::infinity(), 0.0, 0.0, 1.0);
  expect(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.0);
}

TEST_F(MaterialMap, BadInputChangesNothing)
{
  this->Map->AddMaterial(this->A, 1.0);
  ErrorCatcher errors(this->Map);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(this->Map->AddMaterial(this->B, nan), -1);
  EXPECT_EQ(this->Map->AddMaterial(this->B, std::numeric_limits<double>::infinity()), -1);
  EXPECT_EQ(this->Map->GetNumberOfMaterials(), 1);
  this->Map->SetMode(4);
  this->Map->SetMode(-1);
  EXPECT_EQ(this->Map->GetMode(), vtkMaterialMap::CLASSES);
  this->Map->SetArrayComponent(-1);
  EXPECT_EQ(this->Map->GetArrayComponent(), 0);
  this->Map->SetBRDF(1, this->B);
  this->Map->SetName(-1, "nobody");
  this->Map->SetWeightArrayName(1, "none");
  this->Map->AddWeightImage(nullptr);
  EXPECT_EQ(errors.Take(), 9);
  EXPECT_EQ(this->Map->GetBRDF(1), nullptr);
  EXPECT_EQ(this->Map->GetName(-1), "");
  EXPECT_EQ(this->Map->GetValue(3), 0.0);
  EXPECT_EQ(this->Map->GetWeightImage(0), nullptr);
}

TEST_F(MaterialMap, HasALargestNumberOfMaterials)
{
  for (int k = 0; k < vtkMaterialMap::MaximumNumberOfMaterials; ++k)
  {
    ASSERT_EQ(this->Map->AddMaterial(this->A), k);
  }
  ErrorCatcher errors(this->Map);
  EXPECT_EQ(this->Map->AddMaterial(this->A), -1);
  EXPECT_EQ(errors.Take(), 1);
  this->Map->RemoveAllMaterials();
  EXPECT_EQ(this->Map->GetNumberOfMaterials(), 0);
  EXPECT_EQ(this->Map->FindClass(0.0), -1);
}

TEST_F(MaterialMap, ParametersOfAMaterialDivideNothingAnew)
{
  this->Map->AddMaterial(this->A, 1.0);
  const vtkMTimeType division = this->Map->GetDivisionMTime();
  const vtkMTimeType time = this->Map->GetMTime();
  this->A->SetAlbedo(0.1, 0.2, 0.3);
  EXPECT_EQ(this->Map->GetDivisionMTime(), division);
  EXPECT_GT(this->Map->GetMTime(), time);
  vtkNew<vtkImageData> image;
  this->Map->AddWeightImage(image);
  const vtkMTimeType withImage = this->Map->GetDivisionMTime();
  EXPECT_GT(withImage, division);
  image->Modified();
  EXPECT_GT(this->Map->GetDivisionMTime(), withImage);
}
}
