// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeasuredBRDFMapper.h"

#include "DividedSurface.h"
#include "MaterialShading.h"
#include "RenderPassQueries.h"
#include "vtkAlgorithm.h"
#include "vtkCompositeDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkPolyData.h"
#include "vtkRadiancePlanner.h"

#include <set>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkMeasuredBRDFMapper);

//------------------------------------------------------------------------------
struct vtkMeasuredBRDFMapper::Internals : public MaterialShading
{
  explicit Internals(vtkMeasuredBRDFMapper* self)
    : MaterialShading(
        self, std::make_shared<MaterialDrawing>(self, [this]() { return this->DivideNext(); }))
    , Self(self)
    , Parts(Drawing)
    , Settings(Drawing->GetSettings())
  {
  }

  // The materials that a map gives the surface as it is now.
  std::vector<vtkBRDF*> DivideNext()
  {
    vtkPolyData* surface = this->Self->GetInput(); // null: composite data are not drawn
    if (!surface || !this->Settings.MaterialMap)
    {
      return {};
    }
    if (!this->Self->Static)
    {
      this->Self->Update();
    }
    return this->Parts.Divide(surface) ? this->Parts.GetBRDFs() : std::vector<vtkBRDF*>();
  }

  std::vector<vtkBRDF*> GetBRDFs() override { return { this->Settings.BRDF.Get() }; }

  vtkMeasuredBRDFMapper* Self;
  DividedSurface Parts; // of a surface that a material map divides
  MaterialSettings& Settings;
};

//------------------------------------------------------------------------------
vtkMeasuredBRDFMapper::vtkMeasuredBRDFMapper()
  : Impl(std::make_unique<Internals>(this))
{
}

//------------------------------------------------------------------------------
vtkMeasuredBRDFMapper::~vtkMeasuredBRDFMapper() = default;

//------------------------------------------------------------------------------
measuredbrdfAllSettingsMacro(vtkMeasuredBRDFMapper);
measuredbrdfDrawingMacro(vtkMeasuredBRDFMapper);

//------------------------------------------------------------------------------
std::string vtkMeasuredBRDFMapper::GetPlan()
{
  const DrawnMaterials materials = this->Impl->Drawing->GetLastFrame();
  const double error =
    this->Impl->Settings.MaterialMap ? this->Impl->Parts.PredictError(materials) : -1.0;
  return DescribePlans(materials) + DescribeMixture(error) +
         this->Impl->Drawing->DescribeOcclusion();
}

