// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeasuredBRDFMapper.h"

#include "BRDFShader.h"
#include "BRDFTextures.h"
#include "CurrentPlan.h"
#include "DrawsColor.h"
#include "LightSetCache.h"
#include "MapperPlans.h"

#include "vtkActor.h"
#include "vtkBRDF.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkEnvironment.h"
#include "vtkInformation.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetIntegrator.h"
#include "vtkLightingMapPass.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPolyData.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRadianceCostModel.h"
#include "vtkRadiancePlanner.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkTexture.h"
#include "vtkVarianceLightSetGenerator.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <set>
#include <string>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkMeasuredBRDFMapper);

struct vtkMeasuredBRDFMapper::Internals
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkSmartPointer<vtkLightSet> LightSet;
  vtkSmartPointer<vtkRadianceIntegrator> WantedIntegrator;
  vtkSmartPointer<vtkRadianceCostModel> Costs;
  MapperPlans Plans;

  // In use since the last RenderPieceStart.
  vtkSmartPointer<vtkBRDF> Drawn;         // the material or, of a plan in use, its snapshot
  std::shared_ptr<FormTextures> Material; // null where the shader has no use for the BRDF itself
  std::shared_ptr<FormTextures> Radiance; // what the environment adds; null without one
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
  vtkSmartPointer<vtkEnvironment> CurrentEnvironment;
  vtkSmartPointer<vtkLightSet> CurrentLights;
  vtkNew<vtkLightSetIntegrator> LightLoop;
  vtkNew<vtkVarianceLightSetGenerator> Variance; // its tree serves every number of lights
  bool Ready = false;                            // whether the material can be drawn

  const vtkBRDFGPUForm* GetMaterialForm() const
  {
    return this->Material ? &this->Material->GetForm() : nullptr;
  }
  vtkBRDFGPUForm GetRadianceForm() const
  {
    return this->Radiance ? this->Radiance->GetForm() : vtkBRDFGPUForm();
  }

  std::map<const vtkOpenGLHelper*, std::string> ShaderKeys;
  std::set<std::string> Warned; // one warning per cause

  bool WarnOnce(const std::string& cause) { return this->Warned.insert(cause).second; }

  vtkSmartPointer<vtkEnvironment> GetLight(vtkRenderer* ren) const
  {
    return this->Environment ? this->Environment : FindEnvironment(ren->GetEnvironmentTexture());
  }

  // What a mapper wants to draw by; false where nothing is to be planned.
  static bool GetRequest(
    vtkMeasuredBRDFMapper* mapper, vtkRenderer* ren, vtkActor* actor, PlanRequest& request)
  {
    const Internals& impl = *mapper->Impl;
    request.BRDF = impl.BRDF;
    request.Environment = impl.GetLight(ren);
    if (!request.BRDF || !request.Environment || request.Environment->GetWidth() == 0 ||
        impl.WantedIntegrator || impl.LightSet || mapper->Method != AUTO || !mapper->GetInput())
    {
      return false;
    }
    const CurrentPlan::Timing timings[] = { CurrentPlan::Timing::Foreground,
      CurrentPlan::Timing::Changes, CurrentPlan::Timing::Always };
    request.Tolerance = mapper->ErrorTolerance;
    request.Costs = impl.Costs;
    request.Timing = timings[mapper->PlanningMode];
    request.ForView = mapper->PlanForView;
    request.Renderer = ren;
    request.Actor = actor;
    request.Surfaces = { mapper->GetInput() };
    return true;
  }

  // Else the superclass draws it.
  static bool IsShaded(vtkActor* actor)
  {
    return actor->GetProperty()->GetLighting() &&
           actor->GetProperty()->GetRepresentation() == VTK_SURFACE;
  }

  // What the renderer's other mappers want to draw by in the same frame.
  static void VisitRequests(vtkRenderer* ren, const PlanRequest::Visit& visit)
  {
    vtkPropCollection* props = ren->GetViewProps();
    vtkCollectionSimpleIterator it;
    props->InitTraversal(it);
    while (vtkProp* prop = props->GetNextProp(it))
    {
      auto* actor = vtkActor::SafeDownCast(prop);
      auto* mapper = vtkMeasuredBRDFMapper::SafeDownCast(actor ? actor->GetMapper() : nullptr);
      if (!mapper || !actor->GetVisibility() || !IsShaded(actor))
      {
        continue;
      }
      if (mapper->PlanForView)
      {
        mapper->Update(); // it may be drawn for the first time
      }
      PlanRequest request;
      if (GetRequest(mapper, ren, actor, request))
      {
        visit(mapper->Impl->Plans, request);
      }
    }
  }
};

