// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a renderer's methods cost.

#include "RenderFixture.h"

#include "vtkCallbackCommand.h"
#include "vtkRadianceCostCalibrator.h"
#include "vtkRadianceCostModel.h"

#include <cstdio>
#include <string>

namespace
{
class Calibrator : public RenderFixture
{
};
}

TEST_F(Calibrator, MeasuresEveryCost)
{
  const auto first = vtkSmartPointer<vtkRadianceCostCalibrator>::New();
  int events = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&events);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  first->AddObserver(vtkCommand::ProgressEvent, counter);
  ASSERT_TRUE(first->Calibrate());
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
}

TEST_F(Calibrator, InAGivenWindowThatGoesOn)
{
  const FloatImage before = this->RenderEncoded();
  const auto calibrator = vtkSmartPointer<vtkRadianceCostCalibrator>::New();
  calibrator->SetRenderWindow(this->Window);
  ASSERT_TRUE(calibrator->Calibrate());
  EXPECT_EQ(this->RenderEncoded().RGBA, before.RGBA);
  EXPECT_EQ(this->Window->GetSize()[0], 64);
}

TEST_F(Calibrator, AbortsAndRefusesNothingHalf)
{
  const auto calibrator = vtkSmartPointer<vtkRadianceCostCalibrator>::New();
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
}
