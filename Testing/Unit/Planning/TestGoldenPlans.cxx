// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Plans as Testing/Data/golden-plans.csv holds them: a change of structure changes none; a change
// of method writes them anew (MEASUREDBRDF_WRITE_GOLDEN=FILE) and says why.
// Every third row is tried; all of them, which takes two minutes, where MEASUREDBRDF_ALL_PLANS is
// set.

#include "NumberText.h"
#include "vtkBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

namespace
{
const std::string Shared = MEASUREDBRDF_SHARED_DATA;

struct Row
{
  std::string Material;
  std::string Environment;
  double Tolerance;
  std::string Method;
  std::string Sizes;
  double Error;
};

std::vector<Row> ReadRows()
{
  std::vector<Row> rows;
  std::ifstream file(MEASUREDBRDF_GOLDEN_PLANS);
  std::string line;
  std::getline(file, line); // names
  while (std::getline(file, line))
  {
    std::istringstream fields(line);
    Row row;
    std::string tolerance, error;
    std::getline(fields, row.Material, ';');
    std::getline(fields, row.Environment, ';');
    std::getline(fields, tolerance, ';');
    std::getline(fields, row.Method, ';');
    std::getline(fields, row.Sizes, ';');
    std::getline(fields, error, ';');
    EXPECT_TRUE(measuredbrdf::ParseNumber(tolerance, row.Tolerance));
    EXPECT_TRUE(measuredbrdf::ParseNumber(error, row.Error));
    rows.push_back(row);
  }
  return rows;
}

bool IsShared(const std::string& name) { return name.find('/') != std::string::npos; }

vtkSmartPointer<vtkBRDF> NewMaterial(const std::string& name)
{
  if (!IsShared(name))
  {
    return vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
  }
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(Shared + "/materials/" + name);
  reader->Read();
  return reader->GetBRDF();
}

vtkSmartPointer<vtkEnvironment> NewEnvironment(const std::string& name)
{
  if (!IsShared(name))
  {
    return vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(name));
  }
  vtkNew<vtkEnvironmentReader> reader;
  reader->SetFileName(Shared + "/" + name);
  reader->Read();
  return reader->GetEnvironment();
}

// Those of the product itself, or those of real data.
void Check(bool shared)
{
  const char* output = std::getenv("MEASUREDBRDF_WRITE_GOLDEN");
  std::ofstream written;
  if (output)
  {
    written.open(output, std::ios::app);
  }
  std::map<std::string, vtkSmartPointer<vtkEnvironment>> environments;
  const int step = output || std::getenv("MEASUREDBRDF_ALL_PLANS") ? 1 : 3;
  int seen = 0;
  int count = 0;
  for (const Row& row : ReadRows())
  {
    if ((IsShared(row.Material) || IsShared(row.Environment)) != shared || seen++ % step != 0)
    {
      continue;
    }
    if (!MEASUREDBRDF_WITH_OPENEXR &&
        (row.Material == "blue-car-paint" || row.Environment == "room"))
    {
      std::cout << "left out, this build has no OpenEXR: " << row.Material << " under "
                << row.Environment << "\n";
      continue;
    }
    auto& environment = environments[row.Environment];
    if (!environment)
    {
      environment = NewEnvironment(row.Environment);
    }
    const auto material = NewMaterial(row.Material);
    ASSERT_TRUE(material && environment) << row.Material << " " << row.Environment;
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(material);
    planner->SetEnvironment(environment);
    planner->SetErrorTolerance(row.Tolerance);
    ASSERT_TRUE(planner->Update());
    const int choice = planner->GetChoice();
    const std::string pair = row.Material + " under " + row.Environment;
    EXPECT_EQ(planner->GetMethodName(choice), row.Method) << pair;
    EXPECT_EQ(planner->GetDescription(choice), row.Sizes) << pair;
    // Another compiler's rounding may draw other pairs: what stands for chance may differ, too.
    EXPECT_NEAR(planner->GetPredictedError(choice), row.Error,
      0.02 * row.Error + planner->GetErrorUncertainty(choice))
      << pair;
    if (output)
    {
      written << row.Material << ";" << row.Environment << ";" << row.Tolerance << ";"
              << planner->GetMethodName(choice) << ";" << planner->GetDescription(choice) << ";"
              << planner->GetPredictedError(choice) << "\n";
    }
    ++count;
  }
  EXPECT_GE(count, 4);
}
} // namespace

//------------------------------------------------------------------------------
TEST(GoldenPlans, EmbeddedMaterials) { Check(false); }

//------------------------------------------------------------------------------
TEST(GoldenPlans, RealData)
{
  if (!std::ifstream(Shared + "/environments/forest.exr"))
  {
    GTEST_SKIP() << "real data is not there: " << Shared;
  }
  Check(true);
}