//------------------------------------------------------------------------------
// The parts are drawn instead of the whole where materials are.
bool vtkMeasuredBRDFMapper::RenderParts(vtkRenderer* ren, vtkActor* actor)
{
  if (!this->Impl->Settings.MaterialMap)
  {
    this->Impl->Parts.Clear();
    return false;
  }
  if (!DrawsColor(ren, actor) || !IsShaded(actor) || this->GetNumberOfInputConnections(0) == 0)
  {
    return false;
  }
  if (!this->Static)
  {
    this->GetInputAlgorithm()->Update();
  }
  vtkPolyData* input = this->GetInput();
  if (!this->Impl->Parts.Divide(input))
  {
    return false;
  }
  this->Impl->Drawing->Forget(this); // what the whole was drawn with
  this->Impl->Parts.Render(
    ren, actor, this, this->Superclass::GetMTime(),
    [this](vtkPolyDataMapper* mapper)
    {
      for (const auto& [name, attribute] : this->ExtraAttributes)
      {
        if (attribute.TextureName.empty())
        {
          mapper->MapDataArrayToVertexAttribute(name.c_str(), attribute.DataArrayName.c_str(),
            attribute.FieldAssociation, attribute.ComponentNumber);
        }
        else
        {
          mapper->MapDataArrayToMultiTextureAttribute(attribute.TextureName.c_str(),
            attribute.DataArrayName.c_str(), attribute.FieldAssociation, attribute.ComponentNumber);
        }
      }
    },
    nullptr);
  this->TimeToDraw = this->Impl->Parts.GetTimeToDraw();
  return true;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::RenderPiece(vtkRenderer* ren, vtkActor* actor)
{
  if (!ren || !actor)
  {
    return; // the superclass wants both
  }
  const Restored inside(this->Impl->RenderDepth);
  ++this->Impl->RenderDepth;
  this->Impl->Drawing->Render(ren, actor,
    [&]()
    {
      bool drawn = false;
      this->Impl->Drawing->Try([&]() { drawn = this->RenderParts(ren, actor); });
      if (!drawn)
      {
        this->Impl->DrawPiece([&]() { this->Superclass::RenderPiece(ren, actor); },
          [&]() { this->Superclass::RenderPieceFinish(ren, actor); });
      }
    });
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Impl->RenderDepth == 0)
  {
    this->Impl->Parts.ReleaseGraphicsResources(window);
  }
  this->Impl->ReleaseMaterials(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::RenderPieceStart(vtkRenderer* ren, vtkActor* actor)
{
  this->Impl->StartPiece(
    ren, actor, [&]() { this->Superclass::RenderPieceStart(ren, actor); },
    [&]() { this->RenderPieceDraw(ren, actor); });
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::RenderPieceDraw(vtkRenderer* ren, vtkActor* actor)
{
  this->Impl->DrawMaterials([&]() { this->Superclass::RenderPieceDraw(ren, actor); });
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::RenderPieceFinish(vtkRenderer* ren, vtkActor* actor)
{
  this->Impl->FinishPiece([&]() { this->Superclass::RenderPieceFinish(ren, actor); });
}

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::GetNeedToRebuildBufferObjects(vtkRenderer* ren, vtkActor* actor)
{
  return this->Superclass::GetNeedToRebuildBufferObjects(ren, actor) ||
         this->Impl->AreBuffersOutdated();
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::BuildBufferObjects(vtkRenderer* ren, vtkActor* actor)
{
  this->Impl->PrepareBuffers(ren);
  this->Superclass::BuildBufferObjects(ren, actor);
}

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::GetNeedToRebuildShaders(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  const bool rebuild = this->Superclass::GetNeedToRebuildShaders(cellBO, ren, actor);
  return this->Impl->AreShadersOutdated(cellBO, ren) || rebuild;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ReplaceShaderValues(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor)
{
  this->Impl->ReplaceValues(
    shaders, actor, [&]() { this->Superclass::ReplaceShaderValues(shaders, ren, actor); });
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ReplaceShaderLight(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor)
{
  if (!this->Impl->ReplaceLight(shaders, ren, actor))
  {
    this->Superclass::ReplaceShaderLight(shaders, ren, actor);
  }
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, ren, actor);
  this->Impl->SetMapperUniforms(cellBO, ren, actor);
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetPropertyShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  this->Superclass::SetPropertyShaderParameters(cellBO, ren, actor);
  this->Impl->SetPropertyUniforms(cellBO, actor);
}

//------------------------------------------------------------------------------
vtkIdType vtkMeasuredBRDFMapper::GetTextureBytes()
{
  std::set<const vtkTextureObject*> counted;
  return CountTextureBytes(this->Impl->Drawing->GetLastFrame(), counted) +
         this->Impl->Parts.GetImageBytes();
}

//------------------------------------------------------------------------------
vtkRadianceIntegrator* vtkMeasuredBRDFMapper::GetCurrentIntegrator()
{
  return FindFirst(this->Impl->Drawing->GetLastFrame(),
    [](const DrawnMaterial& drawn) { return drawn.Integrator.Get(); });
}

//------------------------------------------------------------------------------
vtkRadiancePlanner* vtkMeasuredBRDFMapper::GetCurrentPlanner()
{
  return FindFirst(this->Impl->Drawing->GetLastFrame(),
    [](const DrawnMaterial& drawn) { return drawn.Plan.Get(); });
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::GetVisiblePairs(
  vtkRenderer* renderer, vtkActor* actor, vtkDataArray* normals, vtkDataArray* views)
{
  if (!renderer || !actor || !normals || !views)
  {
    vtkErrorMacro("GetVisiblePairs: a renderer, an actor and two arrays are needed.");
    return;
  }
  this->Update();
  this->Impl->Drawing->GetVisiblePairs(renderer, actor, normals, views);
}

//------------------------------------------------------------------------------
double* vtkMeasuredBRDFMapper::GetBounds()
{
  double* bounds = this->Superclass::GetBounds();
  if (vtkCompositeDataSet::SafeDownCast(this->GetInputDataObject(0, 0)))
  {
    this->Impl->Drawing->WarnOnce("composite",
      "The input is composite data, of which this mapper draws nothing: use "
      "vtkCompositeMeasuredBRDFMapper.");
  }
  return bounds;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ShallowCopy(vtkAbstractMapper* m)
{
  if (!m)
  {
    return; // the superclass wants one
  }
  if (vtkMeasuredBRDFMapper* other = vtkMeasuredBRDFMapper::SafeDownCast(m))
  {
    this->Impl->Settings.Copy(other->Impl->Settings);
  }
  this->Superclass::ShallowCopy(m);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkMeasuredBRDFMapper::GetMTime()
{
  // While drawing, the superclass asks whether buffers and shaders are out of date.
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Impl->RenderDepth > 0 ? time
                                     : std::max(time, this->Impl->Drawing->GetAppearanceMTime());
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Impl->Settings.Print(os, indent);
  os << indent << "Plan: " << this->GetPlan() << "\n";
}
