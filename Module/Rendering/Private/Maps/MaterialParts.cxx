// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialParts.h"

#include "MaterialPartition.h"
#include "PartSurfaces.h"
#include "PolygonMaterials.h"
#include "vtkCellArray.h"
#include "vtkMaterialMap.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <exception>
#include <set>
#include <utility>

namespace measuredbrdf
{
namespace
{
// What is drawn in the pixels of a group.
MaterialPart MakePart(
  const PolygonMaterials& materials, const MaterialPartition::Group& group, vtkMaterialMap* map)
{
  MaterialPart part;
  const PolygonMaterials::Set& set = group.Materials;
  for (int material : set)
  {
    vtkBRDF* brdf = materials.BRDFs[static_cast<std::size_t>(material)];
    part.HasRest = part.HasRest || !brdf;
    if (brdf)
    {
      part.Members.push_back(brdf);
    }
  }
  if (group.Slot >= 0)
  {
    part.Kind = MixtureKind::Nearest;
    part.HasRest = false;
    part.IsRest = part.Members.empty();
    part.Slot = group.Slot;
    return part;
  }
  const bool alone =
    set.size() == 1 ||
    (!part.HasRest &&
      std::set<vtkSmartPointer<vtkBRDF>>(part.Members.begin(), part.Members.end()).size() == 1);
  if (alone && !group.IsBand)
  {
    part.Members.resize(std::min<std::size_t>(part.Members.size(), 1));
    part.HasRest = false;
    return part;
  }
  part.NumberOfWeights = static_cast<int>(part.Members.size()) + (part.HasRest ? 1 : 0);
  part.Kind = MixtureKind::Weights;
  if (map->GetMode() == vtkMaterialMap::VALUES)
  {
    part.Kind = MixtureKind::Value;
    for (int material : set)
    {
      part.Knots.push_back(materials.Knots[static_cast<std::size_t>(material - 1)]);
    }
    part.IsBand = group.IsBand;
    part.Band[0] = set.front() > 1 ? static_cast<float>(part.Knots.front()) : part.Band[0];
    part.Band[1] = set.back() < static_cast<int>(materials.Knots.size())
                     ? static_cast<float>(part.Knots.back())
                     : part.Band[1];
  }
  else if (map->GetMode() == vtkMaterialMap::TEXTURES)
  {
    part.Kind = MixtureKind::Images;
    for (int material : set)
    {
      if (material > 0 || !part.HasRest)
      {
        part.Components.push_back(material - 1); // -1: the rest, where there are no weights
      }
    }
  }
  return part;
}
}

void MaterialParts::Drop()
{
  this->Parts.clear();
  this->BRDFs.clear();
  this->Uses.clear();
}

void MaterialParts::Clear()
{
  if (this->Input)
  {
    const unsigned long revision = this->Revision;
    const bool may = this->MayCut;
    *this = MaterialParts();
    this->Revision = revision + 1;
    this->MayCut = may;
  }
}

std::string MaterialParts::Update(
  vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others, std::string& warning)
{
  const bool isNew = map != this->Map || map->GetDivisionMTime() != this->MapTime ||
                     input != this->Input || input->GetMTime() != this->InputTime ||
                     others != this->Others;
  this->IsCutForbidden = this->IsCutForbidden && !(isNew && this->MayCut);
  const bool cut = this->MayCut && !this->IsCutForbidden;
  if (isNew || cut != this->IsCut)
  {
    this->IsCut = cut;
    this->Input = input;
    this->InputTime = input->GetMTime();
    this->Map = map;
    this->MapTime = map->GetDivisionMTime();
    this->Others = others;
    ++this->Revision;
    this->Drop();
    this->Warning.clear();
    try
    {
      this->Problem = this->Divide(input, map, others);
    }
    catch (const std::exception& e) // no memory, say: the next frame tries again
    {
      this->Drop();
      this->Input = nullptr;
      this->InputTime = 0;
      this->Problem = e.what();
    }
  }
  warning = this->Warning;
  return this->Problem;
}

std::string MaterialParts::Divide(vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others)
{
  PartSurfaces surfaces(input);
  PolygonMaterials materials;
  const auto find = [&]()
  {
    materials = PolygonMaterials();
    return materials.Find(
      { input, surfaces.GetPolygons(), surfaces.GetCells() }, map, others, this->Warning);
  };
  std::string problem = find();
  if (problem.empty() && !materials.PointClasses.empty() && this->IsCut)
  {
    surfaces.CutBorders(materials);
  }
  else if (problem.empty() && !materials.PointClasses.empty() &&
           surfaces.SplitPolygons(materials, MaterialPartition::MaximumNumberOfSlots))
  {
    problem = find();
  }
  if (!problem.empty())
  {
    return problem;
  }
  const bool onScale = map->GetMode() == vtkMaterialMap::VALUES;
  const MaterialPartition partition(
    materials, onScale ? MaximumNumberInBand : MaximumNumberOfWeights, WantedNumberOfParts);
  if (partition.Dropped > 0)
  {
    this->Warning += (this->Warning.empty() ? "in " : "; in ") + std::to_string(partition.Dropped) +
                     " polygons more than " + std::to_string(MaximumNumberOfWeights) +
                     " materials meet: those of the least weights are left out there";
  }
  const auto distributed = surfaces.Distribute(materials, partition);
  for (std::size_t k = 0; k < distributed.size(); ++k)
  {
    MaterialPart part = MakePart(materials, partition.Groups[k], map);
    part.NumberOfWeights =
      part.Kind == MixtureKind::Nearest ? partition.NumberOfSlots : part.NumberOfWeights;
    part.Surface = distributed[k];
    this->AddPart(part);
    if (part.HasRest)
    {
      part.Members.clear();
      part.HasRest = false;
      part.IsRest = true;
      this->AddPart(std::move(part));
    }
  }
  if (vtkSmartPointer<vtkPolyData> verticesAndLines = surfaces.MakeVerticesAndLines())
  {
    MaterialPart part;
    part.Surface = verticesAndLines;
    this->AddPart(std::move(part));
  }
  this->MeasureShares(surfaces.GetAreas(materials));
  return "";
}

void MaterialParts::AddPart(MaterialPart part)
{
  for (vtkBRDF* brdf : part.Members)
  {
    const auto [use, isNew] = this->Uses.try_emplace(brdf);
    if (isNew)
    {
      this->BRDFs.push_back(brdf);
    }
    std::vector<vtkPolyData*>& surfaces = use->second.Surfaces;
    if (surfaces.empty() || surfaces.back() != part.Surface) // a material may be there twice
    {
      surfaces.push_back(part.Surface);
    }
  }
  this->Parts.push_back(std::move(part));
}

const MaterialParts::Use& MaterialParts::Find(vtkBRDF* brdf) const
{
  static const Use none;
  const auto found = this->Uses.find(brdf);
  return found == this->Uses.end() ? none : found->second;
}

void MaterialParts::MeasureShares(const std::map<vtkBRDF*, double>& areas)
{
  double sum = 0.0;
  for (const auto& [brdf, area] : areas)
  {
    sum += brdf ? area : 0.0;
  }
  for (const auto& [brdf, area] : areas)
  {
    if (brdf && sum > 0.0)
    {
      this->Uses[brdf].Share = area / sum;
    }
  }
}
} // namespace measuredbrdf
