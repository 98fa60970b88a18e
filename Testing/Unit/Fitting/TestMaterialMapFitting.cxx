// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// From simulated photographs to materials and weights, against the sample that was photographed;
// and photographs that are tiny, broken, masked and mismatched.

#include "ErrorCatcher.h"
#include "ExpectStops.h"
#include "MappedSample.h"

#include "vtkFloatArray.h"
#include "vtkLambertBRDF.h"
#include "vtkSMPTools.h"
#include "vtkTabulatedBRDF.h"

#include <cstring>
#include <iostream>
#include <limits>

#include <gtest/gtest.h>

namespace
{
const std::vector<std::string> Three = { "nickel", "red-fabric2", "blue-rubber" };
const std::vector<std::string> Two = { "nickel", "red-fabric2" };

vtkSmartPointer<vtkMaterialMapFitter> NewFitter(
  vtkPhotographSet* photographs, vtkMaterialMap* library)
{
  auto fitter = vtkSmartPointer<vtkMaterialMapFitter>::New();
  fitter->SetPhotographs(photographs);
  fitter->SetTableDimensions(6, 8, 16); // small ones, for speed
  for (int k = 0; k < library->GetNumberOfMaterials(); ++k)
  {
    fitter->AddMaterial(library->GetBRDF(k), library->GetName(k));
  }
  return fitter;
}

/// The same photographs as plain pictures, which a test may spoil.
struct Pictures
{
  explicit Pictures(vtkPhotographSet* source)
  {
    for (int k = 0; k < source->GetNumberOfPhotographs(); ++k)
    {
      double light[3], view[3];
      source->GetLight(k, light);
      source->GetView(k, view);
      const auto picture = vtkSmartPointer<vtkImageData>::Take(source->NewPicture(k));
      this->Set->AddPhotograph(picture, light, view, source->GetExposure(k));
      this->Images.push_back(picture);
    }
  }

  vtkNew<vtkPhotographSet> Set;
  std::vector<vtkSmartPointer<vtkImageData>> Images;
};

std::vector<float> GetValues(vtkMaterialMapFitter* fitter)
{
  std::vector<float> values;
  vtkImageData* images[] = { fitter->GetOutput()->GetWeightImage(0), fitter->GetErrorImage() };
  for (vtkImageData* image : images)
  {
    auto* array = vtkFloatArray::SafeDownCast(image->GetPointData()->GetScalars());
    values.insert(
      values.end(), array->GetPointer(0), array->GetPointer(array->GetNumberOfValues()));
  }
  for (int k = 0; k < fitter->GetOutput()->GetNumberOfMaterials(); ++k)
  {
    if (auto* table = vtkTabulatedBRDF::SafeDownCast(fitter->GetOutput()->GetBRDF(k)))
    {
      values.insert(values.end(), table->GetVolume().begin(), table->GetVolume().end());
    }
  }
  return values;
}
}

TEST(MaterialMapFitter, OneTexelAndOnePhotograph)
{
  const auto original = NewMappedSample(Two, 1);
  for (const int count : { 1, 30 })
  {
    const auto fitter = NewFitter(NewPhotographs(original, count), original);
    ASSERT_TRUE(fitter->Fit());
    EXPECT_LT(fitter->GetWorstError(), 1e-5);
    fitter->SetMethodToTables();
    fitter->SetMaximumNumberOfMaterials(4); // more than there can be
    ASSERT_TRUE(fitter->Fit());
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      sum += GetWeight(fitter->GetOutput(), k, 0);
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_GT(fitter->GetNumberOfFindings(), 0); // one texel does not tell four materials
  }
}

TEST(MaterialMapFitter, WantsPhotographsAndALibrary)
{
  vtkNew<vtkMaterialMapFitter> fitter;
  ErrorCatcher errors(fitter);
  EXPECT_FALSE(fitter->Fit());
  EXPECT_NE(errors.GetText().find("no photographs"), std::string::npos);
  vtkNew<vtkPhotographSet> none;
  fitter->SetPhotographs(none);
  EXPECT_FALSE(fitter->Fit());
  const auto original = NewMappedSample(Two, 2);
  fitter->SetPhotographs(NewPhotographs(original, 2));
  EXPECT_FALSE(fitter->Fit());
  EXPECT_NE(errors.GetText().find("no material in the library"), std::string::npos);
  fitter->AddMaterial(nullptr, "");
  fitter->SetMaximumNumberOfMaterials(33);
  fitter->SetMethod(2);
  EXPECT_EQ(errors.Take(), 6);
  EXPECT_EQ(fitter->GetMaximumNumberOfMaterials(), 4);
  EXPECT_EQ(fitter->GetOutput(), nullptr);
}