namespace
{
int NextPowerOfTwo(int n)
{
  int power = 1;
  while (power < n)
  {
    power *= 2;
  }
  return power;
}

bool HasLight(vtkRenderer* ren)
{
  vtkLightCollection* lights = ren->GetLights();
  vtkCollectionSimpleIterator it;
  lights->InitTraversal(it);
  while (vtkLight* light = lights->GetNextLight(it))
  {
    if (light->GetSwitch())
    {
      return true;
    }
  }
  return false;
}

// The superclass declares normals and positions for lit primitives only; an environment lights
// scenes without a single vtkLight. Works on int (VTK < 9.4) and on the enum that followed.
template <typename Complexity>
class ForceLit
{
public:
  ForceLit(Complexity& complexity, bool force)
    : Target(complexity)
    , Saved(complexity)
  {
    if (force && static_cast<int>(complexity) == 0)
    {
      complexity = static_cast<Complexity>(1);
    }
  }
  ~ForceLit() { this->Target = this->Saved; }
  ForceLit(const ForceLit&) = delete;
  void operator=(const ForceLit&) = delete;

private:
  Complexity& Target;
  Complexity Saved;
};
}

//------------------------------------------------------------------------------
vtkMeasuredBRDFMapper::vtkMeasuredBRDFMapper()
  : Impl(new Internals)
{
}

//------------------------------------------------------------------------------
vtkMeasuredBRDFMapper::~vtkMeasuredBRDFMapper()
{
  this->Impl.reset();
  SweepLights();
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->Impl->BRDF.Get() << "\n";
  os << indent << "Environment: " << this->Impl->Environment.Get() << "\n";
  os << indent << "LightSet: " << this->Impl->LightSet.Get() << "\n";
  os << indent << "Integrator: " << this->Impl->WantedIntegrator.Get() << "\n";
  os << indent << "Method: " << (this->Method == AUTO ? "auto" : "light set") << "\n";
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  const char* const modes[] = { "foreground", "background", "background from start" };
  os << indent << "PlanningMode: " << modes[this->PlanningMode] << "\n";
  os << indent << "PlanForView: " << (this->PlanForView ? "On" : "Off") << "\n";
  os << indent << "CostModel: " << (this->Impl->Costs ? this->Impl->Costs->GetName() : "default")
     << "\n";
  os << indent << "Plan: " << this->GetPlan() << "\n";
  os << indent << "LightSetMethod: "
     << (this->LightSetMethod == MEDIAN_CUT
            ? "median cut"
            : (this->LightSetMethod == VARIANCE ? "variance" : "importance sampling"))
     << "\n";
  os << indent << "NumberOfLights: " << this->NumberOfLights << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "SoftLights: " << (this->SoftLights ? "On" : "Off") << "\n";
  os << indent
     << "ScalarColoringMode: " << (this->ScalarColoringMode == MODULATE ? "modulate" : "ignore")
     << "\n";
}

// The setters below do not call Modified(): that would rebuild vertex buffers and shaders. Every
// render compares what it used last with what is asked for.

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetBRDF(vtkBRDF* brdf) { this->Impl->BRDF = brdf; }

//------------------------------------------------------------------------------
vtkBRDF* vtkMeasuredBRDFMapper::GetBRDF() { return this->Impl->BRDF; }

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetEnvironment(vtkEnvironment* environment)
{
  this->Impl->Environment = environment;
}

//------------------------------------------------------------------------------
vtkEnvironment* vtkMeasuredBRDFMapper::GetEnvironment() { return this->Impl->Environment; }

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetLightSet(vtkLightSet* lights) { this->Impl->LightSet = lights; }

//------------------------------------------------------------------------------
vtkLightSet* vtkMeasuredBRDFMapper::GetLightSet() { return this->Impl->LightSet; }

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetIntegrator(vtkRadianceIntegrator* integrator)
{
  this->Impl->WantedIntegrator = integrator;
}

