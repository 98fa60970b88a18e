// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene.h"

#include "ParallelFor.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderer.h"

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
  this->Mapper->AddObserver(vtkCommand::ProgressEvent, this, &Scene::OnProgress);
}

//------------------------------------------------------------------------------
Scene::~Scene() = default;

//------------------------------------------------------------------------------
// VTK's mappers raise it at the end of each frame, too, with 1.
void Scene::OnProgress(vtkObject*, unsigned long, void* share)
{
  const double done = share ? *static_cast<double*>(share) : 1.0;
  if (done >= 1.0)
  {
    this->Bar.reset();
    return;
  }
  if (!this->Bar)
  {
    this->Bar = std::make_unique<ProgressBar>("planning");
  }
  this->Bar->Update(done);
  if (Interruptible::IsInterrupted())
  {
    this->Mapper->SetAbortPlanning(true);
  }
}

//------------------------------------------------------------------------------
void Scene::SetMaterial(vtkBRDF* brdf) { this->Mapper->SetBRDF(brdf); }

//------------------------------------------------------------------------------
void Scene::SetLight(vtkEnvironment* environment, vtkRadianceIntegrator* integrator)
{
  this->Integrator = integrator;
  this->Mapper->SetEnvironment(environment);
  this->Mapper->SetIntegrator(integrator);
}

//------------------------------------------------------------------------------
void Scene::SetLight(vtkEnvironment* environment, const LightSetOptions& lights)
{
  vtkNew<vtkLightSetRadianceIntegrator> loop;
  loop->SetLightSet(MakeLightSet(environment, lights));
  loop->SetSoftLights(lights.Soft);
  this->SetLight(environment, loop);
}

//------------------------------------------------------------------------------
void Scene::SetLightSet(vtkLightSet* lights)
{
  vtkNew<vtkLightSetRadianceIntegrator> loop;
  loop->SetLightSet(lights);
  this->Mapper->SetIntegrator(lights ? loop : this->Integrator.Get());
}

//------------------------------------------------------------------------------
void Scene::ModelOcclusion(vtkMeasuredBRDFMapper::OcclusionModeType mode, bool bounce)
{
  this->Mapper->SetOcclusionMode(mode);
  this->Mapper->SetOcclusionBounce(bounce);
}

//------------------------------------------------------------------------------
void Scene::SetPlan(const PlanOptions& options)
{
  this->Mapper->SetErrorTolerance(options.Tolerance);
  this->Mapper->SetMaximumCost(options.MaximumCost);
  this->Mapper->SetPlanForView(options.ForView);
}

//------------------------------------------------------------------------------
void Scene::Begin(Method& method, vtkEnvironment* environment, const PlanOptions& options)
{
  if (!method.Integrator)
  {
    this->SetPlan(options);
  }
  this->SetMaterial(method.BRDF);
  this->SetLight(environment, method.Integrator);
  this->TimeFrame();
  if (method.Integrator)
  {
    return;
  }
  method.Integrator = this->Mapper->GetCurrentIntegrator();
  method.Planner = this->Mapper->GetCurrentPlanner();
  if (!method.Planner)
  {
    throw Error("planning: " + TakeErrorText());
  }
}

//------------------------------------------------------------------------------
void Scene::Look(int width, int height, VisiblePairs& seen)
{
  this->Open(width, height);
  this->PlaceCamera(width, height);
  this->Mapper->GetVisiblePairs(this->Renderer, this->Actor, seen.Normals, seen.Views);
}

//------------------------------------------------------------------------------
std::string Scene::GetPlan() { return this->Mapper->GetPlan(); }

//------------------------------------------------------------------------------
void Scene::HoldPlan(const Method& method, vtkEnvironment* environment)
{
  if (this->Mapper->GetOcclusionMode() == vtkMeasuredBRDFMapper::OCCLUSION_AUTO &&
      this->GetPlan().find(", modeled") != std::string::npos)
  {
    this->Mapper->SetOcclusionModeToOn(); // which a method that is not planned does not find
  }
  this->SetLight(environment, method.Integrator);
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
  measuredbrdf::ParallelFor(0, picture.Height,
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
