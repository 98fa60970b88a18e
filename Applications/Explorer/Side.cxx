// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Side.h"

#include "Display.h"
#include "Scenes.h"
#include "Tool.h"

#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkCullerCollection.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPBRLUTTexture.h"
#include "vtkPBRPrefilterTexture.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkProperty.h"
#include "vtkRadiancePlanner.h"
#include "vtkTexture.h"

#include <algorithm>

namespace explorer
{
/// What a side shows, off screen: radiance above 1 and alpha, which a widget's window does not
/// keep.
class CaptureScene : public tool::OffscreenScene
{
public:
  explicit CaptureScene(vtkOpenGLPolyDataMapper* mapper)
    : OffscreenScene(mapper)
    , Stage(mapper)
  {
  }

  using OffscreenScene::Actor;
  using OffscreenScene::Renderer;
  using OffscreenScene::Unit;
  vtkOpenGLPolyDataMapper* Stage;
};

//------------------------------------------------------------------------------
static void SetUpLight(vtkTexture* texture, vtkImageData* image)
{
  texture->SetInputData(image);
  texture->SetColorModeToDirectScalars();
  texture->MipmapOn();
  texture->InterpolateOn();
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
  this->StockMapper->ScalarVisibilityOff();
  this->Fitted->SetInterpolationToPBR();
  this->Renderer->AddActor(this->Actor);
  this->Renderer->GetCullers()->RemoveAllItems(); // what is not drawn is not planned for
  this->Renderer->AutomaticLightCreationOff();
  this->Renderer->AddLight(this->Lamp);
  this->Update();
  this->Mapper->AddObserver(vtkCommand::UpdateDataEvent, this, &Side::OnPlan);
  for (const auto signal :
    { &Session::materialChanged, &Session::environmentChanged, &Session::methodsChanged })
  {
    connect(session, signal, this, &Side::UpdateMethod);
  }
  connect(session, &Session::rotationChanged, this, &Side::Update);
  connect(session, &Session::meshChanged, this, &Side::UpdateMesh);
  connect(session, &Session::toleranceChanged, this,
    [this]()
    {
      this->Mapper->SetErrorTolerance(this->Model->GetState().Tolerance);
      if (this->Drawn == Kind::Planned)
      {
        Q_EMIT this->changed();
      }
    });
  connect(session, &Session::lightChanged, this,
    [this]()
    {
      this->Update();
      if (this->IsLit && !this->Light)
      {
        Q_EMIT this->changed();
      }
    });
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
      this, [this]() { Q_EMIT this->changed(); }, Qt::QueuedConnection);
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
  Q_EMIT this->changed();
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
  this->Update();
}

//------------------------------------------------------------------------------
// What was drawn before stays until then, and where nothing can be made.
template <typename Make, typename Take>
void Side::Start(const QString& label, Make make, Take take)
{
  this->IsMade = false;
  this->Background->Compute(
    this->GetJobKey(), label, make,
    [this, take](const auto& made)
    {
      take(made);
      Q_EMIT this->changed();
    },
    [this](const QString& text)
    {
      this->IsMade = true;
      this->Model->Say(text, true);
      Q_EMIT this->changed();
    });
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
  this->Start(
    tr("preparing %1").arg(QString::fromStdString(GetMethodName(key))),
    [options, material = MakeSnapshot(this->Model->GetMaterial()), environment]()
    { return tool::MakeMethod(options, material, environment); },
    [this, environment](const tool::Method& made) { this->Draw(Kind::Made, environment, made); });
}

//------------------------------------------------------------------------------
void Side::StartFit()
{
  this->Start(
    tr("fitting VTK's shading"),
    [material = MakeSnapshot(this->Model->GetMaterial())]()
    {
      auto fitter = vtkSmartPointer<vtkPBRPropertyFitter>::New();
      fitter->SetBRDF(material.BRDF);
      fitter->UsualValuesOff(); // how close VTK's shading comes
      if (!fitter->Update())
      {
        throw tool::Error("fitting VTK's shading: " + tool::TakeErrorText());
      }
      return fitter;
    },
    [this](const vtkSmartPointer<vtkPBRPropertyFitter>& fitter)
    {
      this->FitError = fitter->GetRelativeError();
      fitter->Apply(this->Fitted);
      this->StockUnit = 1.0;
      if (!this->Model->IsDirectional())
      {
        const tool::StockLight light(this->Model->GetEnvironment());
        this->StockUnit = light.Unit;
        SetUpLight(this->StockLight, light.Image);
      }
      this->Draw(Kind::Stock, this->Model->GetEnvironment(), {});
    });
}

