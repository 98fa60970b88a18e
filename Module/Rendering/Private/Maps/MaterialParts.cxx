// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialParts.h"

#include "CellMaterials.h"
#include "PartSets.h"
#include "PartSurfaces.h"
#include "WeightImages.h"
#include "vtkCellArray.h"
#include "vtkMaterialMap.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <set>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr double CoarseShare = 0.025;
constexpr double CoarseFactor = 3.0;

// What is drawn in the pixels of a set of materials.
MaterialPart MakePart(
  const CellMaterials& cells, const CellMaterials::Set& set, vtkMaterialMap* map, bool isBand)
{
  const std::vector<vtkBRDF*>& brdfs = cells.GetBRDFs();
  MaterialPart part;
  for (int material : set)
  {
    vtkBRDF* brdf = brdfs[static_cast<std::size_t>(material)];
    part.HasRest = part.HasRest || !brdf;
    if (brdf)
    {
      part.Members.push_back(brdf);
    }
  }
  const bool alone =
    set.size() == 1 ||
    (!part.HasRest &&
      std::set<vtkSmartPointer<vtkBRDF>>(part.Members.begin(), part.Members.end()).size() == 1);
  if (alone && !isBand)
  {
    part.Members.resize(std::min<std::size_t>(part.Members.size(), 1));
    part.HasRest = false;
    return part;
  }
  switch (map->GetMode())
  {
    case vtkMaterialMap::WEIGHTS:
      part.Kind = MixtureKind::Weights;
      break;
    case vtkMaterialMap::VALUES:
      part.Kind = MixtureKind::Value;
      for (int material : set)
      {
        part.Knots.push_back(cells.GetKnots()[static_cast<std::size_t>(material - 1)]);
      }
      part.IsBand = isBand;
      part.Band[0] = set.front() > 1 ? static_cast<float>(part.Knots.front()) : part.Band[0];
      part.Band[1] = set.back() < static_cast<int>(cells.GetKnots().size())
                       ? static_cast<float>(part.Knots.back())
                       : part.Band[1];
      break;
    default:
      part.Kind = MixtureKind::Images;
      for (int material : set)
      {
        if (material > 0 || !part.HasRest)
        {
          part.Components.push_back(material - 1); // -1: the rest, where there are no weights
        }
      }
  }
  part.NumberOfWeights = static_cast<int>(part.Members.size()) + (part.HasRest ? 1 : 0);
  return part;
}
}

