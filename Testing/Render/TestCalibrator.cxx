// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a renderer's methods cost: measured once, kept, measured again where the file is damaged.

#include "RenderFixture.h"

#include "vtkCallbackCommand.h"
#include "vtkRadianceCostCalibrator.h"
#include "vtkRadianceCostModel.h"
#include "vtkRadiancePlanner.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace
{
class Calibrator : public RenderFixture
{
protected:
  void SetUp() override
  {
    RenderFixture::SetUp();
    std::random_device random;
    this->Folder =
      (fs::temp_directory_path() / ("measuredbrdf-costs-" + std::to_string(random()))).string();
  }
  void TearDown() override { fs::remove_all(this->Folder); }

  vtkSmartPointer<vtkRadianceCostCalibrator> New()
  {
    auto calibrator = vtkSmartPointer<vtkRadianceCostCalibrator>::New();
    calibrator->SetCacheFolder(this->Folder);
    return calibrator;
  }

  std::vector<fs::path> GetFiles() const
  {
    std::vector<fs::path> files;
    const fs::path own = fs::path(this->Folder) / "vtkMeasuredBRDF-plans";
    if (fs::exists(own))
    {
      for (const auto& entry : fs::directory_iterator(own))
      {
        files.push_back(entry.path());
      }
    }
    return files;
  }

  std::string Folder;
};
}

TEST_F(Calibrator, MeasuresAndKeeps)
{
  const auto first = this->New();
  int events = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&events);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  first->AddObserver(vtkCommand::ProgressEvent, counter);
  ASSERT_TRUE(first->Calibrate());
  EXPECT_FALSE(first->GetFromCache());
  EXPECT_EQ(events, 6);
  vtkRadianceCostModel* model = first->GetCostModel();
  std::printf("%s", model->GetText().c_str());
  EXPECT_NE(model->GetName(), vtkNew<vtkRadianceCostModel>()->GetName());
  EXPECT_EQ(model->GetNumberOfCosts(), 6);
  for (int k = 0; k < model->GetNumberOfCosts(); ++k)
  {
    EXPECT_GT(model->GetCost(model->GetCostName(k)), 0.0) << model->GetCostName(k);
  }
  // Whatever the renderer: 4096 lights are not cheaper than a table.
  EXPECT_GT(4096.0 * model->GetCost("light"), model->GetCost("table"));
  // Mesa's llvmpipe interpolates in floats; graphics cards have 8 bits, or a few more.
  const bool isSoftware = model->GetName().find("llvmpipe") != std::string::npos;
  EXPECT_TRUE(isSoftware ? model->GetFilterWeightBits() == 0 : model->GetFilterWeightBits() != 1)
    << model->GetFilterWeightBits();
  ASSERT_EQ(this->GetFiles().size(), 1u);

  const auto second = this->New();
  second->SetRenderWindow(this->Window); // the same renderer
  ASSERT_TRUE(second->Calibrate());
  EXPECT_TRUE(second->GetFromCache());
  EXPECT_EQ(second->GetCostModel()->GetText(), model->GetText());

  // A damaged file is replaced; one that is not the cache's own would stay (TestPlanCache).
  std::ofstream(this->GetFiles().at(0), std::ios::binary)
    << "vtkMeasuredBRDF plan 1\nsomething else";
  const auto third = this->New();
  ASSERT_TRUE(third->Calibrate());
  EXPECT_FALSE(third->GetFromCache());
  EXPECT_EQ(this->GetFiles().size(), 1u);
  EXPECT_TRUE(third->Calibrate());
  EXPECT_TRUE(third->GetFromCache());
}

TEST_F(Calibrator, InAGivenWindowThatGoesOn)
{
  const FloatImage before = this->RenderEncoded();
  const auto calibrator = this->New();
  calibrator->SetCacheFolder("");
  calibrator->SetRenderWindow(this->Window);
  ASSERT_TRUE(calibrator->Calibrate());
  EXPECT_FALSE(calibrator->GetFromCache());
  EXPECT_TRUE(this->GetFiles().empty());
  EXPECT_EQ(this->RenderEncoded().RGBA, before.RGBA);
  EXPECT_EQ(this->Window->GetSize()[0], 64);
}

TEST_F(Calibrator, AbortsAndRefusesNothingHalf)
{
  const auto calibrator = this->New();
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* self, unsigned long, void*, void*)
    { static_cast<vtkRadianceCostCalibrator*>(self)->SetAbort(true); });
  calibrator->AddObserver(vtkCommand::ProgressEvent, stop);
  std::string text;
  vtkNew<vtkCallbackCommand> errors;
  errors->SetClientData(&text);
  errors->SetCallback([](vtkObject*, unsigned long, void* all, void* message)
    { *static_cast<std::string*>(all) += static_cast<const char*>(message); });
  calibrator->AddObserver(vtkCommand::ErrorEvent, errors);
  EXPECT_FALSE(calibrator->Calibrate());
  EXPECT_NE(text.find("aborted"), std::string::npos) << text;
  EXPECT_EQ(calibrator->GetCostModel()->GetText(), vtkNew<vtkRadianceCostModel>()->GetText());
  EXPECT_TRUE(this->GetFiles().empty());
}

TEST_F(Calibrator, FollowsTheCachesSwitch)
{
  // The fixture has switched it off.
  EXPECT_EQ(vtkNew<vtkRadianceCostCalibrator>()->GetCacheFolder(), "");
}
