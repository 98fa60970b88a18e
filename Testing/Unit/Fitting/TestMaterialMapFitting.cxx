// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// From simulated photographs to materials and weights, against the sample that was photographed.

#include "MappedSample.h"

#include "vtkDataArray.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialMapFitter.h"
#include "vtkPointData.h"

#include <iostream>
#include <map>
#include <random>

#include <gtest/gtest.h>

namespace
{
const std::vector<std::string> Three = { "nickel", "red-fabric2", "blue-rubber" };

/// All built-in materials.
void AddLibrary(vtkMaterialMapFitter* fitter)
{
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    fitter->AddMaterial(brdf, name);
  }
}

/// Largest and mean difference of weights, by the materials' names.
struct WeightDifference
{
  double Largest = 0.0;
  double Mean = 0.0;
};

WeightDifference CompareWeights(vtkMaterialMap* found, vtkMaterialMap* original)
{
  std::map<std::string, int> numbers;
  for (int k = 0; k < found->GetNumberOfMaterials(); ++k)
  {
    numbers[found->GetName(k)] = k;
  }
  WeightDifference result;
  const int texels = static_cast<int>(original->GetWeightImage(0)->GetNumberOfPoints());
  for (int k = 0; k < original->GetNumberOfMaterials(); ++k)
  {
    const auto number = numbers.find(original->GetName(k));
    for (int texel = 0; texel < texels; ++texel)
    {
      const double weight = number == numbers.end() ? 0.0 : GetWeight(found, number->second, texel);
      const double difference = std::abs(weight - GetWeight(original, k, texel));
      result.Largest = std::max(result.Largest, difference);
      result.Mean += difference / (texels * original->GetNumberOfMaterials());
    }
  }
  return result;
}

/// Relative L1 difference of the photographs that two maps give, at directions that no fit here
/// has: half of them anywhere, half near the mirror direction.
double ComparePhotographs(vtkMaterialMap* found, vtkMaterialMap* original)
{
  vtkNew<vtkSimulatedPhotographSet> sets[2];
  sets[0]->SetMaterialMap(found);
  sets[1]->SetMaterialMap(original);
  std::mt19937 random(3);
  const auto number = [&](double from, double to)
  { return from + (to - from) * random() * 0x1p-32; };
  for (int k = 0; k < 60; ++k)
  {
    double light[3], view[3];
    const double theta = number(0.0, 60.0), phi = number(0.0, 360.0);
    vtkPhotographSet::GetDirection(theta, phi, light);
    const bool mirror = k % 2 == 1;
    vtkPhotographSet::GetDirection(mirror ? theta + number(0.0, 8.0) : number(0.0, 60.0),
      mirror ? phi + number(175.0, 185.0) : number(0.0, 360.0), view);
    sets[0]->AddDirections(light, view);
    sets[1]->AddDirections(light, view);
  }
  double difference = 0.0, sum = 0.0;
  for (int k = 0; k < sets[0]->GetNumberOfPhotographs(); ++k)
  {
    const auto a = vtkSmartPointer<vtkImageData>::Take(sets[0]->NewPicture(k));
    const auto b = vtkSmartPointer<vtkImageData>::Take(sets[1]->NewPicture(k));
    vtkDataArray* x = a->GetPointData()->GetScalars();
    vtkDataArray* r = b->GetPointData()->GetScalars();
    double pictureDifference = 0.0, pictureSum = 0.0;
    for (vtkIdType texel = 0; texel < x->GetNumberOfTuples(); ++texel)
    {
      for (int c = 0; c < 3; ++c)
      {
        pictureDifference += std::abs(x->GetComponent(texel, c) - r->GetComponent(texel, c));
        pictureSum += r->GetComponent(texel, c);
      }
    }
    difference += pictureDifference / pictureSum; // photographs count alike
    sum += 1.0;
  }
  return difference / sum;
}
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
// The true deviations of weights against those that the fitter says; half with four times the
// photographs.
TEST(MaterialMapFitter, NoiseMakesWeightsAsUncertainAsItSays)
{
  const auto original = NewMappedSample(Three, 24, 0.6); // no weight is near 0
  double before = 0.0;
  for (const int count : { 40, 160 })
  {
    const auto photographs = NewPhotographs(original, count);
    photographs->SetNoise(0.01);
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

//------------------------------------------------------------------------------
TEST(MaterialMapFitter, FindsMaterialsAsTables)
{
  const auto original = NewMappedSample(Three, 32);
  vtkNew<vtkSimulatedPhotographSet> photographs;
  photographs->SetMaterialMap(original);
  photographs->AddHalfVectorDirections(400, 0.0);
  vtkNew<vtkMaterialMapFitter> fitter;
  fitter->SetPhotographs(photographs);
  fitter->SetMethodToTables();
  fitter->SetMaximumNumberOfMaterials(3);
  ASSERT_TRUE(fitter->Fit());
  ASSERT_EQ(fitter->GetOutput()->GetNumberOfMaterials(), 3);
  const double unseen = ComparePhotographs(fitter->GetOutput(), original);
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

//------------------------------------------------------------------------------
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
