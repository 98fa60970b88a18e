// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Side.h"

#include "DirectionalLight.h"
#include "Display.h"
#include "Scenes.h"
#include "Tool.h"

#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkCullerCollection.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkProperty.h"
#include "vtkRadiancePlanner.h"
#include "vtkTexture.h"

#include <algorithm>

namespace explorer
{
namespace
{
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
}

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
bool Side::IsReady() const
{
  if (this->IsReference())
  {
    return this->IsLit; // the exact picture may lie over it already
  }
  return this->IsLit && this->IsMade &&
         (this->Drawn != Kind::Planned || (this->GetPlanner() && !this->Mapper->GetPlanPending()));
}

//------------------------------------------------------------------------------
// From inside of a render.
void Side::OnPlan()
{
  const std::string plan = this->Drawn == Kind::Planned ? this->Mapper->GetPlan() : std::string();
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
  return this->Drawn == Kind::Planned ? this->Mapper->GetCurrentPlanner() : nullptr;
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
  tool::Method material;
  material.BRDF = this->Model->GetMaterial().BRDF;
  if (key == method::PBR)
  {
    this->StartFit();
  }
  else if (this->Model->IsDirectional()) // there is no environment to be integrated
  {
    this->Draw(Kind::Direct, nullptr, material);
  }
  else if (key == method::Planned || key == method::Reference)
  {
    this->Mapper->SetErrorTolerance(this->Model->GetState().Tolerance);
    this->Draw(Kind::Planned, this->Model->GetEnvironment(), material);
  }
  else
  {
    this->StartMethod(key);
  }
  emit this->changed();
}

//------------------------------------------------------------------------------
void Side::Draw(Kind kind, vtkEnvironment* light, const tool::Method& method)
{
  this->Drawn = kind;
  this->IsLit = true;
  this->IsMade = true;
  this->Light = light;
  if (kind != Kind::Stock)
  {
    this->Made = method;
    this->Mapper->SetBRDF(method.BRDF);
    this->Mapper->SetEnvironment(light);
    this->Mapper->SetIntegrator(method.Integrator);
  }
  this->UpdateVisibility();
}

//------------------------------------------------------------------------------
// What was drawn before stays.
void Side::FailToMake(const QString& text)
{
  this->IsMade = true;
  this->Model->Say(text, true);
  emit this->changed();
}

//------------------------------------------------------------------------------
void Side::StartMethod(const std::string& key)
{
  tool::MethodOptions options;
  const bool soft = key == method::SoftLights;
  options.Method = soft ? method::LightSet : key;
  options.Lights.Count = this->Model->GetState().Lights;
  options.Lights.Soft = soft;
  const auto environment =
    vtkSmartPointer<vtkEnvironment>::Take(this->Model->GetEnvironment()->NewSnapshot());
  this->IsMade = false;
  this->Background->Compute(
    this->GetJobKey(), tr("preparing %1").arg(QString::fromStdString(GetMethodName(key))),
    [options, material = MakeSnapshot(this->Model->GetMaterial()), environment]()
    { return tool::MakeMethod(options, material, environment); },
    [this, environment](const tool::Method& made)
    {
      environment->SetRotationY(this->Model->GetState().Rotation);
      this->Draw(Kind::Made, environment, made);
      emit this->changed();
    },
    [this](const QString& text) { this->FailToMake(text); });
}

//------------------------------------------------------------------------------
void Side::StartFit()
{
  this->IsMade = false;
  this->Background->Compute(
    this->GetJobKey(), tr("fitting VTK's shading"),
    [material = MakeSnapshot(this->Model->GetMaterial())]()
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
      return std::pair(fitted, fitter->GetRelativeError());
    },
    [this](const std::pair<vtkSmartPointer<vtkProperty>, double>& fit)
    { this->DrawFitted(fit.first, fit.second); },
    [this](const QString& text) { this->FailToMake(text); });
}

//------------------------------------------------------------------------------
void Side::DrawFitted(vtkProperty* fitted, double error)
{
  this->FitError = error;
  this->StockActor->GetProperty()->DeepCopy(fitted);
  this->StockUnit = 1.0;
  if (!this->Model->IsDirectional())
  {
    const tool::StockLight light(this->Model->GetEnvironment());
    this->StockUnit = light.Unit;
    this->StockLight->SetInputData(light.Image);
  }
  this->SetExposure(this->Exposure);
  this->Draw(Kind::Stock, this->Model->GetEnvironment(), {});
  emit this->changed();
}

//------------------------------------------------------------------------------
void Side::UpdateLight()
{
  PlaceLight(this->Lamp, this->Model->GetState().Light);
  if (this->IsLit && !this->Light)
  {
    emit this->changed();
  }
}

//------------------------------------------------------------------------------
void Side::UpdateTolerance()
{
  this->Mapper->SetErrorTolerance(this->Model->GetState().Tolerance);
  if (this->Drawn == Kind::Planned)
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
  double* axes = this->Drawn == Kind::Stock ? rows : identity;
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
  const bool isStock = this->Drawn == Kind::Stock;
  this->Actor->SetVisibility(shown && !isStock && this->Mapper->GetBRDF());
  this->StockActor->SetVisibility(shown && isStock);
  const bool isUnderImage = isStock && this->Light;
  this->Renderer->SetEnvironmentTexture(isUnderImage ? this->StockLight.Get() : nullptr);
  this->Renderer->SetUseImageBasedLighting(isUnderImage);
  this->Lamp->SetSwitch(this->IsLit && !this->Light);
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
  const QString name = QString::fromStdString(GetMethodName(this->GetKey()));
  if (!this->IsMade)
  {
    return tr("%1: being prepared").arg(name);
  }
  if (this->IsDirect())
  {
    return this->IsReference() ? tr("%1: f E cos(theta)").arg(name)
                               : tr("Material under one light (no plan, no light set)");
  }
  if (this->Drawn == Kind::Stock)
  {
    return tr("%1: fitted within %2 %").arg(name).arg(100.0 * this->FitError, 0, 'g', 2);
  }
  if (this->Drawn == Kind::Made)
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
// To be measured against the exact picture, and so without what the mesh hides.
// Scenes of their own: radiance above 1 and alpha, which a widget's window does not keep. A planned
// method finds the mapper's plan, which mappers of one material and environment share.
tool::Picture Side::Capture(vtkCamera* camera, const tool::Size& size, double& frame)
{
  const bool isMapped = this->Drawn == Kind::Planned || this->Drawn == Kind::Made;
  const Kind kind = isMapped ? Kind::Made : this->Drawn;
  if (!this->Scene || this->SceneKind != kind)
  {
    this->SceneKind = kind;
    this->Scene.reset(); // one window at a time
    this->Scene.reset(kind == Kind::Stock ? static_cast<tool::OffscreenScene*>(new FittedScene())
                      : kind == Kind::Direct
                        ? new LampScene(this->Lamp)
                        : static_cast<tool::OffscreenScene*>(new tool::Scene()));
    this->Scene->SetMesh(this->Model->GetMesh());
  }
  if (kind == Kind::Stock)
  {
    auto* stock = static_cast<FittedScene*>(this->Scene.get());
    stock->SetProperty(this->StockActor->GetProperty());
    this->Light ? stock->SetEnvironment(this->Light) : stock->SetLamp(this->Lamp);
  }
  else if (kind == Kind::Direct)
  {
    static_cast<LampScene*>(this->Scene.get())->SetMaterial(this->Mapper->GetBRDF());
  }
  else
  {
    auto* scene = static_cast<tool::Scene*>(this->Scene.get());
    if (this->Drawn == Kind::Planned)
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
