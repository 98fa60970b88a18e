// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeasuredBRDFMapper.h"

#include "vtkMeasuredBRDFMapperMixin.txx"

#include "DrawTimer.h"
#include "DrawsColor.h"
#include "MapperProperties.h"
#include "PartMappers.h"
#include "vtkAlgorithm.h"
#include "vtkCompositeDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkPolyData.h"
#include "vtkRadiancePlanner.h"

#include <set>

using namespace measuredbrdf;

template class vtkMeasuredBRDFMapperMixin<vtkOpenGLPolyDataMapper>;

vtkStandardNewMacro(vtkMeasuredBRDFMapper);

//------------------------------------------------------------------------------
struct vtkMeasuredBRDFMapper::MapDrawing
{
  explicit MapDrawing(const std::shared_ptr<vtkMeasuredBRDFMapperInternals>& drawing)
    : Parts(drawing)
  {
  }
  PartMappers Parts;
  DrawTimer Timer;
};

//------------------------------------------------------------------------------
vtkMeasuredBRDFMapper::vtkMeasuredBRDFMapper()
{
  this->Drawing =
    std::make_shared<vtkMeasuredBRDFMapperInternals>(this, std::make_shared<MaterialSettings>(),
      [this]() -> std::vector<MaterialUse>
      {
        vtkPolyData* surface = this->GetInput();
        if (!surface) // composite data, of which nothing is drawn
        {
          return {};
        }
        if (this->Drawing->GetSettings().MaterialMap)
        {
          if (!this->Static)
          {
            this->Update();
          }
          if (this->Map->Parts.Divide(surface))
          {
            return this->Map->Parts.GetUses();
          }
        }
        return { { this->Drawing->GetSettings().BRDF, { surface } } };
      });
  this->Map = std::make_unique<MapDrawing>(this->Drawing);
  this->Drawing->SetToleranceFactor(
    [this](vtkBRDF* brdf)
    {
      return this->Drawing->GetSettings().MaterialMap
               ? this->Map->Parts.GetParts().GetToleranceFactor(brdf)
               : 1.0;
    });
}

//------------------------------------------------------------------------------
vtkMeasuredBRDFMapper::~vtkMeasuredBRDFMapper() = default;

//------------------------------------------------------------------------------
std::vector<vtkMeasuredBRDFMapper::MaterialUse> vtkMeasuredBRDFMapper::GetMaterialUses()
{
  return { { this->Drawing->GetSettings().BRDF, { this->CurrentInput } } };
}

// The properties do not call Modified(): that would rebuild vertex buffers and shaders. Every
// render compares what it used last with what is asked for.
// Strings come by value, as VTK's macros take them:
// NOLINTNEXTLINE(performance-unnecessary-value-param)
MEASUREDBRDF_MAPPER_PROPERTIES(vtkMeasuredBRDFMapper, this->Drawing->GetSettings())

//------------------------------------------------------------------------------
std::string vtkMeasuredBRDFMapper::GetPlan()
{
  const DrawnMaterials materials = this->Drawing->GetLastFrame();
  const double error =
    this->Drawing->GetSettings().MaterialMap ? this->Map->Parts.PredictError(materials) : -1.0;
  return DescribePlans(materials) + DescribeMixture(error) + this->Drawing->DescribeOcclusion();
}

