// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene.h"

#include "vtkMeasuredBRDFMapper.h"
#include "vtkRadianceIntegrator.h"
#include "vtkSMPTools.h"

#include <algorithm>

namespace tool
{
//------------------------------------------------------------------------------
Scene::Scene()
  : Scene(vtkSmartPointer<vtkMeasuredBRDFMapper>::New())
{
}

//------------------------------------------------------------------------------
Scene::Scene(vtkMeasuredBRDFMapper* mapper)
  : OffscreenScene(mapper)
  , Mapper(mapper)
{
}

//------------------------------------------------------------------------------
Scene::~Scene() = default;

//------------------------------------------------------------------------------
void Scene::SetMaterial(vtkBRDF* brdf) { this->Mapper->SetBRDF(brdf); }

//------------------------------------------------------------------------------
void Scene::SetLight(vtkEnvironment* environment, const LightSetOptions& lights)
{
  this->Mapper->SetEnvironment(environment);
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetMethodToLightSet();
  this->Mapper->SetNumberOfLights(lights.Count);
  if (lights.IsMedianCut())
  {
    this->Mapper->SetLightSetMethodToMedianCut();
  }
  else if (lights.IsImportance())
  {
    this->Mapper->SetLightSetMethodToImportanceSampling();
  }
  else
  {
    this->Mapper->SetLightSetMethodToVariance();
  }
  // The mapper has no published variance minimization of its own.
  this->Mapper->SetLightSet(
    lights.Method == "minimum-variance" ? MakeLightSet(environment, lights) : nullptr);
  this->Mapper->SetSeed(lights.Seed);
  this->Mapper->SetSoftLights(lights.Soft);
}

//------------------------------------------------------------------------------
void Scene::SetLightSet(vtkLightSet* lights) { this->Mapper->SetLightSet(lights); }

//------------------------------------------------------------------------------
void Scene::SetLight(vtkEnvironment* environment, vtkRadianceIntegrator* integrator)
{
  this->Mapper->SetEnvironment(environment);
  this->Mapper->SetIntegrator(integrator);
}

//------------------------------------------------------------------------------
std::size_t Scene::GetTextureBytes()
{
  return static_cast<std::size_t>(this->Mapper->GetTextureBytes());
}

//------------------------------------------------------------------------------
void ComposeOver(
  Picture& picture, const OffscreenScene& scene, const Backdrop& backdrop, double exposure)
{
  vtkSMPTools::For(0, picture.Height,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int y = static_cast<int>(begin); y < end; ++y)
      {
        for (int x = 0; x < picture.Width; ++x)
        {
          float* pixel = picture.At(x, y);
          const double alpha = std::clamp<double>(pixel[3], 0.0, 1.0);
          RGB behind{};
          if (alpha < 1.0)
          {
            behind = backdrop.Look(scene.GetRay(x + 0.5, y + 0.5, picture.Width, picture.Height));
          }
          for (int c = 0; c < 3; ++c)
          {
            pixel[c] =
              static_cast<float>(exposure * (alpha * pixel[c] + (1.0 - alpha) * behind[c]));
          }
          pixel[3] = 1.0f;
        }
      }
    });
}
} // namespace tool
