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
#include <set>

namespace measuredbrdf
{
namespace
{
constexpr double CoarseShare = 0.025;
constexpr double CoarseFactor = 3.0;

// min(a + b v, c + d v), clamped to [0, 1], is the weight of a material on a scale of values; at
// the ends of the scale it does not fall again.
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

// What is drawn in the pixels of a set of materials.
MaterialPart MakePart(
  const CellMaterials& cells, const CellMaterials::Set& set, vtkMaterialMap* map)
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
  if (alone)
  {
    part.Members.resize(std::min<std::size_t>(part.Members.size(), 1));
    part.HasRest = false;
    return part;
  }
  switch (map->GetMode())
  {
    case vtkMaterialMap::CLASSES:
      part.Kind = MixtureKind::Nearest;
      break;
    case vtkMaterialMap::WEIGHTS:
      part.Kind = MixtureKind::Weights;
      break;
    case vtkMaterialMap::VALUES:
      part.Kind = MixtureKind::Value;
      for (int material : set)
      {
        part.Hats.push_back(MakeHat(cells.GetKnots(), static_cast<std::size_t>(material - 1)));
      }
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

void MaterialParts::Clear()
{
  if (this->Input)
  {
    const unsigned long revision = this->Revision;
    *this = MaterialParts();
    this->Revision = revision + 1;
  }
}

std::string MaterialParts::Update(
  vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others, std::string& warning)
{
  if (input != this->Input || input->GetMTime() != this->InputTime || map != this->Map ||
      map->GetDivisionMTime() != this->MapTime || others != this->Others)
  {
    this->Input = input;
    this->InputTime = input->GetMTime();
    this->Map = map;
    this->MapTime = map->GetDivisionMTime();
    this->Others = others;
    ++this->Revision;
    this->Parts.clear();
    this->Areas.clear();
    this->Warning.clear();
    this->Problem = this->Divide(input, map, others);
  }
  warning = this->Warning;
  return this->Problem;
}

std::string MaterialParts::Divide(vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others)
{
  PartSurfaces surfaces(input);
  CellMaterials cells;
  const std::string problem =
    cells.Find(input, map, others, surfaces.GetPolygons(), surfaces.GetCells(), this->Warning);
  if (!problem.empty())
  {
    return problem;
  }
  const PartSets sets(cells, MaximumNumberOfWeights, WantedNumberOfParts);
  if (sets.GetNumberOfDropped() > 0)
  {
    this->Warning += (this->Warning.empty() ? "in " : "; in ") +
                     std::to_string(sets.GetNumberOfDropped()) + " polygons more than " +
                     std::to_string(MaximumNumberOfWeights) +
                     " materials meet: those of the least weights are left out there";
  }
  for (const auto& [brdf, area] : surfaces.GetAreas(cells))
  {
    this->Areas[brdf] += area;
  }
  surfaces.Distribute(cells, sets);
  for (std::size_t k = 0; k < sets.Get().size(); ++k)
  {
    MaterialPart part = MakePart(cells, sets.Get()[k], map);
    part.Surface = surfaces.GetSurface(k);
    this->Parts.push_back(part);
    if (part.HasRest)
    {
      part.Members.clear();
      part.HasRest = false;
      part.IsRest = true;
      this->Parts.push_back(std::move(part));
    }
  }
  if (vtkPolyData* verticesAndLines = surfaces.GetVerticesAndLines())
  {
    MaterialPart part;
    part.Surface = verticesAndLines;
    this->Parts.push_back(std::move(part));
  }
  return "";
}

double MaterialParts::GetShare(vtkBRDF* brdf) const
{
  double sum = 0.0;
  for (const auto& [other, area] : this->Areas)
  {
    sum += other ? area : 0.0;
  }
  const auto found = this->Areas.find(brdf);
  return sum > 0.0 && found != this->Areas.end() ? found->second / sum : 0.0;
}

double MaterialParts::GetToleranceFactor(vtkBRDF* brdf) const
{
  const double own = this->GetShare(brdf);
  double smaller = 0.0; // of all that are not larger
  for (const auto& [other, area] : this->Areas)
  {
    const double share = other ? this->GetShare(other) : 0.0;
    smaller += share <= own ? share : 0.0;
  }
  return own > 0.0 && smaller <= CoarseShare ? CoarseFactor : 1.0;
}

std::vector<vtkPolyData*> MaterialParts::GetSurfaces(vtkBRDF* brdf) const
{
  std::vector<vtkPolyData*> surfaces;
  for (const MaterialPart& part : this->Parts)
  {
    if (std::find(part.Members.begin(), part.Members.end(), brdf) != part.Members.end())
    {
      surfaces.push_back(part.Surface);
    }
  }
  return surfaces;
}

std::vector<vtkBRDF*> MaterialParts::GetBRDFs() const
{
  std::vector<vtkBRDF*> brdfs;
  for (const MaterialPart& part : this->Parts)
  {
    for (vtkBRDF* brdf : part.Members)
    {
      if (std::find(brdfs.begin(), brdfs.end(), brdf) == brdfs.end())
      {
        brdfs.push_back(brdf);
      }
    }
  }
  return brdfs;
}
} // namespace measuredbrdf