//------------------------------------------------------------------------------
// The parts are drawn instead of the whole where materials are.
bool vtkMeasuredBRDFMapper::RenderParts(vtkRenderer* ren, vtkActor* actor)
{
  if (!this->Drawing->GetSettings().MaterialMap)
  {
    this->Map->Parts.Clear();
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
  ScalarStyle scalars;
  scalars.Read(this);
  this->Map->Parts.Expect(input, actor, this, scalars, !this->ExtraAttributes.empty());
  if (!this->Map->Parts.Divide(input))
  {
    return false;
  }
  this->Drawing->Forget(this); // what the whole was drawn with
  this->Map->Timer.Start(input->GetNumberOfCells());
  this->Map->Parts.Render(ren, actor, this, this->vtkOpenGLPolyDataMapper::GetMTime(),
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
    });
  this->Map->Timer.Stop();
  this->TimeToDraw = this->Map->Timer.GetSeconds();
  return true;
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::RenderPiece(vtkRenderer* ren, vtkActor* actor)
{
  if (!ren || !actor)
  {
    return; // the superclass wants both
  }
  const Depth inside(this->RenderDepth);
  this->Drawing->Render(ren, actor,
    [&]()
    {
      bool drawn = false;
      if (!this->Drawing->Try([&]() { drawn = this->RenderParts(ren, actor); }))
      {
        this->Map->Timer.Stop();
      }
      if (!drawn)
      {
        this->Superclass::RenderPiece(ren, actor);
      }
    });
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->RenderDepth == 0)
  {
    this->Map->Parts.ReleaseGraphicsResources(window);
    this->Map->Timer.ReleaseGraphicsResources();
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::GetPlanPending() { return this->Drawing->IsPending(); }

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::GetPlanReady() { return this->Drawing->IsReady(); }

//------------------------------------------------------------------------------
double vtkMeasuredBRDFMapper::FitProperty(vtkProperty* property)
{
  return vtkPBRPropertyFitter::Fit(this->GetBRDF(), property);
}

//------------------------------------------------------------------------------
vtkIdType vtkMeasuredBRDFMapper::GetTextureBytes()
{
  std::set<const vtkTextureObject*> counted;
  return CountTextureBytes(this->Drawing->GetLastFrame(), counted) +
         this->Map->Parts.GetImageBytes();
}

//------------------------------------------------------------------------------
vtkRadianceIntegrator* vtkMeasuredBRDFMapper::GetCurrentIntegrator()
{
  return FindIntegrator(this->Drawing->GetLastFrame());
}

//------------------------------------------------------------------------------
vtkRadiancePlanner* vtkMeasuredBRDFMapper::GetCurrentPlanner()
{
  return FindPlanner(this->Drawing->GetLastFrame());
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
  this->Drawing->GetVisiblePairs(renderer, actor, normals, views);
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::SetAbortPlanning(bool abort) { this->Drawing->SetAbortPlanning(abort); }

//------------------------------------------------------------------------------
bool vtkMeasuredBRDFMapper::GetAbortPlanning() { return this->Drawing->GetAbortPlanning(); }

//------------------------------------------------------------------------------
std::string vtkMeasuredBRDFMapper::GetMaterialDescription()
{
  const vtkBRDFShaderInputs* form = FindMaterialForm(this->Drawing->GetLastFrame());
  return form ? form->Description : "";
}

//------------------------------------------------------------------------------
double vtkMeasuredBRDFMapper::GetResamplingError()
{
  const vtkBRDFShaderInputs* form = FindMaterialForm(this->Drawing->GetLastFrame());
  return form ? form->ResamplingError : 0.0;
}

//------------------------------------------------------------------------------
double vtkMeasuredBRDFMapper::GetQuantizationError()
{
  const vtkBRDFShaderInputs* form = FindMaterialForm(this->Drawing->GetLastFrame());
  return form ? form->QuantizationError : 0.0;
}

//------------------------------------------------------------------------------
double* vtkMeasuredBRDFMapper::GetBounds()
{
  double* bounds = this->Superclass::GetBounds();
  if (vtkCompositeDataSet::SafeDownCast(this->GetInputDataObject(0, 0)) &&
      this->Drawing->WarnOnce("composite"))
  {
    vtkWarningMacro("The input is composite data, of which this mapper draws nothing: use "
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
    this->Drawing->GetSettings().Copy(other->Drawing->GetSettings());
  }
  this->Superclass::ShallowCopy(m);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkMeasuredBRDFMapper::GetMTime()
{
  // While drawing, the superclass asks whether buffers and shaders are out of date.
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->RenderDepth > 0 ? time : std::max(time, this->Drawing->GetAppearanceMTime());
}

//------------------------------------------------------------------------------
void vtkMeasuredBRDFMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Drawing->GetSettings().Print(os, indent);
  os << indent << "Plan: " << this->GetPlan() << "\n";
}