TEST(MaterialMapFitter, PhotographsOfOneSize)
{
  const auto original = NewMappedSample(Two, 4);
  const auto photographs = NewPhotographs(original, 8);
  const auto fitter = NewFitter(photographs, original);
  ASSERT_TRUE(fitter->Fit());
  vtkMaterialMap* const output = fitter->GetOutput();
  Pictures pictures(photographs);
  vtkNew<vtkImageData> other;
  other->SetDimensions(4, 5, 1);
  other->AllocateScalars(VTK_FLOAT, 3);
  const double up[3] = { 0.0, 0.0, 1.0 };
  pictures.Set->AddPhotograph(other, up, up, 1.0, "odd.png");
  fitter->SetPhotographs(pictures.Set);
  ErrorCatcher errors(fitter);
  EXPECT_FALSE(fitter->Fit());
  EXPECT_NE(
    errors.GetText().find("odd.png: size: found 4 x 5, expected the first photograph's 4 x 4"),
    std::string::npos)
    << errors.GetText();
  EXPECT_EQ(fitter->GetOutput(), output); // stays
  other->SetDimensions(4, 4, 1);
  other->AllocateScalars(VTK_FLOAT, 2);
  EXPECT_FALSE(fitter->Fit());
  EXPECT_NE(errors.GetText().find("odd.png: found 2 components"), std::string::npos);
}

// Spoiled pixels are left out and counted; what is left still gives the weights.
TEST(MaterialMapFitter, LeavesOutSpoiledPixels)
{
  const auto original = NewMappedSample(Two, 6);
  Pictures pictures(NewPhotographs(original, 20));
  const float spoiled[] = { std::numeric_limits<float>::quiet_NaN(),
    std::numeric_limits<float>::infinity(), 1e30f };
  for (std::size_t k = 0; k < pictures.Images.size(); ++k)
  {
    auto* values = static_cast<float*>(pictures.Images[k]->GetScalarPointer());
    for (std::size_t texel = 0; texel < 36; ++texel)
    {
      if ((texel + k) % 5 == 0 || texel == 7) // the eighth one always
      {
        values[3 * texel + (texel + k) % 3] = spoiled[k % 3];
      }
      else if ((texel + k) % 5 == 1)
      {
        values[3 * texel] = values[3 * texel + 1] = values[3 * texel + 2] = -3.0f;
      }
      else if ((texel + k) % 5 == 2)
      {
        values[3 * texel + 2] = 100.0f;
      }
    }
  }
  pictures.Set->LevelsForFloatsOn();
  pictures.Set->SetSaturationLevel(50.0);
  const auto fitter = NewFitter(pictures.Set, original);
  ASSERT_TRUE(fitter->Fit());
  EXPECT_EQ(fitter->GetNumberOfTexelsWithoutData(), 1);
  EXPECT_EQ(fitter->GetNumberOfInvalidPixels(), 36 * 20 / 5 + 20 - 4);
  EXPECT_EQ(fitter->GetNumberOfBlackPixels(), 36 * 20 / 5 - 4);
  EXPECT_EQ(fitter->GetNumberOfSaturatedPixels(), 36 * 20 / 5 - 4);
  EXPECT_EQ(fitter->GetErrorImage()->GetScalarComponentAsDouble(1, 1, 0, 0), -1.0);
  EXPECT_EQ(GetWeight(fitter->GetOutput(), 0, 7) + GetWeight(fitter->GetOutput(), 1, 7), 0.0);
  EXPECT_LT(fitter->GetWorstError(), 1e-5);
  for (int texel = 0; texel < 36; ++texel)
  {
    if (texel != 7)
    {
      EXPECT_NEAR(GetWeight(fitter->GetOutput(), 0, texel), GetWeight(original, 0, texel), 2e-5);
    }
  }
  fitter->SetMethodToTables();
  fitter->SetMaximumNumberOfMaterials(2);
  ASSERT_TRUE(fitter->Fit());
  EXPECT_LT(fitter->GetFactorizationError(), 0.01);
}

