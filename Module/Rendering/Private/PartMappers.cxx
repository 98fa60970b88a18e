// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartMappers.h"

#include "vtkMeasuredBRDFMapperMixin.txx"

#include "MapArrays.h"
#include "vtkActor.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
// Whether the mapper's colors are those of an array that chooses or weighs the materials: it has
// done its work then.
bool AreColorsOfMap(vtkPolyDataMapper* mapper, vtkPolyData* input, vtkMaterialMap* map)
{
  int cellFlag = 0;
  const vtkDataArray* colors = vtkAbstractMapper::GetScalars(input, mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cellFlag);
  MapArray array;
  if (!colors || map->GetMode() == vtkMaterialMap::TEXTURES)
  {
    return false;
  }
  if (map->GetMode() != vtkMaterialMap::WEIGHTS)
  {
    return array.Find(input, map).empty() && array.GetArray() == colors;
  }
  for (int k = 0; k < map->GetNumberOfMaterials(); ++k)
  {
    if (array.FindWeights(input, map, k).empty() && array.GetArray() == colors)
    {
      return true;
    }
  }
  return false;
}
}

PartMappers::PartMappers(std::shared_ptr<vtkMeasuredBRDFMapperInternals> drawing)
  : Drawing(std::move(drawing))
{
}

PartMappers::~PartMappers() = default;

bool PartMappers::Divide(vtkPolyData* input)
{
  const MaterialSettings& settings = this->Drawing->GetSettings();
  if (!settings.MaterialMap || !input || !input->GetPoints())
  {
    return false;
  }
  std::string warning;
  const std::string problem =
    this->Parts.Update(input, settings.MaterialMap, settings.BRDF, warning);
  for (const std::string& text : { problem, warning })
  {
    if (!text.empty() && this->Drawing->WarnOnce("map: " + text))
    {
      vtkWarningWithObjectMacro(this->Drawing->GetOwner(),
        << (problem.empty() ? "The material map: " : "The material map is not used: ") << text
        << ".");
    }
  }
  this->Input = input;
  return problem.empty();
}

void PartMappers::Synchronize(
  vtkPolyDataMapper* host, const std::function<void(vtkPolyDataMapper*)>& prepare)
{
  vtkMaterialMap* map = this->Drawing->GetSettings().MaterialMap;
  const bool colored = AreColorsOfMap(host, this->Input, map);
  this->Mappers.resize(this->Parts.Get().size());
  for (std::size_t k = 0; k < this->Mappers.size(); ++k)
  {
    if (!this->Mappers[k])
    {
      this->Mappers[k] = vtkSmartPointer<PartMapper>::New();
      this->Mappers[k]->SetDrawing(this->Drawing);
    }
    PartMapper* mapper = this->Mappers[k];
    mapper->vtkPolyDataMapper::ShallowCopy(host); // not of what VTK 9.1 calls deprecated
    mapper->SetStatic(1);                         // its surface has no pipeline
    mapper->RemoveAllVertexAttributeMappings();
    prepare(mapper);
    mapper->SetPart(&this->Parts, k, map);
    if (colored && !this->Parts.Get()[k].Members.empty())
    {
      mapper->ScalarVisibilityOff();
    }
  }
}

void PartMappers::Render(vtkRenderer* renderer, vtkActor* actor, vtkPolyDataMapper* host,
  vtkMTimeType time, const std::function<void(vtkPolyDataMapper*)>& prepare)
{
  if (this->Revision != this->Parts.GetRevision() || this->HostTime != time)
  {
    this->Synchronize(host, prepare);
    this->Revision = this->Parts.GetRevision();
    this->HostTime = time;
  }
  for (const vtkSmartPointer<PartMapper>& mapper : this->Mappers)
  {
    mapper->SetStyle(this->Style.get());
    mapper->RenderPiece(renderer, actor);
  }
}

void PartMappers::SetStyle(const BlockStyle& style)
{
  if (!this->Style)
  {
    this->Style = std::make_unique<BlockStyle>();
  }
  *this->Style = style;
}

void PartMappers::Clear()
{
  this->Mappers.clear();
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
      const double o[3] = { std::sqrt(0.5), 0.0, std::sqrt(0.5) };
      double albedo[3];
      brdf->GetDirectionalAlbedo(o, albedo);
      const double weight = this->Parts.GetShare(brdf) * (albedo[0] + albedo[1] + albedo[2]);
      vtkRadiancePlanner* plan = (*drawn)->Plan;
      sum += weight * plan->GetPredictedError(plan->GetChoice());
      total += weight;
    }
  }
  return total > 0.0 ? sum / total : -1.0;
}

void PartMappers::ReleaseGraphicsResources(vtkWindow* window)
{
  for (const vtkSmartPointer<PartMapper>& mapper : this->Mappers)
  {
    mapper->ReleaseGraphicsResources(window);
  }
}
} // namespace measuredbrdf