std::array<float, 4> MakeHat(const std::vector<double>& knots, std::size_t k)
{
  std::array<float, 4> hat = { 1.0f, 0.0f, 1.0f, 0.0f };
  if (k > 0)
  {
    const double slope = 1.0 / (knots[k] - knots[k - 1]);
    hat[0] = static_cast<float>(-knots[k - 1] * slope);
    hat[1] = static_cast<float>(slope);
  }
  if (k + 1 < knots.size())
  {
    const double slope = 1.0 / (knots[k + 1] - knots[k]);
    hat[2] = static_cast<float>(knots[k + 1] * slope);
    hat[3] = static_cast<float>(-slope);
  }
  return hat;
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
  const bool isMapNew = map != this->Map || map->GetDivisionMTime() != this->MapTime;
  const bool isNew = isMapNew || input != this->Input || input->GetMTime() != this->InputTime ||
                     others != this->Others;
  // Not to and fro: actors and windows that share a mapper may differ in whether borders are cut.
  this->IsCutForbidden = !this->MayCut || (this->IsCutForbidden && !isNew);
  this->IsCutWanted = this->IsCutWanted && !isMapNew;
  const bool cut = this->IsCutWanted && !this->IsCutForbidden;
  if (isNew || cut != this->IsCut)
  {
    this->IsCut = cut;
    this->Input = input;
    this->InputTime = input->GetMTime();
    this->Map = map;
    this->MapTime = map->GetDivisionMTime();
    this->Others = others;
    ++this->Revision;
    this->Parts.clear();
    this->BRDFs.clear();
    this->Uses.clear();
    this->Warning.clear();
    try
    {
      this->Problem = this->Divide(input, map, others);
    }
    catch (const std::exception& e) // no memory, say: the next frame tries again
    {
      this->Parts.clear();
      this->BRDFs.clear();
      this->Uses.clear();
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
  CellMaterials cells;
  const auto find = [&]()
  {
    return cells.Find(
      input, map, others, surfaces.GetPolygons(), surfaces.GetCells(), this->Warning);
  };
  std::string problem = find();
  if (problem.empty() && !cells.GetPointClasses().empty() && this->IsCut)
  {
    surfaces.CutBorders(cells);
  }
  else if (problem.empty() && !cells.GetPointClasses().empty() &&
           surfaces.SplitPolygons(cells, PartSets::MaximumNumberOfSlots))
  {
    cells = CellMaterials();
    problem = find();
  }
  if (!problem.empty())
  {
    return problem;
  }
  const bool onScale = map->GetMode() == vtkMaterialMap::VALUES;
  const PartSets sets(
    cells, onScale ? MaximumNumberInBand : MaximumNumberOfWeights, WantedNumberOfParts);
  if (sets.GetNumberOfDropped() > 0)
  {
    this->Warning += (this->Warning.empty() ? "in " : "; in ") +
                     std::to_string(sets.GetNumberOfDropped()) + " polygons more than " +
                     std::to_string(MaximumNumberOfWeights) +
                     " materials meet: those of the least weights are left out there";
  }
  surfaces.Distribute(cells, sets);
  for (std::size_t k = 0; k < sets.Get().size(); ++k)
  {
    MaterialPart part = MakePart(cells, sets.Get()[k], map, sets.IsBand(k));
    if (sets.IsBorder(k))
    {
      part.Kind = MixtureKind::Nearest;
      part.IsRest = part.Members.empty();
      part.Class = sets.Get()[k].front();
      part.Slot = sets.GetSlot(k);
      part.Polygons = surfaces.GetPolygonsOf(k);
      part.NumberOfWeights = sets.GetNumberOfSlots();
    }
    part.Surface = surfaces.GetSurface(k);
    this->AddPart(part);
    if (part.HasRest)
    {
      part.Members.clear();
      part.HasRest = false;
      part.IsRest = true;
      this->AddPart(std::move(part));
    }
  }
  if (vtkPolyData* verticesAndLines = surfaces.GetVerticesAndLines())
  {
    MaterialPart part;
    part.Surface = verticesAndLines;
    this->AddPart(std::move(part));
  }
  this->MeasureShares(surfaces.GetAreas(cells));
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

const std::vector<vtkPolyData*>& MaterialParts::GetSurfaces(vtkBRDF* brdf) const
{
  return this->Find(brdf).Surfaces;
}

void MaterialParts::MeasureShares(const std::map<vtkBRDF*, double>& areas)
{
  double sum = 0.0;
  std::vector<std::pair<double, vtkBRDF*>> smallestFirst;
  for (const auto& [brdf, area] : areas)
  {
    if (brdf)
    {
      sum += area;
      smallestFirst.emplace_back(area, brdf);
    }
  }
  if (!(sum > 0.0))
  {
    return;
  }
  std::sort(smallestFirst.begin(), smallestFirst.end());
  double smaller = 0.0; // of all that are not larger
  for (std::size_t k = 0; k < smallestFirst.size();)
  {
    std::size_t end = k;
    for (; end < smallestFirst.size() && smallestFirst[end].first <= smallestFirst[k].first; ++end)
    {
      smaller += smallestFirst[end].first / sum;
    }
    for (; k < end; ++k)
    {
      Use& use = this->Uses[smallestFirst[k].second];
      use.Share = smallestFirst[k].first / sum;
      use.ToleranceFactor = use.Share > 0.0 && smaller <= CoarseShare ? CoarseFactor : 1.0;
    }
  }
}
} // namespace measuredbrdf
