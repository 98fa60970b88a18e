// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a planner says of occlusion.
#include "vtkOcclusionPredictor.h"
#include "vtkRadiancePlanner.h"
#include "vtkTracedScene.h"

#include <string>

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::Update() { return this->Choose() && this->PredictOcclusion(); }

//------------------------------------------------------------------------------
void vtkRadiancePlanner::SetScene(vtkTracedScene* scene)
{
  if (!scene)
  {
    this->Occlusion = nullptr;
    return;
  }
  if (!this->Occlusion)
  {
    this->Occlusion = vtkSmartPointer<vtkOcclusionPredictor>::New();
  }
  this->Occlusion->SetScene(scene);
}

//------------------------------------------------------------------------------
vtkTracedScene* vtkRadiancePlanner::GetScene()
{
  return this->Occlusion ? this->Occlusion->GetScene() : nullptr;
}

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::PredictOcclusion()
{
  if (!this->Occlusion)
  {
    return true;
  }
  this->Occlusion->SetBRDF(this->GetBRDF());
  this->Occlusion->SetEnvironment(this->GetEnvironment());
  this->Occlusion->SetViewDirection(this->ViewDirection);
  if (!this->Occlusion->Update())
  {
    vtkErrorMacro("Update: the error of leaving occlusion out can't be predicted.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
double vtkRadiancePlanner::GetUnoccludedError()
{
  return this->Occlusion ? this->Occlusion->GetError() : 0.0;
}

//------------------------------------------------------------------------------
double vtkRadiancePlanner::GetUnoccludedErrorUncertainty()
{
  return this->Occlusion ? this->Occlusion->GetUncertainty() : 0.0;
}

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::GetNeedsOcclusion()
{
  return this->Occlusion && vtkOcclusionPredictor::IsWorthModeling(this->Occlusion->GetError(),
                              this->GetPredictedError(this->GetChoice()), this->ErrorTolerance);
}

//------------------------------------------------------------------------------
std::string vtkRadiancePlanner::DescribeOcclusion()
{
  return this->Occlusion ? "; " + this->Occlusion->GetText() : "";
}
