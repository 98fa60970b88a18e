// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Side.h"

#include "DirectionalLight.h"
#include "Display.h"
#include "Scenes.h"
#include "SideScenes.h"
#include "Tool.h"

#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkCullerCollection.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkProperty.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

#include <algorithm>
#include <utility>

namespace
{
//------------------------------------------------------------------------------
// A copy for another thread; the material itself where its class has none.
tool::Material MakeSnapshot(const tool::Material& material)
{
  tool::Material snapshot = material;
  if (auto copy = vtkSmartPointer<vtkBRDF>::Take(material.BRDF->NewSnapshot()))
  {
    snapshot.BRDF = copy;
  }
  return snapshot;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
Side::Side(int index, Session* session, Jobs* jobs, QObject* parent)
  : QObject(parent)
  , Index(index)
  , Model(session)
  , Background(jobs)
{
  this->Mapper->ScalarVisibilityOff();
  this->Mapper->SetPlanningModeToBackgroundFromStart();
  this->Actor->SetMapper(this->Mapper);
  this->StockMapper->ScalarVisibilityOff();
  this->StockActor->SetMapper(this->StockMapper);
  this->StockActor->GetProperty()->SetInterpolationToPBR();
  this->StockLight->SetColorModeToDirectScalars();
  this->StockLight->MipmapOn();
  this->StockLight->InterpolateOn();
  for (vtkActor* actor : { this->Actor.Get(), this->StockActor.Get() })
  {
    ShowRadiance(actor);
    this->Renderer->AddActor(actor);
  }
  this->Renderer->GetCullers()->RemoveAllItems(); // what is not drawn is not planned for
  this->Renderer->AutomaticLightCreationOff();
  this->Renderer->AddLight(this->Lamp);
  this->Lamp->SwitchOff();
  this->UpdateVisibility();
  this->Mapper->AddObserver(vtkCommand::UpdateDataEvent, this, &Side::OnPlan);
  connect(session, &Session::materialChanged, this, &Side::UpdateMethod);
  connect(session, &Session::environmentChanged, this, &Side::UpdateMethod);
  connect(session, &Session::methodsChanged, this, &Side::UpdateMethod);
  connect(session, &Session::toleranceChanged, this, &Side::UpdateTolerance);
  connect(session, &Session::rotationChanged, this, &Side::UpdateRotation);
  connect(session, &Session::lightChanged, this, &Side::UpdateLight);
  connect(session, &Session::meshChanged, this, &Side::UpdateMesh);
}

//------------------------------------------------------------------------------
Side::~Side() = default;

//------------------------------------------------------------------------------
const std::string& Side::GetKey() const
{
  return this->Model->GetState().Methods[static_cast<std::size_t>(this->Index)];
}

//------------------------------------------------------------------------------
bool Side::IsReference() const { return this->GetKey() == method::Reference; }

//------------------------------------------------------------------------------
QString Side::GetJobKey() const { return QString("method %1").arg(this->Index); }

//------------------------------------------------------------------------------
bool Side::IsReady() const
{
  if (this->IsReference())
  {
    return this->Light || this->IsDirectlyLit; // the exact picture may lie over it already
  }
  return (this->Light || this->IsDirectlyLit) && this->IsMade &&
         (!this->IsPlanned || (this->GetPlanner() && !this->Mapper->GetPlanPending()));
}

//------------------------------------------------------------------------------
bool Side::PollPlan() { return this->IsPlanned && this->Mapper->GetPlanReady(); }

//------------------------------------------------------------------------------
// From inside of a render.
void Side::OnPlan()
{
  const std::string plan = this->IsPlanned ? this->Mapper->GetPlan() : std::string();
  if (plan != this->Plan)
  {
    this->Plan = plan;
    QMetaObject::invokeMethod(
      this, [this]() { emit this->changed(); }, Qt::QueuedConnection);
  }
}

//------------------------------------------------------------------------------
vtkRadiancePlanner* Side::GetPlanner() const
{
  return this->IsPlanned ? this->Mapper->GetCurrentPlanner() : nullptr;
}

//------------------------------------------------------------------------------
void Side::UpdateMethod()
{
  if (!this->Model->GetMaterial().BRDF || !this->Model->IsLit())
  {
    return;
  }
  this->Background->Stop(this->GetJobKey());
  this->IsMade = true;
  // What the mesh hides, as every mapper draws it; but not beside the exact picture, which is
  // without.
  const auto& methods = this->Model->GetState().Methods;
  const bool isCompared =
    std::find(methods.begin(), methods.end(), method::Reference) != methods.end();
  this->Mapper->SetOcclusionMode(
    isCompared ? vtkMeasuredBRDFMapper::OCCLUSION_OFF : vtkMeasuredBRDFMapper::OCCLUSION_AUTO);
  const std::string& key = this->GetKey();
  if (key == method::PBR)
  {
    this->StartFit();
  }
  else if (this->Model->IsDirectional())
  {
    this->DrawDirect();
  }
  else if (key == method::Planned || key == method::Reference)
  {
    this->DrawPlanned();
  }
  else
  {
    this->StartMethod(key);
  }
  emit this->changed();
}

//------------------------------------------------------------------------------
void Side::DrawPlanned()
{
  this->Made = tool::Method();
  this->Light = this->Model->GetEnvironment();
  this->Mapper->SetBRDF(this->Model->GetMaterial().BRDF);
  this->Mapper->SetEnvironment(this->Light);
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetErrorTolerance(this->Model->GetState().Tolerance);
  this->IsPlanned = true;
  this->IsDirectlyLit = false;
  this->IsStock = false;
  this->UpdateVisibility();
}

//------------------------------------------------------------------------------
// Whatever the method: there is no environment to be integrated.
void Side::DrawDirect()
{
  this->Made = tool::Method();
  this->Light = nullptr;
  this->Mapper->SetBRDF(this->Model->GetMaterial().BRDF);
  this->Mapper->SetEnvironment(nullptr);
  this->Mapper->SetIntegrator(nullptr);
  this->IsPlanned = false;
  this->IsDirectlyLit = true;
  this->IsStock = false;
  this->UpdateVisibility();
}

//------------------------------------------------------------------------------
void Side::StartMethod(const std::string& key)
{
  tool::MethodOptions options;
  const bool soft = key == method::SoftLights;
  options.Method = soft ? method::LightSet : key;
  options.Lights.Count = this->Model->GetState().Lights;
  options.Lights.Soft = soft;
  const tool::Material material = MakeSnapshot(this->Model->GetMaterial());
  const auto environment =
    vtkSmartPointer<vtkEnvironment>::Take(this->Model->GetEnvironment()->NewSnapshot());
  this->IsMade = false;
  this->Background->Start(
    this->GetJobKey(), tr("preparing %1").arg(QString::fromStdString(explorer::GetMethodName(key))),
    [this, options, material, environment](JobThread& thread)
    {
      const tool::Method made = tool::MakeMethod(options, material, environment);
      thread.Post([this, made, environment]() { this->DrawMade(made, environment); });
    },
    [this](const QString& text)
    {
      this->IsMade = true;
      this->Model->Say(text, true);
      emit this->changed();
    });
}

//------------------------------------------------------------------------------
void Side::DrawMade(const tool::Method& made, vtkEnvironment* environment)
{
  this->Made = made;
  this->Light = environment;
  this->Light->SetRotationY(this->Model->GetState().Rotation);
  this->Mapper->SetBRDF(made.BRDF);
  this->Mapper->SetEnvironment(this->Light);
  this->Mapper->SetIntegrator(made.Integrator);
  this->IsMade = true;
  this->IsPlanned = false;
  this->IsDirectlyLit = false;
  this->IsStock = false;
  this->UpdateVisibility();
  emit this->changed();
}

//------------------------------------------------------------------------------
void Side::StartFit()
{
  const tool::Material material = MakeSnapshot(this->Model->GetMaterial());
  this->IsMade = false;
  this->Background->Start(
    this->GetJobKey(), tr("fitting VTK's shading"),
    [this, material](JobThread& thread)
    {
      auto fitted = vtkSmartPointer<vtkProperty>::New();
      vtkNew<vtkPBRPropertyFitter> fitter;
      fitter->SetBRDF(material.BRDF);
      fitter->UsualValuesOff(); // how close VTK's shading comes
      if (!fitter->Update())
      {
        throw tool::Error("fitting VTK's shading: " + tool::TakeErrorText());
      }
      fitter->Apply(fitted);
      const double error = fitter->GetRelativeError();
      thread.Post([this, fitted, error]() { this->DrawFitted(fitted, error); });
    },
    [this](const QString& text)
    {
      this->IsMade = true;
      this->Model->Say(text, true);
      emit this->changed();
    });
}

//------------------------------------------------------------------------------
void Side::DrawFitted(vtkProperty* fitted, double error)
{
  this->FitError = error;
  this->StockActor->GetProperty()->DeepCopy(fitted);
  this->IsDirectlyLit = this->Model->IsDirectional();
  this->StockUnit = 1.0;
  if (!this->IsDirectlyLit)
  {
    const tool::StockLight light(this->Model->GetEnvironment());
    this->StockUnit = light.Unit;
    this->StockLight->SetInputData(light.Image);
  }
  this->SetExposure(this->Exposure);
  this->Light = this->Model->GetEnvironment();
  this->IsMade = true;
  this->IsPlanned = false;
  this->IsStock = true;
  this->UpdateVisibility();
  emit this->changed();
}

//------------------------------------------------------------------------------
void Side::UpdateLight()
{
  PlaceLight(this->Lamp, this->Model->GetState().Light);
  if (this->IsDirectlyLit)
  {
    emit this->changed();
  }
}

//------------------------------------------------------------------------------
void Side::UpdateTolerance()
{
  this->Mapper->SetErrorTolerance(this->Model->GetState().Tolerance);
  if (this->IsPlanned)
  {
    emit this->changed();
  }
}

//------------------------------------------------------------------------------
void Side::UpdateRotation()
{
  if (!this->Light)
  {
    return;
  }
  this->Light->SetRotationY(this->Model->GetState().Rotation);
  double rows[9]; // of a rotation from the world: where the environment's axes point
  this->Light->GetWorldToEnvironment(rows);
  double identity[6] = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0 }; // the mapper's light turns by itself
  double* axes = this->IsStock ? rows : identity;
  this->Renderer->SetEnvironmentRight(axes);
  this->Renderer->SetEnvironmentUp(axes + 3);
}

//------------------------------------------------------------------------------
void Side::UpdateMesh()
{
  this->Mapper->SetInputData(this->Model->GetMesh());
  this->StockMapper->SetInputData(this->Model->GetMesh());
  this->UpdateVisibility();
  if (this->Scene)
  {
    this->Scene->SetMesh(this->Model->GetMesh());
  }
  emit this->changed();
}

//------------------------------------------------------------------------------
void Side::UpdateVisibility()
{
  const bool shown = this->IsVisible && this->Mapper->GetInput();
  this->Actor->SetVisibility(shown && !this->IsStock && this->Mapper->GetBRDF());
  this->StockActor->SetVisibility(shown && this->IsStock);
  const bool isUnderImage = this->IsStock && !this->IsDirectlyLit;
  this->Renderer->SetEnvironmentTexture(isUnderImage ? this->StockLight.Get() : nullptr);
  this->Renderer->SetUseImageBasedLighting(isUnderImage);
  this->Lamp->SetSwitch(this->IsDirectlyLit);
  PlaceLight(this->Lamp, this->Model->GetState().Light);
  this->UpdateRotation();
}

//------------------------------------------------------------------------------
void Side::SetVisible(bool visible)
{
  this->IsVisible = visible;
  this->UpdateVisibility();
}

//------------------------------------------------------------------------------
void Side::SetExposure(double factor)
{
  this->Exposure = factor;
  explorer::SetExposure(this->Actor, factor);
  explorer::SetExposure(this->StockActor, factor * this->StockUnit);
}

//------------------------------------------------------------------------------
QString Side::Describe() const
{
  const QString name = QString::fromStdString(explorer::GetMethodName(this->GetKey()));
  if (!this->IsMade)
  {
    return tr("%1: being prepared").arg(name);
  }
  if (this->IsDirect())
  {
    return this->IsReference() ? tr("%1: f E cos(theta)").arg(name)
                               : tr("Material under one light (no plan, no light set)");
  }
  if (this->IsStock)
  {
    return tr("%1: fitted within %2 %").arg(name).arg(100.0 * this->FitError, 0, 'g', 2);
  }
  if (!this->IsPlanned)
  {
    const int lights = this->Made.GetNumberOfLights();
    const QString kind = QString::fromStdString(this->Made.Thesis.Kind);
    return name + (kind.isEmpty() ? QString() : ": " + kind) +
           (lights > 0 ? tr(", %1 lights").arg(lights) : QString());
  }
  vtkRadiancePlanner* planner = this->GetPlanner();
  const int choice = planner ? planner->GetChoice() : -1;
  // Samples that add up are pending, too.
  if (choice < 0 ||
      (this->Mapper->GetPlanPending() && planner->GetMethodName(choice) != "filtered"))
  {
    return tr("%1: planning").arg(name);
  }
  return this->IsReference() ? tr("%1; no self-shadowing on either side").arg(name)
                             : name + ": " +
                                 QString::fromStdString(planner->GetMethodName(choice) + ", " +
                                                        planner->GetDescription(choice));
}

//------------------------------------------------------------------------------
void Side::OpenScene()
{
  if (this->Scene && this->SceneIsStock == this->IsStock && this->SceneIsDirect == this->IsDirect())
  {
    return;
  }
  this->SceneIsStock = this->IsStock;
  this->SceneIsDirect = this->IsDirect();
  this->Scene.reset(); // one window at a time
  this->Scene.reset(this->IsStock      ? static_cast<tool::OffscreenScene*>(new FittedScene())
                    : this->IsDirect() ? new LampScene(this->Lamp)
                                       : static_cast<tool::OffscreenScene*>(new tool::Scene()));
  this->Scene->SetMesh(this->Model->GetMesh());
}

//------------------------------------------------------------------------------
// To be measured against the exact picture, and so without what the mesh hides.
// Scenes of their own: radiance above 1 and alpha, which a widget's window does not keep. A planned
// method finds the mapper's plan, which mappers of one material and environment share.
tool::Picture Side::Capture(vtkCamera* camera, const tool::Size& size, double& frame)
{
  this->OpenScene();
  if (this->IsStock)
  {
    auto* stock = static_cast<FittedScene*>(this->Scene.get());
    stock->SetProperty(this->StockActor->GetProperty());
    this->IsDirectlyLit ? stock->SetLamp(this->Lamp) : stock->SetEnvironment(this->Light);
  }
  else if (this->IsDirect())
  {
    static_cast<LampScene*>(this->Scene.get())->SetMaterial(this->Mapper->GetBRDF());
  }
  else
  {
    auto* scene = static_cast<tool::Scene*>(this->Scene.get());
    if (this->IsPlanned)
    {
      tool::PlanOptions options;
      options.Tolerance = this->Model->GetState().Tolerance;
      scene->SetPlan(options);
    }
    scene->ModelOcclusion(vtkMeasuredBRDFMapper::OCCLUSION_OFF, false);
    scene->SetMaterial(this->Mapper->GetBRDF());
    scene->SetLight(this->Light, this->Mapper->GetIntegrator());
  }
  this->Scene->SetCamera(camera);
  tool::Picture picture = this->Scene->Render(size.Width, size.Height);
  frame = this->Scene->TimeFrame();
  return picture;
}
} // namespace explorer
