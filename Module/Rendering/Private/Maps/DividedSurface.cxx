// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DividedSurface.h"

#include "HemisphereIntegral.h"
#include "MaterialPieces.h"
#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSelection.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>

namespace measuredbrdf
{
namespace
{
// Draws what vtkMapper::SetSelection highlights on a surface, and nothing else of it: the surface
// itself is drawn part by part.
class HighlightMapper : public vtkOpenGLPolyDataMapper
{
public:
  static HighlightMapper* New();
  vtkTypeMacro(HighlightMapper, vtkOpenGLPolyDataMapper);

protected:
  // The superclass leaves out primitives without indices; what is selected has indices of its own.
  void BuildBufferObjects(vtkRenderer* ren, vtkActor* actor) override
  {
    this->Superclass::BuildBufferObjects(ren, actor);
    for (vtkOpenGLHelper& primitive : this->Primitives)
    {
      primitive.IBO->IndexCount = 0;
    }
  }
};
vtkStandardNewMacro(HighlightMapper);

// Not of the input, nor of what VTK 9.1 calls deprecated.
void CopySettings(vtkOpenGLPolyDataMapper* from, vtkOpenGLPolyDataMapper* to)
{
  to->vtkMapper::ShallowCopy(from);
  to->SetSeamlessU(from->GetSeamlessU());
  to->SetSeamlessV(from->GetSeamlessV());
  to->SetVBOShiftScaleMethod(from->GetVBOShiftScaleMethod());
  to->SetStatic(1); // its surface has no pipeline
}

// Without numbers: data that change from frame to frame have one cause.
std::string GetCause(std::string text)
{
  text.erase(
    std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; }),
    text.end());
  return "map: " + text;
}

// Whether the mapper colors by an array that chooses materials.
bool AreColorsOfMap(vtkMapper* mapper, vtkPolyData* input, vtkMaterialMap* map)
{
  int cellFlag = 0;
  return mapper->GetScalarVisibility() &&
         IsReadByMap(input, map,
           vtkAbstractMapper::GetAbstractScalars(input, mapper->GetScalarMode(),
             mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cellFlag));
}
}

DividedSurface::DividedSurface(std::shared_ptr<MaterialDrawing> drawing)
  : Drawing(std::move(drawing))
{
  // Programs set their uniforms when the mapper that they know says so.
  this->ForwardEvents->SetClientData(this->Drawing->GetOwner());
  this->ForwardEvents->SetCallback([](vtkObject*, unsigned long event, void* owner, void* program)
    { static_cast<vtkObject*>(owner)->InvokeEvent(event, program); });
}

DividedSurface::~DividedSurface() = default;

bool DividedSurface::Divide(vtkPolyData* input)
{
  const MaterialSettings& settings = this->Drawing->GetSettings();
  if (!settings.MaterialMap || !input || !input->GetPoints())
  {
    return false;
  }
  std::string warning;
  const std::string problem = this->Parts.Update(
    this->Drawing->FindWhole(input, this->Whole), settings.MaterialMap, settings.BRDF, warning);
  for (const std::string& text : { problem, warning })
  {
    if (!text.empty() && this->Parts.HasFailed())
    {
      this->Drawing->AddFailure("The material map is not used in this frame: " + text + ".");
    }
    else if (!text.empty())
    {
      this->Drawing->WarnOnce(GetCause(text),
        (problem.empty() ? "The material map: " : "The material map is not used: ") + text + ".");
    }
  }
  this->Input = input;
  if (!problem.empty())
  {
    this->DropMappers();
  }
  return problem.empty();
}

