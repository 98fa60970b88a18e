// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialParts.h"

#include "MaterialPieces.h"
#include "SurfacePoints.h"
#include "WeightImages.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkMaterialMap.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace measuredbrdf
{
namespace
{
using Set = MaterialPieces::Set;

// Most materials of groups that are merged: their textures fit into the 16 units that every
// graphics card has, and none is left out where fewer meet.
constexpr std::size_t MostMerged = 5;

Set Unite(const Set& a, const Set& b)
{
  Set both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

// Merge the mixture of the fewest pieces with the one that makes that cheapest: each pixel asks all
// materials. Returns whether it could.
template <typename Group>
bool MergeSmallest(std::vector<Group>& mixtures)
{
  const auto smallest = std::min_element(mixtures.begin(), mixtures.end(),
    [](const Group& a, const Group& b) { return a.Pieces.size() < b.Pieces.size(); });
  std::size_t least = std::numeric_limits<std::size_t>::max();
  auto best = mixtures.end();
  for (auto other = mixtures.begin(); other != mixtures.end(); ++other)
  {
    const std::size_t size = Unite(smallest->Materials, other->Materials).size();
    const std::size_t added = (size - smallest->Materials.size()) * smallest->Pieces.size() +
                              (size - other->Materials.size()) * other->Pieces.size();
    if (other != smallest && size <= MostMerged && added < least)
    {
      least = added;
      best = other;
    }
  }
  if (best == mixtures.end())
  {
    return false;
  }
  best->Materials = Unite(best->Materials, smallest->Materials);
  best->Pieces.insert(best->Pieces.end(), smallest->Pieces.begin(), smallest->Pieces.end());
  mixtures.erase(smallest);
  return true;
}

// What is drawn in the pixels of a group.
MaterialPart MakePart(const MaterialPieces& pieces, const Set& set)
{
  MaterialPart part;
  for (int material : set)
  {
    if (vtkBRDF* brdf = pieces.BRDFs[material])
    {
      part.Members.push_back(brdf);
      part.Components.push_back(material - 1); // -1: where there are no weights
    }
  }
  part.HasRest = part.Members.size() < set.size();
  if (set.size() == 1 ||
      (!part.HasRest && std::all_of(part.Members.begin(), part.Members.end(),
                          [&part](vtkBRDF* brdf) { return brdf == part.Members[0]; })))
  {
    part.Members.resize(std::min<std::size_t>(part.Members.size(), 1));
    part.HasRest = false;
    return part;
  }
  part.Kind = pieces.ImageShares.empty() ? MixtureKind::Weights : MixtureKind::Images;
  part.NumberOfWeights = static_cast<int>(set.size());
  return part;
}

// Copies these rows of all arrays, also of those that VTK leaves out by default.
void CopyTuples(
  vtkDataSetAttributes* from, vtkDataSetAttributes* to, const std::vector<vtkIdType>& tuples)
{
  vtkNew<vtkIdList> source;
  vtkNew<vtkIdList> target;
  source->SetNumberOfIds(tuples.size());
  target->SetNumberOfIds(tuples.size());
  std::copy(tuples.begin(), tuples.end(), source->begin());
  std::iota(target->begin(), target->end(), 0);
  to->CopyAllOn();
  to->CopyAllocate(from, tuples.size());
  to->CopyData(from, source, target);
}

// Those of a surface, with points that stand for some of its own after them.
void CopyPoints(vtkPolyData* from, const std::vector<vtkIdType>& originals, vtkPolyData* to)
{
  const auto count = static_cast<vtkIdType>(originals.size());
  if (count == from->GetNumberOfPoints())
  {
    to->SetPoints(from->GetPoints());
    to->GetPointData()->ShallowCopy(from->GetPointData());
    return;
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(from->GetPoints()->GetDataType());
  points->Allocate(count);
  for (vtkIdType original : originals)
  {
    points->InsertNextPoint(from->GetPoint(original));
  }
  to->SetPoints(points);
  CopyTuples(from->GetPointData(), to->GetPointData(), originals);
}
}

void MaterialParts::Drop()
{
  this->Parts.clear();
  this->Whole = nullptr;
  this->BRDFs.clear();
  this->Shares.clear();
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
  if (map != this->Map || map->GetDivisionMTime() != this->MapTime || input != this->Input ||
      input->GetMTime() != this->InputTime || others != this->Others)
  {
    this->Input = input;
    this->InputTime = input->GetMTime();
    this->Map = map;
    this->MapTime = map->GetDivisionMTime();
    this->Others = others;
    ++this->Revision;
    this->Drop();
    this->Warning.clear();
    this->Problem.clear();
    try
    {
      this->Divide(input, map, others);
    }
    catch (const MapProblem& e)
    {
      this->Problem = e.what();
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

void MaterialParts::Divide(vtkPolyData* input, vtkMaterialMap* map, vtkBRDF* others)
{
  const MaterialPieces pieces(input, map, others);
  this->Warning = pieces.Warning;
  this->MakeSurfaces(input, pieces, this->MakeGroups(pieces));
  this->MeasureShares(pieces);
}

// Pieces where the same materials meet are of one group, which is drawn by one shader. Where there
// are too many groups, some are merged, but for those of one material.
std::vector<MaterialParts::Group> MaterialParts::MakeGroups(const MaterialPieces& pieces)
{
  std::vector<Group> groups(pieces.Sets.size());
  for (std::size_t k = 0; k < pieces.Pieces.size(); ++k)
  {
    groups[pieces.Pieces[k].Set].Pieces.push_back(k);
  }
  std::size_t cut = 0;
  for (std::size_t k = 0; k < groups.size(); ++k)
  {
    groups[k].Materials = pieces.Sets[k];
    if (pieces.Sets[k].size() > MaximumNumberOfWeights)
    {
      cut += groups[k].Pieces.size();
      groups[k].Materials = pieces.GetHeaviest(pieces.Sets[k], MaximumNumberOfWeights);
    }
  }
  if (cut > 0)
  {
    this->Warning += (this->Warning.empty() ? "in " : "; in ") + std::to_string(cut) +
                     " polygons more than " + std::to_string(MaximumNumberOfWeights) +
                     " materials meet: those of the least weights are left out there";
  }
  const auto single = std::stable_partition(
    groups.begin(), groups.end(), [](const Group& group) { return group.Materials.size() < 2; });
  std::vector<Group> mixtures(single, groups.end());
  groups.erase(single, groups.end());
  while (mixtures.size() > WantedNumberOfParts && MergeSmallest(mixtures))
  {
  }
  groups.insert(groups.end(), mixtures.begin(), mixtures.end());
  return groups;
}

// All parts share one array of points: they have one vertex buffer, and where they meet their edges
// are the same to the last bit. Weights of a part are in the order of its own members, so that a
// few of them suffice whatever the number of materials. So a point that has several weights where
// several parts meet stands in the array several times.
void MaterialParts::MakeSurfaces(
  vtkPolyData* input, const MaterialPieces& pieces, const std::vector<Group>& groups)
{
  std::vector<vtkIdType> originals(pieces.Points->GetNumberOfPoints());
  std::iota(originals.begin(), originals.end(), 0);
  std::vector<std::size_t> owners(originals.size(), groups.size()); // of points: none yet
  std::map<std::pair<vtkIdType, std::size_t>, vtkIdType> doubled;   // of a point and a group
  std::vector<std::vector<float>> weights;                          // of arrays
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> cells(input->GetNumberOfVerts() + input->GetNumberOfLines());
  std::iota(cells.begin(), cells.end(), 0);
  const vtkIdType firstPolygon = cells.size();
  constexpr int width = partarrays::WeightsPerArray;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const std::vector<int>& materials = groups[g].Materials;
    MaterialPart part = MakePart(pieces, materials);
    const bool isMixed = part.Kind == MixtureKind::Weights;
    weights.resize(
      std::max<std::size_t>(weights.size(), isMixed ? (materials.size() + width - 1) / width : 0));
    const vtkIdType first = polygons->GetNumberOfCells();
    vtkNew<vtkCellArray> own;
    for (std::size_t k : groups[g].Pieces)
    {
      const MaterialPieces::Piece& piece = pieces.Pieces[k];
      std::vector<vtkIdType> corners(
        pieces.Corners.begin() + piece.Begin, pieces.Corners.begin() + piece.End);
      for (vtkIdType& corner : corners)
      {
        const vtkIdType point = corner;
        std::size_t& owner = owners[point];
        if (isMixed && (pieces.AreWeightsOfPieces() || (owner != groups.size() && owner != g)))
        {
          const auto next = static_cast<vtkIdType>(originals.size());
          corner = pieces.AreWeightsOfPieces()
                     ? next
                     : doubled.try_emplace({ point, g }, next).first->second;
          if (corner == next)
          {
            originals.push_back(point);
          }
        }
        else if (isMixed)
        {
          owner = g;
        }
        for (std::size_t m = 0; m < materials.size() && isMixed; ++m)
        {
          std::vector<float>& array = weights[m / width];
          array.resize(width * originals.size(), 0.0f);
          array[width * corner + m % width] =
            static_cast<float>(pieces.GetWeight(piece, point, materials[m]));
        }
      }
      own->InsertNextCell(corners.size(), corners.data());
      cells.push_back(piece.Cell);
    }
    polygons->Append(own);
    part.Surface = vtkSmartPointer<vtkPolyData>::New();
    part.Surface->SetPolys(own);
    CopyTuples(input->GetCellData(), part.Surface->GetCellData(),
      { cells.begin() + firstPolygon + first, cells.end() });
    this->AddPart(std::move(part));
  }
  this->Whole = vtkSmartPointer<vtkPolyData>::New();
  CopyPoints(pieces.Points, originals, this->Whole);
  this->Whole->SetVerts(input->GetVerts());
  this->Whole->SetLines(input->GetLines());
  this->Whole->SetPolys(polygons);
  this->Whole->GetFieldData()->ShallowCopy(input->GetFieldData());
  CopyTuples(input->GetCellData(), this->Whole->GetCellData(), cells);
  vtkPointData* data = this->Whole->GetPointData();
  for (std::size_t k = 0; k < weights.size(); ++k)
  {
    weights[k].resize(width * originals.size(), 0.0f);
    vtkNew<vtkFloatArray> array;
    array->SetName(partarrays::GetWeights(static_cast<int>(k)).c_str());
    array->SetNumberOfComponents(width);
    array->SetNumberOfTuples(originals.size());
    std::copy(weights[k].begin(), weights[k].end(), array->GetPointer(0));
    data->AddArray(array);
  }
  if (!pieces.ImageShares.empty())
  {
    const auto named = vtkSmartPointer<vtkDataArray>::Take(data->GetTCoords()->NewInstance());
    named->ShallowCopy(data->GetTCoords());
    named->SetName(partarrays::Coordinates);
    data->AddArray(named);
  }
  for (const MaterialPart& part : this->Parts)
  {
    part.Surface->SetPoints(this->Whole->GetPoints());
    part.Surface->GetPointData()->ShallowCopy(data);
    part.Surface->GetFieldData()->ShallowCopy(input->GetFieldData());
  }
}

// With the rest of it, if it has one.
void MaterialParts::AddPart(MaterialPart part)
{
  for (vtkBRDF* brdf : part.Members)
  {
    if (this->Shares.try_emplace(brdf, 0.0).second)
    {
      this->BRDFs.push_back(brdf);
    }
  }
  this->Parts.push_back(part);
  if (part.HasRest)
  {
    part.Members.clear();
    part.HasRest = false;
    part.IsRest = true;
    this->Parts.push_back(std::move(part));
  }
}

void MaterialParts::MeasureShares(const MaterialPieces& pieces)
{
  double sum = 0.0;
  for (const MaterialPieces::Piece& piece : pieces.Pieces)
  {
    const Face face =
      MakeFace(pieces.Points, &pieces.Corners[piece.Begin], piece.End - piece.Begin);
    const double area = 0.5 * glm::length(face.Area);
    for (int material : pieces.Sets[piece.Set])
    {
      if (vtkBRDF* brdf = pieces.BRDFs[material])
      {
        const double share = area * pieces.GetShare(piece, material);
        this->Shares[brdf] += share;
        sum += share;
      }
    }
  }
  for (auto& [brdf, share] : this->Shares)
  {
    share = sum > 0.0 ? share / sum : 0.0;
  }
}
} // namespace measuredbrdf