TEST(MaterialMapFitter, NothingButSpoiledPixels)
{
  const auto original = NewMappedSample(Two, 3);
  Pictures pictures(NewPhotographs(original, 4));
  for (vtkImageData* image : pictures.Images)
  {
    image->GetPointData()->GetScalars()->Fill(std::numeric_limits<double>::quiet_NaN());
  }
  const auto fitter = NewFitter(pictures.Set, original);
  ErrorCatcher errors(fitter);
  for (const int method : { vtkMaterialMapFitter::LIBRARY, vtkMaterialMapFitter::TABLES })
  {
    fitter->SetMethod(method);
    EXPECT_FALSE(fitter->Fit());
    EXPECT_NE(errors.GetText().find("no pixel is valid"), std::string::npos);
  }
}

// 12 bits with a clipped highlight, and 8 bits by sRGB's curve.
TEST(MaterialMapFitter, IntegersAreSharesOfTheirLargest)
{
  const auto original = NewMappedSample(Two, 8);
  const auto photographs = NewPhotographs(original, 60);
  photographs->Bits = 12;
  const auto fitter = NewFitter(photographs, original);
  ASSERT_TRUE(fitter->Fit());
  EXPECT_GT(fitter->GetNumberOfSaturatedPixels(), 0);
  EXPECT_LT(CompareWeights(fitter->GetOutput(), original).Largest, 0.02);

  vtkNew<vtkPhotographSet> bytes;
  for (int k = 0; k < photographs->GetNumberOfPhotographs(); ++k)
  {
    const auto picture = vtkSmartPointer<vtkImageData>::Take(photographs->NewPicture(k));
    vtkNew<vtkImageData> encoded;
    encoded->SetDimensions(8, 8, 1);
    encoded->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* codes = static_cast<unsigned char*>(encoded->GetScalarPointer());
    vtkDataArray* values = picture->GetPointData()->GetScalars();
    for (vtkIdType v = 0; v < 3 * 64; ++v)
    {
      const double linear = values->GetComponent(v / 3, static_cast<int>(v % 3)) / 65535.0;
      const double code =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
      codes[v] = static_cast<unsigned char>(std::lround(255.0 * code));
    }
    double light[3], view[3];
    photographs->GetLight(k, light);
    photographs->GetView(k, view);
    bytes->AddPhotograph(encoded, light, view);
  }
  const auto other = NewFitter(bytes, original);
  ASSERT_TRUE(other->Fit());
  EXPECT_LT(CompareWeights(other->GetOutput(), original).Largest, 0.05);
}

TEST(MaterialMapFitter, TheSameBitsOnAnyNumberOfThreads)
{
  const auto original = NewMappedSample(Two, 40);
  const auto photographs = NewPhotographs(original, 30);
  photographs->Noise = 0.01;
  const auto fitter = NewFitter(photographs, original);
  fitter->SetNumberOfSampleTexels(500);
  const std::string usual = vtkSMPTools::GetBackend();
  for (const int method : { vtkMaterialMapFitter::LIBRARY, vtkMaterialMapFitter::TABLES })
  {
    fitter->SetMethod(method);
    fitter->SetMaximumNumberOfMaterials(2);
    ASSERT_TRUE(vtkSMPTools::SetBackend("Sequential"));
    ASSERT_TRUE(fitter->Fit());
    const std::vector<float> one = GetValues(fitter);
    ASSERT_TRUE(vtkSMPTools::SetBackend("STDThread"));
    vtkSMPTools::Initialize(3);
    ASSERT_TRUE(fitter->Fit());
    const std::vector<float> several = GetValues(fitter);
    ASSERT_EQ(several.size(), one.size());
    EXPECT_EQ(std::memcmp(several.data(), one.data(), one.size() * sizeof(float)), 0);
    vtkSMPTools::Initialize();
    vtkSMPTools::SetBackend(usual.c_str());
  }
}