void DividedSurface::Render(vtkRenderer* renderer, vtkActor* actor, vtkOpenGLPolyDataMapper* host,
  vtkMTimeType time, const std::function<void(vtkPolyDataMapper*)>& prepare,
  const BlockStyle* style)
{
  const bool overrides = style && style->OverridesColor;
  if (!this->Mapper || this->Revision != this->Parts.GetRevision() || this->HostTime != time ||
      this->Host != host || this->OverridesColor != overrides)
  {
    if (!this->Mapper)
    {
      this->Mapper = vtkSmartPointer<PartsMapper>::New();
      this->Mapper->SetDrawing(this->Drawing);
      this->Mapper->AddObserver(vtkCommand::UpdateShaderEvent, this->ForwardEvents);
    }
    CopySettings(host, this->Mapper);
    this->Mapper->RemoveAllVertexAttributeMappings();
    prepare(this->Mapper);
    vtkMaterialMap* map = this->Drawing->GetSettings().MaterialMap;
    const bool ofMap = AreColorsOfMap(host, this->Input, map);
    const bool all = std::none_of(this->Parts.Get().begin(), this->Parts.Get().end(),
      [](const MaterialPart& part) { return part.Members.empty(); });
    // An array that chooses materials has done its work; a block's own color comes first.
    if ((ofMap && all) || overrides)
    {
      this->Mapper->ScalarVisibilityOff();
    }
    this->Mapper->SetParts(&this->Parts, map, ofMap);
    this->Revision = this->Parts.GetRevision();
    this->HostTime = time;
    this->Host = host;
    this->OverridesColor = overrides;
  }
  this->Mapper->SetStyle(style);
  this->Mapper->RenderPiece(renderer, actor);
  this->RenderHighlight(renderer, actor, host);
}

void DividedSurface::RenderHighlight(
  vtkRenderer* renderer, vtkActor* actor, vtkOpenGLPolyDataMapper* host)
{
  vtkSelection* selection = host->GetSelection();
  if (!selection || selection->GetNumberOfNodes() == 0)
  {
    return;
  }
  if (!this->Highlight || this->Highlight->GetSelection() != selection ||
      this->Highlight->GetInput() != this->Input || this->HighlightTime != this->Input->GetMTime())
  {
    this->Highlight = vtkSmartPointer<HighlightMapper>::New(); // it looks at each selection once
    this->Highlight->SetInputDataObject(this->Input);
    this->HighlightTime = this->Input->GetMTime();
  }
  CopySettings(host, this->Highlight);
  this->Highlight->SetSelection(selection);
  this->Highlight->SetPointIdArrayName(host->GetPointIdArrayName());
  this->Highlight->SetCellIdArrayName(host->GetCellIdArrayName());
  this->Highlight->SetProcessIdArrayName(host->GetProcessIdArrayName());
  this->Highlight->SetCompositeIdArrayName(host->GetCompositeIdArrayName());
  this->Highlight->RenderPiece(renderer, actor);
}

void DividedSurface::DropMappers()
{
  this->Mapper = nullptr;
  this->Highlight = nullptr;
}

void DividedSurface::Clear()
{
  this->DropMappers();
  this->Parts.Clear();
  this->Input = nullptr;
}

double DividedSurface::PredictError(const DrawnMaterials& materials) const
{
  double sum = 0.0;
  double total = 0.0;
  for (vtkBRDF* brdf : this->Parts.GetBRDFs())
  {
    const auto drawn = std::find_if(materials.begin(), materials.end(),
      [brdf](const DrawnMaterial* other) { return other->Plan && other->Source == brdf; });
    if (drawn != materials.end())
    {
      const glm::dvec3 o(std::sqrt(0.5), 0.0, std::sqrt(0.5));
      glm::dvec3 albedo;
      try
      {
        brdf->Prepare();
        albedo = IntegrateBRDF(brdf, o, false, 0.01);
      }
      catch (const std::exception&) // no memory, say: VTK prints mappers, too
      {
        return -1.0;
      }
      const double weight = this->Parts.GetShare(brdf) * (albedo[0] + albedo[1] + albedo[2]);
      vtkRadiancePlanner* plan = (*drawn)->Plan;
      sum += weight * plan->GetPredictedError(plan->GetChoice());
      total += weight;
    }
  }
  return total > 0.0 ? sum / total : -1.0;
}

void DividedSurface::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Mapper)
  {
    this->Mapper->ReleaseGraphicsResources(window);
  }
  if (this->Highlight)
  {
    this->Highlight->ReleaseGraphicsResources(window);
  }
}
} // namespace measuredbrdf
