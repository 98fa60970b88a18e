// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Measured materials under real environments against figures computed with the RGL authors' own
// evaluation code.
#include "SharedData.h"
#include "SpherePairs.h"

#include "vtkBRDFReader.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironmentReader.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <tuple>

namespace
{
// Rows of nx,ny,nz,vx,vy,vz,r,g,b below a line of names; # starts a remark.
bool ReadExpected(
  const std::string& name, vtkDoubleArray* normals, vtkDoubleArray* views, vtkDoubleArray* radiance)
{
  std::ifstream file(name);
  std::string line;
  while (std::getline(file, line))
  {
    double v[9];
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", v, v + 1, v + 2, v + 3,
          v + 4, v + 5, v + 6, v + 7, v + 8) == 9)
    {
      normals->InsertNextTuple(v);
      views->InsertNextTuple(v + 3);
      radiance->InsertNextTuple(v + 6);
    }
  }
  return radiance->GetNumberOfTuples() > 0;
}
} // namespace

class ExactReference : public testing::TestWithParam<std::tuple<const char*, const char*>>
{
};

//------------------------------------------------------------------------------
TEST_P(ExactReference, MeasuredMaterial)
{
  const std::string material = std::get<0>(GetParam());
  const std::string light = std::get<1>(GetParam());
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> expected;
  for (vtkDoubleArray* array : { normals.Get(), views.Get(), expected.Get() })
  {
    array->SetNumberOfComponents(3);
  }
  if (!ReadExpected(
        SharedData + "/expected/" + material + "." + light + ".csv", normals, views, expected))
  {
    GTEST_SKIP() << "no measured data at " << SharedData;
  }
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(SharedData + "/materials/rgl/" + material + "_rgb.bsdf");
  ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
  vtkNew<vtkEnvironmentReader> environment;
  environment->SetFileName(SharedData + "/environments/" + light + ".exr");
  ASSERT_TRUE(environment->Read()) << environment->GetErrorMessage();

  const auto integrator = NewExactSum(reader->GetBRDF(), environment->GetEnvironment());
  vtkNew<vtkDoubleArray> radiance;
  ASSERT_TRUE(integrator->Integrate(normals, views, radiance));
  double worst = 0.0;
  for (vtkIdType k = 0; k < expected->GetNumberOfTuples(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double e = expected->GetComponent(k, c);
      EXPECT_NEAR(radiance->GetComponent(k, c), e, 1e-5 * e) << "pair " << k << " channel " << c;
      worst = std::max(worst, std::abs(radiance->GetComponent(k, c) / e - 1.0));
    }
  }
  vtkNew<vtkFilteredRadianceIntegrator> filtered;
  filtered->SetBRDF(reader->GetBRDF());
  filtered->SetEnvironment(environment->GetEnvironment());
  filtered->SetNumberOfSamples(128);
  ASSERT_TRUE(filtered->Integrate(normals, views, radiance));
  double difference = 0.0, sum = 0.0;
  for (vtkIdType k = 0; k < expected->GetNumberOfValues(); ++k)
  {
    difference += std::abs(radiance->GetValue(k) - expected->GetValue(k));
    sum += expected->GetValue(k);
  }
  std::printf("%s, %s: largest relative difference %.2e, of 128 samples %.4f\n", material.c_str(),
    light.c_str(), worst, difference / sum);
  EXPECT_LT(difference, 0.1 * sum);
}

// The other materials take the same code; three keep the run short.
INSTANTIATE_TEST_SUITE_P(RGL, ExactReference,
  testing::Values(std::tuple("satin_purple", "studio"), std::tuple("cc_ibiza_sunset", "interior"),
    std::tuple("acrylic_felt_pink", "studio")),
  [](const auto& info)
  { return std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param); });
