// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Scenes off screen of what a side draws beside tool::Scene: the fitted property, and a material
 * under the directional light.
 */

#ifndef SideScenes_h
#define SideScenes_h

#include "Scenes.h"

#include "vtkActor.h"
#include "vtkLight.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

namespace explorer
{
//------------------------------------------------------------------------------
/// VTK's own shading of a property, under an environment or a lamp.
class FittedScene : public tool::StockScene
{
public:
  void SetProperty(vtkProperty* property) { this->Actor->GetProperty()->DeepCopy(property); }

  void SetLamp(vtkLight* lamp)
  {
    this->Unit = 1.0;
    this->Renderer->UseImageBasedLightingOff();
    this->Renderer->SetEnvironmentTexture(nullptr);
    this->Renderer->RemoveAllLights();
    this->Renderer->AddLight(lamp);
  }

  void SetEnvironment(vtkEnvironment* environment)
  {
    this->Renderer->RemoveAllLights();
    this->SetLight(environment);
  }
};

//------------------------------------------------------------------------------
/// A material under a lamp, without an environment.
class LampScene : public tool::OffscreenScene
{
public:
  explicit LampScene(vtkLight* lamp)
    : LampScene(vtkSmartPointer<vtkMeasuredBRDFMapper>::New(), lamp)
  {
  }

  void SetMaterial(vtkBRDF* brdf) { this->Mapper->SetBRDF(brdf); }

private:
  LampScene(vtkMeasuredBRDFMapper* mapper, vtkLight* lamp)
    : OffscreenScene(mapper)
    , Mapper(mapper)
  {
    this->Renderer->AddLight(lamp);
  }

  vtkSmartPointer<vtkMeasuredBRDFMapper> Mapper;
};
} // namespace explorer

#endif