//------------------------------------------------------------------------------
void Side::UpdateMesh()
{
  this->Mapper->SetInputData(this->Model->GetMesh());
  this->StockMapper->SetInputData(this->Model->GetMesh());
  this->Update();
  if (this->Scene)
  {
    this->Scene->SetMesh(this->Model->GetMesh());
  }
  Q_EMIT this->changed();
}

//------------------------------------------------------------------------------
// The scene as the members say.
void Side::Update()
{
  const bool isStock = this->Drawn == Kind::Stock;
  vtkOpenGLPolyDataMapper* mapper = this->Mapper;
  this->Actor->SetMapper(isStock ? this->StockMapper.Get() : mapper);
  this->Actor->SetProperty(isStock ? this->Fitted : this->Plain);
  this->Actor->SetVisibility(
    this->IsVisible && mapper->GetInput() && (isStock || this->Mapper->GetBRDF()));
  explorer::SetExposure(this->Actor, this->Exposure * (isStock ? this->StockUnit : 1.0));
  const bool isUnderImage = isStock && this->Light;
  this->Renderer->SetEnvironmentTexture(isUnderImage ? this->StockLight.Get() : nullptr);
  this->Renderer->SetUseImageBasedLighting(isUnderImage);
  this->Lamp->SetSwitch(this->IsLit && !this->Light);
  PlaceLight(this->Lamp, this->Model->GetState().Light);
  if (this->Light)
  {
    this->Light->SetRotationY(this->Model->GetState().Rotation);
    double rows[9]; // of a rotation from the world: where the environment's axes point
    this->Light->GetWorldToEnvironment(rows);
    double identity[6] = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0 }; // the mapper's light turns by itself
    double* axes = isStock ? rows : identity;
    this->Renderer->SetEnvironmentRight(axes);
    this->Renderer->SetEnvironmentUp(axes + 3);
  }
}

//------------------------------------------------------------------------------
void Side::SetVisible(bool visible)
{
  this->IsVisible = visible;
  this->Update();
}

//------------------------------------------------------------------------------
void Side::SetExposure(double factor)
{
  this->Exposure = factor;
  this->Update();
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
// To be measured against the exact picture, and so without what the mesh hides. A planned method
// finds the mapper's plan, which mappers of one material and environment share.
tool::Picture Side::Capture(vtkCamera* camera, const tool::Size& size, double& frame)
{
  const bool isStock = this->Drawn == Kind::Stock;
  if (!this->Scene || isStock != !this->Scene->Stage->IsA("vtkMeasuredBRDFMapper"))
  {
    this->Scene.reset(); // one window at a time
    vtkSmartPointer<vtkOpenGLPolyDataMapper> mapper = vtkSmartPointer<vtkMeasuredBRDFMapper>::New();
    if (isStock)
    {
      mapper = vtkSmartPointer<vtkOpenGLPolyDataMapper>::New();
    }
    this->Scene = std::make_unique<CaptureScene>(mapper);
    this->Scene->SetMesh(this->Model->GetMesh());
  }
  vtkRenderer* renderer = this->Scene->Renderer;
  renderer->RemoveAllLights();
  if (!this->Light)
  {
    renderer->AddLight(this->Lamp);
  }
  if (auto* mapper = vtkMeasuredBRDFMapper::SafeDownCast(this->Scene->Stage))
  {
    mapper->SetErrorTolerance(this->Model->GetState().Tolerance);
    mapper->SetOcclusionModeToOff();
    mapper->SetBRDF(this->Mapper->GetBRDF());
    mapper->SetEnvironment(this->Light);
    mapper->SetIntegrator(this->Mapper->GetIntegrator());
  }
  else
  {
    vtkNew<vtkTexture> texture; // each window has its own
    SetUpLight(texture, this->StockLight->GetInput());
    this->Scene->Unit = this->StockUnit;
    this->Scene->Actor->GetProperty()->DeepCopy(this->Fitted);
    renderer->SetUseImageBasedLighting(this->Light);
    renderer->SetEnvironmentTexture(this->Light ? texture.Get() : nullptr);
    renderer->SetEnvironmentRight(this->Renderer->GetEnvironmentRight());
    renderer->SetEnvironmentUp(this->Renderer->GetEnvironmentUp());
    // With the view's samples.
    auto* view = vtkOpenGLRenderer::SafeDownCast(this->Renderer);
    auto* captured = vtkOpenGLRenderer::SafeDownCast(renderer);
    captured->GetEnvMapLookupTable()->SetLUTSamples(view->GetEnvMapLookupTable()->GetLUTSamples());
    captured->GetEnvMapPrefiltered()->SetPrefilterMaxSamples(
      view->GetEnvMapPrefiltered()->GetPrefilterMaxSamples());
  }
  this->Scene->SetCamera(camera);
  tool::Picture picture = this->Scene->Render(size.Width, size.Height);
  frame = this->Scene->TimeFrame();
  return picture;
}
} // namespace explorer
