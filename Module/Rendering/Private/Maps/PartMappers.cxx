// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartMappers.h"

#include "ClassBorders.h"
#include "PolygonMaterials.h"
#include "ReflectionIntegral.h"
#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSelection.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <type_traits>

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

// Whether colors of points are mapped to, which new points could not have: a table of colors need
// not be linear.
bool ColorsPoints(const ScalarStyle& colors, vtkPolyData* input)
{
  int cellFlag = 0;
  return colors.Visibility &&
         vtkAbstractMapper::GetAbstractScalars(input, colors.ScalarMode, colors.ArrayAccessMode,
           colors.ArrayId, colors.ArrayName.c_str(), cellFlag) &&
         cellFlag == 0;
}

bool AreAllOfMaterials(const MaterialSettings& settings)
{
  bool all = settings.BRDF != nullptr;
  for (int k = 0; k < settings.MaterialMap->GetNumberOfMaterials(); ++k)
  {
    all = all && settings.MaterialMap->GetBRDF(k);
  }
  return all;
}

// What is read from bytes, point by point.
bool ReadsVisibility(const MaterialSettings& settings, vtkPolyData* surface)
{
  return settings.OcclusionMode != 0 &&
         surface->GetPointData()->HasArray(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName());
}
}

bool AreColorsOfMap(const ScalarStyle& colors, vtkPolyData* input, vtkMaterialMap* map)
{
  int cellFlag = 0;
  return map && colors.Visibility &&
         IsReadByMap(input, map,
           vtkAbstractMapper::GetAbstractScalars(input, colors.ScalarMode, colors.ArrayAccessMode,
             colors.ArrayId, colors.ArrayName.c_str(), cellFlag));
}

PartMappers::PartMappers(std::shared_ptr<MaterialDrawing> drawing)
  : Drawing(std::move(drawing))
{
  // Programs set their uniforms when the mapper that they know says so.
  this->ForwardEvents->SetClientData(this->Drawing->GetOwner());
  this->ForwardEvents->SetCallback([](vtkObject*, unsigned long event, void* owner, void* program)
    { static_cast<vtkObject*>(owner)->InvokeEvent(event, program); });
}

PartMappers::~PartMappers() = default;

// Where edges are drawn, the pieces' would be; what is selected is drawn over the whole polygons,
// in the same depth.
void PartMappers::Expect(vtkPolyData* input, vtkActor* actor, vtkOpenGLPolyDataMapper* host,
  const ScalarStyle& scalars, bool hasOwnAttributes)
{
  const MaterialSettings& settings = this->Drawing->GetSettings();
  vtkSelection* selection = host->GetSelection();
  this->IsExpected = true;
  this->MayCut =
    settings.MaterialMap && input && ClassesMapper::CanDraw(actor) &&
    !actor->GetProperty()->GetEdgeVisibility() && !hasOwnAttributes &&
    !(selection && selection->GetNumberOfNodes() > 0) &&
    (!ColorsPoints(scalars, input) ||
      (AreColorsOfMap(scalars, input, settings.MaterialMap) && AreAllOfMaterials(settings)));
}

bool PartMappers::Divide(vtkPolyData* input)
{
  const MaterialSettings& settings = this->Drawing->GetSettings();
  if (!settings.MaterialMap || !input || !input->GetPoints())
  {
    return false;
  }
  std::string warning;
  const vtkSmartPointer<vtkPolyData> whole = this->Drawing->FindWhole(input);
  if (this->IsExpected)
  {
    this->Parts.SetMayCut(
      this->MayCut && !ReadsVisibility(settings, whole) && ClassBorders::CanInterpolate(whole));
  }
  const std::string problem =
    this->Parts.Update(whole, settings.MaterialMap, settings.BRDF, warning);
  for (const std::string& text : { problem, warning })
  {
    if (!text.empty() && this->Parts.HasFailed())
    {
      this->Drawing->AddFailure("The material map is not used in this frame: " + text + ".");
    }
    else if (!text.empty() && this->Drawing->WarnOnce(GetCause(text)))
    {
      vtkWarningWithObjectMacro(this->Drawing->GetOwner(),
        << (problem.empty() ? "The material map: " : "The material map is not used: ") << text
        << ".");
    }
  }
  this->Input = input;
  if (!problem.empty())
  {
    this->DropMappers();
  }
  return problem.empty();
}

void PartMappers::ForEachMapper(const std::function<void(PartMapper*)>& visit) const
{
  if (this->Classes)
  {
    visit(this->Classes);
  }
  for (const vtkSmartPointer<PartMapper>& mapper : this->Mappers)
  {
    visit(mapper);
  }
}

void PartMappers::SetUp(PartMapper* mapper, vtkOpenGLPolyDataMapper* host, bool colored,
  const std::function<void(vtkPolyDataMapper*)>& prepare)
{
  CopySettings(host, mapper);
  this->Scalars.Write(mapper);
  mapper->RemoveAllVertexAttributeMappings();
  prepare(mapper);
  // An array that chooses materials has done its work; a block's own color comes first.
  if (colored || this->OverridesColor)
  {
    mapper->ScalarVisibilityOff();
  }
}