//------------------------------------------------------------------------------
vtkRadianceIntegrator* vtkMeasuredBRDFMapper::GetIntegrator()
{
  return this->Impl->WantedIntegrator;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetMethod(int method)
{
  this->Method = method == LIGHT_SET ? LIGHT_SET : AUTO;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetErrorTolerance(double tolerance)
{
  const double clamped = tolerance >= 1e-3 ? std::min(tolerance, 1.0) : 1e-3;
  if (clamped != tolerance)
  {
    vtkWarningMacro("SetErrorTolerance: " << tolerance << " clamped to " << clamped << ".");
  }
  this->ErrorTolerance = clamped;
}

//------------------------------------------------------------------------------
std::string vtkMeasuredBRDFMapper::GetPlan()
{
  vtkRadiancePlanner* plan = this->Impl->Plans.GetPlan();
  return plan ? plan->GetPlan() : std::string();
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetPlanningMode(int mode)
{
  this->PlanningMode = mode == BACKGROUND || mode == BACKGROUND_FROM_START ? mode : FOREGROUND;
}

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::GetPlanPending() { return this->Impl->Plans.IsPending(); }

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::GetPlanReady() { return this->Impl->Plans.IsReady(); }

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetCostModel(vtkRadianceCostModel* model) { this->Impl->Costs = model; }

//------------------------------------------------------------------------------
vtkRadianceCostModel* vtkMeasuredBRDFMapper::GetCostModel() { return this->Impl->Costs; }

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetLightSetMethod(int method)
{
  this->LightSetMethod = method == IMPORTANCE_SAMPLING || method == VARIANCE ? method : MEDIAN_CUT;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetNumberOfLights(int count)
{
  const int clamped = std::clamp(count, 1, vtkLightSetGenerator::MaximumNumberOfLights);
  if (clamped != count)
  {
    vtkWarningMacro("SetNumberOfLights: " << count << " clamped to " << clamped << ".");
  }
  this->NumberOfLights = clamped;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetSeed(unsigned int seed) { this->Seed = seed; }

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetScalarColoringMode(int mode)
{
  this->ScalarColoringMode = mode == IGNORE_SCALARS ? IGNORE_SCALARS : MODULATE;
}

//------------------------------------------------------------------------------
vtkIdType vtkMeasuredBRDFMapper::GetTextureBytes()
{
  std::size_t bytes = 0;
  for (const std::shared_ptr<FormTextures>& textures :
    { this->Impl->Material, this->Impl->Radiance })
  {
    bytes += textures ? textures->GetBytes() : 0;
  }
  return static_cast<vtkIdType>(bytes);
}

//------------------------------------------------------------------------------
vtkLightSet* vtkMeasuredBRDFMapper::GetCurrentLightSet() { return this->Impl->CurrentLights; }

//------------------------------------------------------------------------------
std::string vtkMeasuredBRDFMapper::GetMaterialDescription()
{
  return this->Impl->Material ? this->Impl->Material->GetForm().Description : "";
}

//------------------------------------------------------------------------------
double vtkMeasuredBRDFMapper::GetResamplingError()
{
  return this->Impl->Material ? this->Impl->Material->GetForm().ResamplingError : 0.0;
}

//------------------------------------------------------------------------------
double vtkMeasuredBRDFMapper::GetQuantizationError()
{
  return this->Impl->Material ? this->Impl->Material->GetForm().QuantizationError : 0.0;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ShallowCopy(vtkAbstractMapper* m)
{
  if (vtkMeasuredBRDFMapper* other = vtkMeasuredBRDFMapper::SafeDownCast(m))
  {
    this->SetBRDF(other->GetBRDF());
    this->SetEnvironment(other->GetEnvironment());
    this->SetLightSet(other->GetLightSet());
    this->SetIntegrator(other->GetIntegrator());
    this->SetMethod(other->GetMethod());
    this->SetErrorTolerance(other->GetErrorTolerance());
    this->SetPlanningMode(other->GetPlanningMode());
    this->SetPlanForView(other->GetPlanForView());
    this->SetCostModel(other->GetCostModel());
    this->SetLightSetMethod(other->GetLightSetMethod());
    this->SetNumberOfLights(other->GetNumberOfLights());
    this->SetSeed(other->GetSeed());
    this->SetSoftLights(other->GetSoftLights());
    this->SetScalarColoringMode(other->GetScalarColoringMode());
  }
  this->Superclass::ShallowCopy(m);
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  // The superclass may call this again from inside: it must do no harm twice.
  this->Impl->Material.reset();
  this->Impl->Radiance.reset();
  this->Impl->Ready = false;
  this->Impl->Plans.ReleaseUploads(window); // planning holds none, and goes on
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::UsesMaterial(vtkActor* actor, const vtkOpenGLHelper* cellBO)
{
  if (!this->Impl->Ready || this->DrawingSelection || this->DrawingVertices)
  {
    return false;
  }
  const bool triangles =
    cellBO == &this->Primitives[PrimitiveTris] || cellBO == &this->Primitives[PrimitiveTriStrips];
  vtkInformation* keys = actor->GetPropertyKeys();
  return triangles && Internals::IsShaded(actor) &&
         !(keys && (keys->Has(vtkLightingMapPass::RENDER_NORMALS()) ||
                     keys->Has(vtkLightingMapPass::RENDER_LUMINANCE())));
}

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::HasTangents()
{
  return this->VBOs->GetNumberOfComponents("tangentMC") == 3;
}

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::GetNeedToRebuildShaders(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  const bool rebuild = this->Superclass::GetNeedToRebuildShaders(cellBO, ren, actor);
  std::string key;
  if (this->UsesMaterial(actor, &cellBO))
  {
    key = (this->Impl->Material ? this->Impl->Material->GetForm().GetShaderKey() : "") + "/" +
          this->Impl->GetRadianceForm().GetShaderKey();
    if (!this->Impl->Drawn->IsIsotropic())
    {
      key += this->HasTangents() ? "tangents" : "axis";
    }
  }
  std::string& last = this->Impl->ShaderKeys[&cellBO];
  const bool changed = key != last;
  last = key;
  return rebuild || changed;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ReplaceShaderColor(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor)
{
  ForceLit lit(this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity,
    this->UsesMaterial(actor, this->LastBoundBO));
  this->Superclass::ReplaceShaderColor(shaders, ren, actor);
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ReplaceShaderPositionVC(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor)
{
  ForceLit lit(this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity,
    this->UsesMaterial(actor, this->LastBoundBO));
  this->Superclass::ReplaceShaderPositionVC(shaders, ren, actor);
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ReplaceShaderNormal(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor)
{
  const bool material = this->UsesMaterial(actor, this->LastBoundBO);
  ForceLit lit(this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity, material);
  this->Superclass::ReplaceShaderNormal(shaders, ren, actor);
  if (!material || this->Impl->Drawn->IsIsotropic() || !this->HasTangents())
  {
    return;
  }

  // Tangents through the stages, beside the positions (their tags are still there).
  std::string vs = shaders[vtkShader::Vertex]->GetSource();
  std::string declarations = "out vec3 brdfTangentVCVSOutput;\n";
  if (vs.find("in vec3 tangentMC;") == std::string::npos)
  {
    declarations += "in vec3 tangentMC;\n";
  }
  if (vs.find("uniform mat3 normalMatrix;") == std::string::npos)
  {
    declarations += "uniform mat3 normalMatrix;\n";
  }
  vtkShaderProgram::Substitute(
    vs, "//VTK::PositionVC::Dec", "//VTK::PositionVC::Dec\n" + declarations, false);
  vtkShaderProgram::Substitute(vs, "//VTK::PositionVC::Impl",
    "//VTK::PositionVC::Impl\n  brdfTangentVCVSOutput = normalMatrix * tangentMC;\n", false);
  shaders[vtkShader::Vertex]->SetSource(vs);

  std::string gs = shaders[vtkShader::Geometry]->GetSource();
  vtkShaderProgram::Substitute(gs, "//VTK::PositionVC::Dec",
    "//VTK::PositionVC::Dec\nin vec3 brdfTangentVCVSOutput[];\nout vec3 brdfTangentVCGSOutput;\n",
    false);
  vtkShaderProgram::Substitute(gs, "//VTK::PositionVC::Impl",
    "//VTK::PositionVC::Impl\n  brdfTangentVCGSOutput = brdfTangentVCVSOutput[i];\n", false);
  shaders[vtkShader::Geometry]->SetSource(gs);

  std::string fs = shaders[vtkShader::Fragment]->GetSource();
  vtkShaderProgram::Substitute(
    fs, "//VTK::Light::Dec", "in vec3 brdfTangentVCVSOutput;\n//VTK::Light::Dec", false);
  shaders[vtkShader::Fragment]->SetSource(fs);
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ReplaceShaderLight(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor)
{
  if (!this->UsesMaterial(actor, this->LastBoundBO))
  {
    this->Superclass::ReplaceShaderLight(shaders, ren, actor);
    return;
  }
  std::string fs = shaders[vtkShader::Fragment]->GetSource();
  vtkShaderProgram::Substitute(fs, "//VTK::Light::Dec",
    "//VTK::Light::Dec\n" +
      GetShaderDeclarations(this->Impl->GetMaterialForm(), this->Impl->GetRadianceForm()),
    false);
  vtkShaderProgram::Substitute(fs, "//VTK::Light::Dec",
    std::string(static_cast<vtkOpenGLRenderer*>(ren)->GetLightingUniforms()), false);

  TangentSource tangents = TangentSource::None;
  if (!this->Impl->Drawn->IsIsotropic())
  {
    tangents = this->HasTangents() ? TangentSource::Data : TangentSource::Axis;
    if (tangents == TangentSource::Axis && this->Impl->WarnOnce("tangents"))
    {
      vtkWarningMacro("The material is anisotropic but the polydata has no float point tangents "
                      "(PointData::SetTangents): they turn about the environment's up axis.");
    }
  }
  std::string edges;
  if (this->DrawingEdges(ren, actor))
  {
    // VTK 9.3 added an opacity of edges.
    edges = fs.find("uniform float edgeOpacity") != std::string::npos
              ? "color = mix(color, edgeColor, emix * edgeOpacity);"
              : "color = mix(color, edgeColor, emix);";
  }
  const auto& info = this->PrimitiveInfo[this->LastBoundBO];
  // Image-based lighting counts as a light in VTK 9.6; here it is none (HasLight).
  const int complexity = this->Impl->Material ? static_cast<int>(info.LastLightComplexity) : 0;
  vtkShaderProgram::Substitute(fs, "//VTK::Light::Impl",
    GetShaderBody(complexity, info.LastLightCount, tangents, edges), false);
  shaders[vtkShader::Fragment]->SetSource(fs);
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, ren, actor);
  if (!this->UsesMaterial(actor, &cellBO))
  {
    return;
  }
  vtkShaderProgram* program = cellBO.Program;
  for (const std::shared_ptr<FormTextures>& textures :
    { this->Impl->Material, this->Impl->Radiance })
  {
    if (textures)
    {
      textures->SetUniforms(program);
    }
  }
  vtkNew<vtkMatrix3x3> rotation;
  if (this->Impl->CurrentEnvironment)
  {
    double rows[9];
    this->Impl->CurrentEnvironment->GetWorldToEnvironment(rows);
    rotation->DeepCopy(rows);
  }
  rotation->Transpose(); // SetUniformMatrix hands over columns
  program->SetUniformMatrix("brdfEnvironmentRotation", rotation);
  const bool scalars =
    this->GetScalarVisibility() && (this->VBOs->GetNumberOfComponents("scalarColor") != 0 ||
                                     this->HaveCellScalars || this->ColorTextureMap);
  program->SetUniformi("brdfModulate", scalars && this->ScalarColoringMode == MODULATE ? 1 : 0);
}

//------------------------------------------------------------------------------
CurrentPlan* vtkMeasuredBRDFMapper::UpdatePlan(vtkRenderer* ren, vtkActor* actor)
{
  Internals& impl = *this->Impl;
  PlanRequest request;
  if (!Internals::GetRequest(this, ren, actor, request))
  {
    return nullptr;
  }
  request.Others = [ren](const PlanRequest::Visit& visit) { Internals::VisitRequests(ren, visit); };
  bool changed = false;
  std::string problem;
  CurrentPlan& plan = impl.Plans.Update(request, changed, problem);
  if (!problem.empty() && plan.GetPlan())
  {
    vtkWarningMacro("Planning: " << problem);
  }
  else if (!problem.empty())
  {
    vtkErrorMacro("Planning: " << problem);
  }
  if (changed)
  {
    this->InvokeEvent(vtkCommand::UpdateDataEvent);
  }
  return &plan;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::Prepare(vtkRenderer* ren, vtkActor* actor)
{
  Internals& impl = *this->Impl;
  if (impl.BRDF)
  {
    auto* window = vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow());

    impl.CurrentEnvironment = impl.GetLight(ren);
    if (!impl.CurrentEnvironment && ren->GetEnvironmentTexture() && impl.WarnOnce("environment"))
    {
      vtkWarningMacro("The renderer's environment texture holds neither a lat-long image nor six "
                      "square cube faces of one size; it lights nothing here.");
    }
    const bool lit = impl.CurrentEnvironment && impl.CurrentEnvironment->GetWidth() > 0;
    impl.Integrator = lit ? impl.WantedIntegrator : nullptr;
    impl.Drawn = impl.BRDF;
    CurrentPlan* current = this->UpdatePlan(ren, actor);
    vtkRadiancePlanner* plan = current ? current->GetPlan() : nullptr;
    if (!current && lit)
    {
      impl.Plans.Clear();
    }
    else if (!current) // other renderers may have light
    {
      impl.Plans.Clear(ren);
    }
    if (plan)
    {
      impl.Integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(plan->NewIntegrator());
      impl.Drawn = plan->GetBRDF();
      impl.CurrentEnvironment = current->GetEnvironment();
      impl.CurrentLights = nullptr;
    }
    else if (impl.Integrator)
    {
      impl.Integrator->SetBRDF(impl.BRDF);
      impl.Integrator->SetEnvironment(impl.CurrentEnvironment);
      impl.CurrentLights = nullptr;
    }
    else if (impl.LightSet)
    {
      impl.CurrentLights = impl.LightSet;
    }
    else if (lit)
    {
      int count = this->NumberOfLights;
      if (this->LightSetMethod == MEDIAN_CUT && count != NextPowerOfTwo(count))
      {
        count = NextPowerOfTwo(count);
        if (impl.WarnOnce("median cut " + std::to_string(this->NumberOfLights)))
        {
          vtkWarningMacro("Median cut makes powers of two: " << count << " lights instead of "
                                                             << this->NumberOfLights << ".");
        }
      }
      impl.CurrentLights = FindLightSet(
        impl.CurrentEnvironment, this->LightSetMethod, count, this->Seed, impl.Variance);
    }
    else
    {
      impl.CurrentLights = nullptr;
    }

    if (impl.CurrentLights)
    {
      impl.LightLoop->SetBRDF(impl.BRDF);
      impl.LightLoop->SetLightSet(impl.CurrentLights);
      impl.LightLoop->SetSoftLights(this->SoftLights);
      impl.Integrator = impl.LightLoop;
    }

    std::string problem;
    impl.Radiance = impl.Integrator ? FormTextures::Find(impl.Integrator, window) : nullptr;
    if (impl.Integrator)
    {
      problem = impl.Radiance->Update(impl.Integrator, window);
    }
    const bool evaluates = (impl.Integrator && impl.Integrator->UsesBRDFOnGPU()) || HasLight(ren);
    const bool softLights = impl.Integrator && impl.Integrator->UsesSoftLights();
    impl.Material = evaluates ? FormTextures::Find(impl.Drawn, softLights, window) : nullptr;
    if (evaluates && problem.empty())
    {
      problem = impl.Material->Update(impl.Drawn, window);
    }
    impl.Ready = problem.empty();
    if (!impl.Ready && impl.WarnOnce(problem))
    {
      vtkErrorMacro("The material is not drawn: " << problem << ".");
    }
    if (current)
    {
      current->Uploads = { impl.Material, impl.Radiance };
    }
    for (const std::shared_ptr<FormTextures>& textures : { impl.Material, impl.Radiance })
    {
      if (impl.Ready && textures)
      {
        textures->Activate();
      }
    }
  }
  else
  {
    impl.Material.reset();
    impl.Radiance.reset();
    impl.Integrator = nullptr;
    impl.Drawn = nullptr;
    impl.Plans.Clear();
    impl.CurrentEnvironment = nullptr;
    impl.CurrentLights = nullptr;
  }
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::RenderPieceStart(vtkRenderer* ren, vtkActor* actor)
{
  this->Impl->Ready = false;
  // Else as the superclass, with what is there left alone.
  if (Internals::IsShaded(actor) && DrawsColor(ren, actor))
  {
    try
    {
      this->Prepare(ren, actor);
    }
    catch (const std::exception& e) // no memory, say
    {
      this->Impl->Ready = false;
      if (this->Impl->WarnOnce(e.what()))
      {
        vtkErrorMacro("The material is not drawn: " << e.what() << ".");
      }
    }
  }
  this->Superclass::RenderPieceStart(ren, actor);
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::RenderPieceFinish(vtkRenderer* ren, vtkActor* actor)
{
  for (const std::shared_ptr<FormTextures>& textures :
    { this->Impl->Material, this->Impl->Radiance })
  {
    if (this->Impl->Ready && textures)
    {
      textures->Deactivate();
    }
  }
  this->Superclass::RenderPieceFinish(ren, actor);
}