TEST(MaterialMapFitter, StopsWhenAskedTo)
{
  const auto original = NewMappedSample(Two, 8);
  const auto fitter = NewFitter(NewPhotographs(original, 20), original);
  for (const int method : { vtkMaterialMapFitter::LIBRARY, vtkMaterialMapFitter::TABLES })
  {
    fitter->SetMethod(method);
    ExpectStops(
      fitter.Get(), [&]() { return fitter->Fit(); }, [&]() { return fitter->GetOutput(); }, 0,
      { 0.0, 0.2, 0.4, 0.7 });
  }
}

TEST(PhotographSet, RefusesDirectionsBelowTheHorizon)
{
  vtkNew<vtkPhotographSet> set;
  ErrorCatcher errors(set);
  vtkNew<vtkImageData> picture;
  const double up[3] = { 0.0, 0.0, 2.0 }, level[3] = { 1.0, 0.0, 0.0 },
               down[3] = { 0.0, 0.1, -1.0 }, none[3] = { 0.0, 0.0, 0.0 },
               broken[3] = { std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0 };
  for (const double* bad : { level, down, none, broken })
  {
    EXPECT_EQ(set->AddPhotograph(picture, bad, up, 1.0, "a.png"), -1);
    EXPECT_NE(errors.GetText().find("a.png: light: found ("), std::string::npos);
    EXPECT_EQ(set->AddPhotograph(picture, up, bad), -1);
  }
  EXPECT_EQ(set->AddPhotograph(picture, up, up, 0.0), -1);
  EXPECT_EQ(set->AddPhotograph(picture, up, up, std::numeric_limits<double>::infinity()), -1);
  EXPECT_EQ(set->AddPhotograph(nullptr, up, up), -1);
  EXPECT_EQ(errors.Take(), 11);
  EXPECT_EQ(set->GetNumberOfPhotographs(), 0);
  const double tilted[3] = { 3.0, 0.0, 4.0 };
  EXPECT_EQ(set->AddPhotograph(picture, up, up, 2.0), 0);
  EXPECT_EQ(set->AddPhotograph(picture, tilted, up, 2.0), 1);
  EXPECT_DOUBLE_EQ(set->GetScale(1), 2.0 * set->GetIrradiance() * 0.8);
  double light[3];
  set->GetLight(0, light);
  EXPECT_EQ(light[2], 1.0);
  EXPECT_DOUBLE_EQ(set->GetScale(0), 2.0 * set->GetIrradiance());
  EXPECT_EQ(set->NewPicture(2), nullptr);
}

TEST(MaterialMapFitter, FindsTheMaterialsOfALibraryAndTheirWeights)
{
  const auto original = NewMappedSample(Three, 24);
  vtkNew<vtkMaterialMapFitter> fitter;
  fitter->SetPhotographs(NewPhotographs(original, 60));
  AddLibrary(fitter);
  ASSERT_TRUE(fitter->Fit());
  ASSERT_EQ(fitter->GetOutput()->GetNumberOfMaterials(), 3);
  const WeightDifference difference = CompareWeights(fitter->GetOutput(), original);
  EXPECT_LT(difference.Largest, 2e-5); // the photographs are floats
  EXPECT_LT(fitter->GetWorstError(), 1e-5);
  EXPECT_EQ(fitter->GetNumberOfFindings(), 0) << fitter->GetFinding(0);
  EXPECT_EQ(fitter->GetNumberOfTexelsWithoutData(), 0);
  std::cout << "largest difference of weights " << difference.Largest << "\n";
}