void PartMappers::Synchronize(
  vtkOpenGLPolyDataMapper* host, const std::function<void(vtkPolyDataMapper*)>& prepare)
{
  vtkMaterialMap* map = this->Drawing->GetSettings().MaterialMap;
  if (!this->Style)
  {
    this->Scalars.Read(host);
  }
  const bool colored = AreColorsOfMap(this->Scalars, this->Input, map);
  const auto make = [this](auto& mapper)
  {
    if (!mapper)
    {
      mapper = std::decay_t<decltype(mapper)>::New();
      mapper->SetDrawing(this->Drawing);
      mapper->AddObserver(vtkCommand::UpdateShaderEvent, this->ForwardEvents);
    }
  };
  std::vector<std::size_t> single;
  std::vector<std::size_t> others;
  for (std::size_t k = 0; k < this->Parts.Get().size(); ++k)
  {
    (this->Together && ClassesMapper::IsSingle(this->Parts.Get()[k]) ? single : others)
      .push_back(k);
  }
  if (single.empty())
  {
    this->Classes = nullptr;
  }
  else
  {
    make(this->Classes);
    this->SetUp(this->Classes, host, colored, prepare);
    this->Classes->SetParts(&this->Parts, single, map);
  }
  this->Mappers.resize(others.size());
  for (std::size_t k = 0; k < others.size(); ++k)
  {
    const MaterialPart& part = this->Parts.Get()[others[k]];
    make(this->Mappers[k]);
    this->SetUp(this->Mappers[k], host, colored && !part.Members.empty(), prepare);
    this->Mappers[k]->SetPart(&this->Parts, part, map);
  }
}

void PartMappers::Render(vtkRenderer* renderer, vtkActor* actor, vtkOpenGLPolyDataMapper* host,
  vtkMTimeType time, const std::function<void(vtkPolyDataMapper*)>& prepare)
{
  const bool overrides = this->Style && this->Style->OverridesColor;
  // Apart for good, until the map changes: actors that share a mapper may differ in this.
  const bool isNew = this->Revision != this->Parts.GetRevision();
  const bool together = ClassesMapper::CanDraw(actor) && (isNew || this->Together);
  if (isNew || this->Together != together || this->HostTime != time || this->Host != host ||
      this->OverridesColor != overrides ||
      (this->Style && !(this->Style->Scalars == this->Scalars)))
  {
    this->Together = together;
    this->OverridesColor = overrides;
    this->Scalars = this->Style ? this->Style->Scalars : this->Scalars;
    this->Synchronize(host, prepare);
    this->Revision = this->Parts.GetRevision();
    this->HostTime = time;
    this->Host = host;
  }
  this->ForEachMapper(
    [&](PartMapper* mapper)
    {
      mapper->SetStyle(this->Style.get());
      mapper->RenderPiece(renderer, actor);
    });
  this->RenderHighlight(renderer, actor, host);
}

void PartMappers::RenderHighlight(
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

void PartMappers::SetStyle(const BlockStyle& style)
{
  if (!this->Style)
  {
    this->Style = std::make_unique<BlockStyle>();
  }
  *this->Style = style;
}

void PartMappers::DropMappers()
{
  this->Classes = nullptr;
  this->Mappers.clear();
  this->Highlight = nullptr;
  this->Host = nullptr;
}

void PartMappers::Clear()
{
  this->DropMappers();
  this->Parts.Clear();
  this->Input = nullptr;
}

std::vector<MaterialUse> PartMappers::GetUses() const
{
  std::vector<MaterialUse> uses;
  for (vtkBRDF* brdf : this->Parts.GetBRDFs())
  {
    uses.emplace_back(brdf, this->Parts.GetSurfaces(brdf));
  }
  return uses;
}

double PartMappers::PredictError(const DrawnMaterials& materials) const
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
        albedo = IntegrateReflection(brdf, o, IntegralOver::Lights, 0.01);
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

// All parts share them.
vtkIdType PartMappers::GetImageBytes() const
{
  vtkIdType bytes = 0;
  this->ForEachMapper(
    [&bytes](PartMapper* mapper) { bytes = std::max(bytes, mapper->GetImageBytes()); });
  return bytes;
}

double PartMappers::GetTimeToDraw() const
{
  double seconds = 0.0;
  this->ForEachMapper([&seconds](PartMapper* mapper) { seconds += mapper->GetTimeToDraw(); });
  return seconds;
}

void PartMappers::ReleaseGraphicsResources(vtkWindow* window)
{
  this->ForEachMapper([window](PartMapper* mapper) { mapper->ReleaseGraphicsResources(window); });
  if (this->Highlight)
  {
    this->Highlight->ReleaseGraphicsResources(window);
  }
}
} // namespace measuredbrdf
