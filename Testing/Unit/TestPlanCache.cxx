// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Plans that outlive the program: found again, made again where files are damaged, bounded in size.

#include "vtkBlinnPhongBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkRadianceCostModel.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace
{
class PlanCache : public ::testing::Test
{
protected:
  void SetUp() override
  {
    std::random_device random;
    this->Folder =
      (fs::temp_directory_path() / ("measuredbrdf-plans-" + std::to_string(random()))).string();
    this->BRDF->SetExponent(20.0);
    this->Environment->SetToProceduralSky();
  }
  void TearDown() override { fs::remove_all(this->Folder); }

  vtkSmartPointer<vtkRadiancePlanner> Plan()
  {
    auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
    planner->SetBRDF(this->BRDF);
    planner->SetEnvironment(this->Environment);
    planner->SetErrorTolerance(this->Tolerance);
    planner->SetMaximumCacheBytes(this->MaximumBytes);
    planner->SetCacheFolder(this->Folder);
    planner->SetCostModel(this->Costs);
    EXPECT_TRUE(planner->Update());
    return planner;
  }

  std::vector<fs::path> GetFiles() const
  {
    std::vector<fs::path> files;
    if (fs::exists(this->Folder))
    {
      for (const auto& entry : fs::directory_iterator(this->Folder))
      {
        files.push_back(entry.path());
      }
    }
    return files;
  }

  static std::vector<double> Integrate(vtkRadiancePlanner* planner)
  {
    auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
    vtkNew<vtkDoubleArray> normals, views, radiance;
    normals->SetNumberOfComponents(3);
    views->SetNumberOfComponents(3);
    normals->InsertNextTuple3(0.1, 0.9, 0.3);
    views->InsertNextTuple3(0.5, 0.5, 0.7);
    normals->InsertNextTuple3(-0.4, 0.2, 0.3);
    views->InsertNextTuple3(-0.5, -0.1, 0.7);
    EXPECT_TRUE(integrator->Integrate(normals, views, radiance));
    return std::vector<double>(
      radiance->GetPointer(0), radiance->GetPointer(0) + radiance->GetNumberOfValues());
  }

  std::string Folder;
  double Tolerance = 0.05;
  vtkSmartPointer<vtkRadianceCostModel> Costs;
  vtkIdType MaximumBytes = 512 << 20;
  vtkNew<vtkBlinnPhongBRDF> BRDF;
  vtkNew<vtkEnvironment> Environment;
};
}

TEST_F(PlanCache, FindsAPlanAgain)
{
  const auto first = this->Plan();
  EXPECT_FALSE(first->GetFromCache());
  EXPECT_EQ(this->GetFiles().size(), 1u);
  const auto second = this->Plan();
  EXPECT_TRUE(second->GetFromCache());
  EXPECT_EQ(first->GetPlan(), second->GetPlan());
  EXPECT_EQ(first->GetNumberOfCandidates(), second->GetNumberOfCandidates());
  EXPECT_EQ(Integrate(first), Integrate(second));
}

// Layers keep their table; lights and samples are made again.
TEST_F(PlanCache, FindsLayersAgain)
{
  this->BRDF->SetSpecular(0.5, 0.5, 0.5);
  this->BRDF->SetExponent(2000.0);
  this->Tolerance = 0.08;
  this->Environment->SetToProceduralHall();
  this->Costs = vtkSmartPointer<vtkRadianceCostModel>::New();
  this->Costs->SetCost(vtkRadianceCostModel::LIGHT, 0.1);
  const auto first = this->Plan();
  std::printf("%s\n", first->GetPlan().c_str());
  ASSERT_EQ(first->GetMethodName(first->GetChoice()), "layered");
  const auto second = this->Plan();
  EXPECT_TRUE(second->GetFromCache());
  EXPECT_EQ(first->GetPlan(), second->GetPlan());
  EXPECT_EQ(Integrate(first), Integrate(second));
  const fs::path file = this->GetFiles().at(0);
  EXPECT_GT(fs::file_size(file), 100000u);
}