// The true deviations of weights against those that the fitter says; half with four times the
// photographs.
TEST(MaterialMapFitter, NoiseMakesWeightsAsUncertainAsItSays)
{
  const auto original = NewMappedSample(Three, 24, 0.6); // no weight is near 0
  double before = 0.0;
  for (const int count : { 40, 160 })
  {
    const auto photographs = NewPhotographs(original, count);
    photographs->Noise = 0.01;
    vtkNew<vtkMaterialMapFitter> fitter;
    fitter->SetPhotographs(photographs);
    for (int k = 0; k < original->GetNumberOfMaterials(); ++k)
    {
      fitter->AddMaterial(original->GetBRDF(k), original->GetName(k));
    }
    ASSERT_TRUE(fitter->Fit());
    ASSERT_EQ(fitter->GetOutput()->GetNumberOfMaterials(), 3);
    for (int k = 0; k < 3; ++k)
    {
      double square = 0.0;
      for (int texel = 0; texel < 24 * 24; ++texel)
      {
        square +=
          std::pow(GetWeight(fitter->GetOutput(), k, texel) - GetWeight(original, k, texel), 2);
      }
      const double deviation = std::sqrt(square / (24 * 24));
      // Nickel shines in few photographs, whose values are large beside the mean residual.
      EXPECT_LT(deviation / fitter->GetUncertainty(k), 1.2) << Three[static_cast<std::size_t>(k)];
      if (k > 0)
      {
        EXPECT_GT(deviation / fitter->GetUncertainty(k), 0.8) << Three[static_cast<std::size_t>(k)];
      }
      std::cout << count << " photographs, " << fitter->GetOutput()->GetName(k) << ": deviation "
                << deviation << ", said " << fitter->GetUncertainty(k) << "\n";
    }
    const double mean = CompareWeights(fitter->GetOutput(), original).Mean;
    if (before > 0.0)
    {
      EXPECT_NEAR(before / mean, 2.0, 0.7);
    }
    before = mean;
  }
}

TEST(MaterialMapFitter, FindsMaterialsAsTables)
{
  const auto original = NewMappedSample(Three, 32);
  vtkNew<SimulatedPhotographs> photographs;
  photographs->Map = original;
  photographs->AddHalfVectorDirections(400, 0.0);
  vtkNew<vtkMaterialMapFitter> fitter;
  fitter->SetPhotographs(photographs);
  fitter->SetMethodToTables();
  fitter->SetMaximumNumberOfMaterials(3);
  ASSERT_TRUE(fitter->Fit());
  ASSERT_EQ(fitter->GetOutput()->GetNumberOfMaterials(), 3);
  const double unseen = 0.5 * (ComparePhotographs(fitter->GetOutput(), original, false) +
                                ComparePhotographs(fitter->GetOutput(), original, true));
  std::cout << "factors " << fitter->GetFactorizationError() << ", mean " << fitter->GetMeanError()
            << ", 95 % " << fitter->GetError95() << ", worst " << fitter->GetWorstError()
            << ", seen " << fitter->GetSeenShare() << ", iterations "
            << fitter->GetNumberOfIterations() << ", unseen photographs " << unseen << "\n";
  EXPECT_TRUE(fitter->GetConverged());
  EXPECT_LT(fitter->GetFactorizationError(), 0.005); // Compactness draws the materials together
  EXPECT_LT(fitter->GetMeanError(), 0.03);
  EXPECT_LT(unseen, 0.04);
  EXPECT_EQ(fitter->GetNumberOfFindings(), 0) << fitter->GetFinding(0);
}

TEST(MaterialMapFitter, SaysWhatThePhotographsLeaveOpen)
{
  vtkNew<vtkLambertBRDF> a, b, c;
  a->SetAlbedo(0.5, 0.4, 0.3);
  b->SetAlbedo(0.5, 0.4, 0.3);
  c->SetAlbedo(0.1, 0.1, 0.1);
  const auto original = NewMappedSample({ "nickel", "nickel" }, 8);
  original->SetBRDF(0, a);
  original->SetBRDF(1, c);
  vtkNew<vtkMaterialMapFitter> fitter;
  fitter->SetPhotographs(NewPhotographs(original, 20));
  fitter->AddMaterial(a, "a");
  fitter->AddMaterial(b, "its twin");
  fitter->AddMaterial(c, "c");
  ASSERT_TRUE(fitter->Fit());
  ASSERT_EQ(fitter->GetOutput()->GetNumberOfMaterials(), 2);
  ASSERT_EQ(fitter->GetNumberOfFindings(), 1);
  EXPECT_NE(fitter->GetFinding(0).find("'a' could as well be 'its twin'"), std::string::npos)
    << fitter->GetFinding(0);

  // Found materials of a sample that has fewer: the third one is like another.
  fitter->SetMethodToTables();
  fitter->SetMaximumNumberOfMaterials(3);
  ASSERT_TRUE(fitter->Fit());
  ASSERT_GT(fitter->GetNumberOfFindings(), 0);
  EXPECT_NE(fitter->GetFinding(0).find("not determined"), std::string::npos)
    << fitter->GetFinding(0);
}
