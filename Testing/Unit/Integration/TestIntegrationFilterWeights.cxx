// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Weights of texture units, which come in steps.

#include "ErrorCatcher.h"
#include "SpherePairs.h"

#include "vtkAnisotropicTableRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBasisRadianceIntegrator.h"
#include "vtkFactoredRadianceIntegrator.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkSmartPointer.h"
#include "vtkTableRadianceIntegrator.h"

namespace
{
double GetRelativeL1(const std::vector<glm::dvec3>& values, const std::vector<glm::dvec3>& exact)
{
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k)
  {
    difference += glm::dot(glm::abs(values[k] - exact[k]), glm::dvec3(1.0));
    sum += glm::dot(exact[k], glm::dvec3(1.0));
  }
  return difference / sum;
}

// The loss by weights of 4 and of 8 bits.
void Check(vtkRadianceIntegrator* integrator, vtkBRDF* brdf, const std::vector<int>& sizes)
{
  SCOPED_TRACE(integrator->GetClassName());
  vtkNew<vtkEnvironment> hall;
  hall->SetToProceduralHall();
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(hall);
  ASSERT_TRUE(integrator->SetSizes(sizes));
  SpherePairs pairs;
  pairs.AddRandom(200);
  const std::vector<glm::dvec3> exact = pairs.Integrate(integrator);
  integrator->SetFilterWeightBits(4);
  const double coarse = GetRelativeL1(pairs.Integrate(integrator), exact);
  integrator->SetFilterWeightBits(8);
  const double fine = GetRelativeL1(pairs.Integrate(integrator), exact);
  // Sixteen times the steps, at most 1/2 of one off.
  EXPECT_GT(coarse, 8.0 * fine);
  EXPECT_LT(coarse, 32.0 * fine);
  EXPECT_GT(fine, 1e-5);
  EXPECT_LT(fine, 3e-3);
  integrator->SetFilterWeightBits(0); // and nothing was prepared anew, or changed
  EXPECT_EQ(GetRelativeL1(pairs.Integrate(integrator), exact), 0.0);
}
}

TEST(FilterWeights, CostLessTheMoreBits)
{
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetExponents(60.0, 60.0);
  gloss->SetDiffuse(0.2, 0.2, 0.2);
  Check(vtkNew<vtkTableRadianceIntegrator>(), gloss, { 33, 8, 8 });
  Check(vtkNew<vtkFactoredRadianceIntegrator>(), gloss, { 64, 8, 17, 8, 8 });
  Check(vtkNew<vtkHybridRadianceIntegrator>(), gloss, { 33, 8, 8, 0, 16 });
  Check(vtkNew<vtkFilteredRadianceIntegrator>(), gloss, { 16 });
  Check(vtkNew<vtkBasisRadianceIntegrator>(), gloss, { 9 });
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(5.0, 40.0);
  Check(vtkNew<vtkAnisotropicTableRadianceIntegrator>(), brushed, { 17, 4, 8, 4 });
}

TEST(FilterWeights, AreKept)
{
  vtkNew<vtkTableRadianceIntegrator> table;
  ErrorCatcher errors(table);
  EXPECT_EQ(table->GetFilterWeightBits(), 0);
  table->SetFilterWeightBits(9);
  const auto copy = vtkSmartPointer<vtkRadianceIntegrator>::Take(table->NewCopy());
  EXPECT_EQ(copy->GetFilterWeightBits(), 9);
  EXPECT_EQ(errors.Take(), 0);
  table->SetFilterWeightBits(-1);
  EXPECT_EQ(table->GetFilterWeightBits(), 0);
  table->SetFilterWeightBits(100);
  EXPECT_EQ(table->GetFilterWeightBits(), 23);
}