TEST_F(PlanCache, WhatItDependsOnMakesAnother)
{
  this->Plan();
  this->Tolerance = 0.06;
  EXPECT_FALSE(this->Plan()->GetFromCache());
  this->BRDF->SetExponent(20.001);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  std::vector<float> pixels = this->Environment->GetPixels();
  pixels[100] += 1e-3f;
  this->Environment->SetPixels(
    this->Environment->GetWidth(), this->Environment->GetHeight(), pixels);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  this->Costs = vtkSmartPointer<vtkRadianceCostModel>::New();
  EXPECT_TRUE(this->Plan()->GetFromCache()); // the same figures
  this->Costs->SetCost(vtkRadianceCostModel::SAMPLE, 1.0);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  EXPECT_EQ(this->GetFiles().size(), 5u);
  this->Environment->SetRotationY(40.0);
  EXPECT_TRUE(this->Plan()->GetFromCache());
}

TEST_F(PlanCache, DamagedFilesAreMadeAgain)
{
  const auto good = this->Plan();
  const fs::path file = this->GetFiles().at(0);
  const std::uintmax_t size = fs::file_size(file);
  for (int damage = 0; damage < 5; ++damage)
  {
    if (damage == 0) // a byte in the middle
    {
      std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
      stream.seekp(static_cast<std::streamoff>(size / 2));
      stream.put('\x5a');
      stream.put('\xa5');
    }
    else if (damage == 1)
    {
      fs::resize_file(file, size - 1);
    }
    else if (damage == 2)
    {
      fs::resize_file(file, 0);
    }
    else if (damage == 3)
    {
      std::ofstream(file, std::ios::binary) << "something else altogether";
    }
    else
    {
      fs::remove(file);
      fs::create_directory(file); // in the way for good
    }
    const auto again = this->Plan();
    EXPECT_FALSE(again->GetFromCache()) << damage;
    EXPECT_EQ(again->GetChoice(), good->GetChoice());
    EXPECT_EQ(Integrate(again), Integrate(good));
  }
}

TEST_F(PlanCache, StaysWithinItsBounds)
{
  const auto plan = this->Plan();
  const std::uintmax_t size = fs::file_size(this->GetFiles().at(0));
  this->MaximumBytes = static_cast<vtkIdType>(size + size / 2);
  for (int k = 0; k < 3; ++k)
  {
    this->BRDF->SetExponent(21.0 + k);
    this->Plan();
    std::uintmax_t total = 0;
    for (const fs::path& file : this->GetFiles())
    {
      total += fs::file_size(file);
    }
    EXPECT_LE(total, static_cast<std::uintmax_t>(this->MaximumBytes));
  }
  this->MaximumBytes = 100;
  this->BRDF->SetExponent(30.0);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  EXPECT_FALSE(this->Plan()->GetFromCache());
}

TEST_F(PlanCache, UnwritableFoldersAreNoCache)
{
  this->Folder = "/proc/no such place/for plans";
  EXPECT_FALSE(this->Plan()->GetFromCache());
  this->Folder = "";
  EXPECT_FALSE(this->Plan()->GetFromCache());
}

TEST_F(PlanCache, DefaultFolderFollowsTheEnvironment)
{
  setenv("MEASUREDBRDF_CACHE", "off", 1);
  EXPECT_EQ(vtkRadiancePlanner::GetDefaultCacheFolder(), "");
  setenv("MEASUREDBRDF_CACHE", "/some/where", 1);
  EXPECT_EQ(vtkRadiancePlanner::GetDefaultCacheFolder(), "/some/where");
  unsetenv("MEASUREDBRDF_CACHE");
  setenv("XDG_CACHE_HOME", "/x", 1);
  EXPECT_EQ(vtkRadiancePlanner::GetDefaultCacheFolder(), "/x/vtkMeasuredBRDF");
}
