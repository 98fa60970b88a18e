// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// From simulated photographs to materials and weights, against the sample that was photographed.

#include "MappedSample.h"

#include "vtkLambertBRDF.h"

#include <iostream>

#include <gtest/gtest.h>

namespace
{
const std::vector<std::string> Three = { "nickel", "red-fabric2", "blue-rubber" };
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
