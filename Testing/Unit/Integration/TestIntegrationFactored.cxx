// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A small table and the maps of what it lacks, against the reference and against large tables.

#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkTableRadianceIntegrator.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace
{
vtkNew<vtkTableRadianceIntegrator> NewFactored(vtkBRDF* brdf, vtkEnvironment* environment,
  int mapRows, int maps, const std::vector<int>& sizes = { 33, 12, 8 })
{
  vtkNew<vtkTableRadianceIntegrator> factored;
  factored->SetBRDF(brdf);
  factored->SetEnvironment(environment);
  factored->SetNumberOfMapRows(mapRows);
  factored->SetNumberOfMaps(maps);
  EXPECT_TRUE(factored->SetSizes(sizes));
  return factored;
}

vtkNew<vtkAshikhminShirleyBRDF> NewGloss(double exponent)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetDiffuse(0.1, 0.05, 0.02);
  brdf->SetSpecularScale(0.2, 0.5, 1.0);
  brdf->SetExponents(exponent, exponent);
  return brdf;
}
}

//------------------------------------------------------------------------------
// What the sharp part is for: chrome under a sun of one texel, better than a table of as much
// memory shows it.
TEST(FactoredIntegrator, MirrorsInFewMegabytes)
{
  const auto chrome = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("chrome"));
  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  SpherePairs pairs;
  pairs.AddRandom(1500);
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  vtkNew<vtkTableRadianceIntegrator> table;
  ASSERT_TRUE(table->SetSizes({ 257, 8, 8 }));
  const auto factored = NewFactored(chrome, sky, 256, 4);
  for (vtkRadianceIntegrator* way :
    { static_cast<vtkRadianceIntegrator*>(reference), static_cast<vtkRadianceIntegrator*>(table) })
  {
    way->SetBRDF(chrome);
    way->SetEnvironment(sky);
  }
  const auto expected = pairs.Integrate(reference);
  const double large = GetRelativeError(pairs.Integrate(table), expected);
  const double small = GetRelativeError(pairs.Integrate(factored), expected);
  std::printf("table %.4f, %.1f MB; factored %.4f, %.1f MB\n", large,
    1e-6 * static_cast<double>(table->EstimateTextureBytes()), small,
    1e-6 * static_cast<double>(factored->EstimateTextureBytes()));
  EXPECT_LT(small, 0.6 * large);
  EXPECT_LT(factored->EstimateTextureBytes(), 5000000);
}

//------------------------------------------------------------------------------
// With many maps it is the integral, but for interpolation.
TEST(FactoredIntegrator, MapsConverge)
{
  const auto environment = NewSmallEnvironment(true);
  const auto brdf = NewGloss(200.0);
  SpherePairs pairs;
  pairs.AddRandom(200);
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(brdf);
  reference->SetEnvironment(environment);
  const auto expected = pairs.Integrate(reference);
  double before = 1.0;
  for (const int maps : { 2, 8, 32 })
  {
    const auto factored = NewFactored(brdf, environment, 128, maps, { 33, 12, 12 });
    const double error = GetRelativeError(pairs.Integrate(factored), expected);
    std::printf("%d maps: %.5f\n", maps, error);
    EXPECT_LT(error, before);
    before = error;
  }
  EXPECT_LT(before, 0.025);
}

//------------------------------------------------------------------------------
TEST(FactoredIntegrator, SizesAndShaderInputs)
{
  const auto factored =
    NewFactored(NewGloss(100.0), NewSmallEnvironment(false), 16, 5, { 9, 4, 6 });
  vtkBRDFShaderInputs inputs;
  ASSERT_TRUE(factored->GetShaderInputs(inputs));
  ASSERT_EQ(inputs.Terms.size(), 1u);
  const vtkBRDFShaderInputs::Texture& fields = inputs.Terms[0].Textures.back();
  EXPECT_EQ(fields.Dimensions[0], 32);
  EXPECT_EQ(fields.Dimensions[1] % 16, 0);
  EXPECT_LE(fields.Dimensions[1], 5 * 16);
  EXPECT_GE(fields.Dimensions[1], 4 * 16);
  for (const float value : fields.Data)
  {
    ASSERT_LE(std::abs(value), 32768.5f);
  }
  EXPECT_NE(inputs.Description.find("32 x 16 of its sharp part"), std::string::npos);
  const auto copy = vtkSmartPointer<vtkRadianceIntegrator>::Take(factored->NewCopy());
  EXPECT_EQ(copy->GetSizesText(), factored->GetSizesText());
}
