// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartSurfaces.h"

#include "CellMaterials.h"
#include "ClassBorders.h"
#include "PartArrays.h"
#include "PartSets.h"
#include "vtkBRDF.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t NoOwner = std::numeric_limits<std::size_t>::max();
using partarrays::WeightsPerGroup;

double GetArea(vtkPoints* points, vtkIdType count, const vtkIdType* corners)
{
  glm::dvec3 first;
  glm::dvec3 last;
  glm::dvec3 next;
  glm::dvec3 normal(0.0);
  for (vtkIdType k = 0; k < count; ++k)
  {
    points->GetPoint(corners[k], &next.x);
    if (k == 0)
    {
      first = next;
    }
    normal += k > 1 ? glm::cross(last - first, next - first) : glm::dvec3(0.0);
    last = next;
  }
  return 0.5 * glm::length(normal);
}

// Copies rows of all arrays, also those that VTK leaves out by default.
template <typename Attributes>
void CopyTuples(
  Attributes* from, Attributes* to, const std::vector<vtkIdType>& tuples, vtkIdType first)
{
  vtkNew<vtkIdList> source;
  vtkNew<vtkIdList> target;
  const auto count = static_cast<vtkIdType>(tuples.size());
  source->SetNumberOfIds(count);
  target->SetNumberOfIds(count);
  std::copy(tuples.begin(), tuples.end(), source->GetPointer(0));
  for (vtkIdType k = 0; k < count; ++k)
  {
    target->SetId(k, first + k);
  }
  to->CopyData(from, source, target);
}
}

PartSurfaces::PartSurfaces(vtkPolyData* input)
  : Input(input)
{
  this->Polygons->DeepCopy(input->GetPolys());
  const vtkIdType first = input->GetNumberOfVerts() + input->GetNumberOfLines();
  for (vtkIdType k = 0; k < input->GetNumberOfPolys(); ++k)
  {
    this->Cells.push_back(first + k);
  }
  this->DecomposeStrips();
  this->MakeVerticesAndLines();
}

PartSurfaces::~PartSurfaces() = default;

void PartSurfaces::DecomposeStrips()
{
  vtkIdType cell = this->Input->GetNumberOfVerts() + this->Input->GetNumberOfLines() +
                   this->Input->GetNumberOfPolys();
  vtkCellArray* strips = this->Input->GetStrips();
  vtkNew<vtkIdList> strip;
  for (vtkIdType k = 0; k < strips->GetNumberOfCells(); ++k, ++cell)
  {
    strips->GetCellAtId(k, strip);
    for (vtkIdType c = 0; c + 2 < strip->GetNumberOfIds(); ++c)
    {
      const vtkIdType triangle[3] = { strip->GetId(c), strip->GetId(c + 1 + c % 2),
        strip->GetId(c + 2 - c % 2) };
      this->Polygons->InsertNextCell(3, triangle);
      this->Cells.push_back(cell);
    }
  }
}

void PartSurfaces::MakeVerticesAndLines()
{
  const vtkIdType count = this->Input->GetNumberOfVerts() + this->Input->GetNumberOfLines();
  if (count == 0)
  {
    return;
  }
  this->Others = vtkSmartPointer<vtkPolyData>::New();
  this->Others->SetPoints(this->Input->GetPoints());
  this->Others->GetPointData()->ShallowCopy(this->Input->GetPointData());
  this->Others->SetVerts(this->Input->GetVerts());
  this->Others->SetLines(this->Input->GetLines());
  std::vector<vtkIdType> cells(static_cast<std::size_t>(count));
  for (vtkIdType k = 0; k < count; ++k)
  {
    cells[static_cast<std::size_t>(k)] = k;
  }
  vtkCellData* data = this->Others->GetCellData();
  data->CopyAllOn();
  data->CopyAllocate(this->Input->GetCellData(), count);
  CopyTuples(this->Input->GetCellData(), data, cells, 0);
}

void PartSurfaces::CutBorders(CellMaterials& cells)
{
  const ClassBorders borders(this->Input, this->Polygons, this->Cells, cells.GetPointClasses());
  cells.SetClasses(borders.GetClasses());
  this->Polygons->ShallowCopy(borders.GetPolygons());
  this->Cells = borders.GetCells();
  this->Input = borders.MakeSurface(this->Input);
}

bool PartSurfaces::SplitPolygons(const CellMaterials& cells, std::size_t most)
{
  const auto isCrowded = [&](vtkIdType polygon)
  {
    const int set = cells.GetSetOfPolygon()[static_cast<std::size_t>(polygon)];
    return cells.GetSets()[static_cast<std::size_t>(set)].size() > most;
  };
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> numbers;
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < this->Polygons->GetNumberOfCells(); ++k)
  {
    this->Polygons->GetCellAtId(k, corners);
    if (!isCrowded(k))
    {
      polygons->InsertNextCell(corners);
      numbers.push_back(this->Cells[static_cast<std::size_t>(k)]);
      continue;
    }
    for (vtkIdType c = 2; c < corners->GetNumberOfIds(); ++c) // as VTK draws it
    {
      const vtkIdType triangle[3] = { corners->GetId(0), corners->GetId(c - 1), corners->GetId(c) };
      polygons->InsertNextCell(3, triangle);
      numbers.push_back(this->Cells[static_cast<std::size_t>(k)]);
    }
  }
  const bool any = polygons->GetNumberOfCells() > this->Polygons->GetNumberOfCells();
  if (any)
  {
    this->Polygons->ShallowCopy(polygons);
    this->Cells = std::move(numbers);
  }
  return any;
}

std::map<vtkBRDF*, double> PartSurfaces::GetAreas(const CellMaterials& cells) const
{
  std::map<vtkBRDF*, double> areas;
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < this->Polygons->GetNumberOfCells(); ++k)
  {
    this->Polygons->GetCellAtId(k, corners);
    const vtkIdType count = corners->GetNumberOfIds();
    const vtkIdType* points = corners->GetPointer(0);
    const double area = GetArea(this->Input->GetPoints(), count, points);
    const int set = cells.GetSetOfPolygon()[static_cast<std::size_t>(k)];
    for (int material : cells.GetSets()[static_cast<std::size_t>(set)])
    {
      areas[cells.GetBRDFs()[static_cast<std::size_t>(material)]] +=
        area * cells.GetShare(k, count, points, material);
    }
  }
  return areas;
}

// Weights of a part are in the order of its own materials, so that a few of them suffice whatever
// the number of materials: a point has weights for one part. On a border between classes it has one
// weight, in a slot that may differ from polygon to polygon. A polygon's own value is that of its
// own corners.
void PartSurfaces::NumberCorners(const CellMaterials& cells, const PartSets& sets)
{
  const vtkIdType points = this->Input->GetNumberOfPoints();
  this->FirstOwners.assign(static_cast<std::size_t>(points), NoOwner);
  std::vector<std::unordered_map<vtkIdType, vtkIdType>> added(
    std::max(sets.Get().size(), PartSets::MaximumNumberOfSlots));
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < this->Polygons->GetNumberOfCells(); ++k)
  {
    this->Polygons->GetCellAtId(k, corners);
    // Bands do not differ in what they need.
    const int setOfCells = cells.GetSetOfPolygon()[static_cast<std::size_t>(k)];
    const auto set = static_cast<std::size_t>(sets.Find(setOfCells).front());
    const bool ofPolygon = !cells.GetPolygonValues().empty();
    const bool ofBorder = sets.IsBorder(set);
    const bool mixed =
      ofBorder || (sets.Get()[set].size() > 1 && (ofPolygon || cells.HasPointWeights()));
    std::size_t owner = ofPolygon ? static_cast<std::size_t>(k) : set;
    for (vtkIdType c = 0; c < corners->GetNumberOfIds(); ++c)
    {
      const vtkIdType point = corners->GetId(c);
      if (ofBorder)
      {
        owner = static_cast<std::size_t>(
          sets.FindSlot(setOfCells, cells.GetPointClasses()[static_cast<std::size_t>(point)]));
      }
      std::size_t& first = this->FirstOwners[static_cast<std::size_t>(point)];
      if (mixed && first == NoOwner)
      {
        first = owner;
      }
      if (!mixed || first == owner)
      {
        this->Corners.push_back(point);
        continue;
      }
      const vtkIdType next = points + static_cast<vtkIdType>(this->Originals.size());
      vtkIdType number = next;
      if (!ofPolygon)
      {
        number = added[owner].try_emplace(point, next).first->second;
      }
      if (number == next)
      {
        this->Originals.push_back(point);
        this->Owners.push_back(owner);
      }
      this->Corners.push_back(number);
    }
  }
}

void PartSurfaces::CopyPoints()
{
  vtkPointData* data = this->Base->GetPointData();
  if (this->Originals.empty())
  {
    this->Base->SetPoints(this->Input->GetPoints());
    data->ShallowCopy(this->Input->GetPointData());
    return;
  }
  const vtkIdType count = this->Input->GetNumberOfPoints();
  const vtkIdType total = count + static_cast<vtkIdType>(this->Originals.size());
  vtkNew<vtkPoints> points;
  points->SetDataType(this->Input->GetPoints()->GetDataType());
  points->GetData()->DeepCopy(this->Input->GetPoints()->GetData());
  points->GetData()->Resize(total);
  for (vtkIdType original : this->Originals)
  {
    points->InsertNextPoint(this->Input->GetPoint(original));
  }
  this->Base->SetPoints(points);
  std::vector<vtkIdType> tuples(static_cast<std::size_t>(count));
  for (vtkIdType p = 0; p < count; ++p)
  {
    tuples[static_cast<std::size_t>(p)] = p;
  }
  tuples.insert(tuples.end(), this->Originals.begin(), this->Originals.end());
  data->CopyAllOn();
  data->CopyAllocate(this->Input->GetPointData(), total);
  CopyTuples(this->Input->GetPointData(), data, tuples, 0);
}

void PartSurfaces::AddWeights(const CellMaterials& cells, const PartSets& sets)
{
  const bool ofClasses = !cells.GetPointClasses().empty();
  std::size_t most = static_cast<std::size_t>(sets.GetNumberOfSlots());
  for (const CellMaterials::Set& set : sets.Get())
  {
    most = std::max(most, set.size());
  }
  if (most < 2)
  {
    return;
  }
  const int groups = static_cast<int>(most + WeightsPerGroup - 1) / WeightsPerGroup;
  const vtkIdType points = this->Input->GetNumberOfPoints();
  for (int group = 0; group < groups; ++group)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(partarrays::GetWeights(group).c_str());
    array->SetNumberOfComponents(WeightsPerGroup);
    array->SetNumberOfTuples(this->Base->GetNumberOfPoints());
    array->FillValue(0.0f);
    for (vtkIdType p = 0; p < this->Base->GetNumberOfPoints(); ++p)
    {
      const auto k = static_cast<std::size_t>(p < points ? p : p - points);
      const std::size_t owner = p < points ? this->FirstOwners[k] : this->Owners[k];
      const vtkIdType original = p < points ? p : this->Originals[k];
      for (int c = 0; owner != NoOwner && c < WeightsPerGroup; ++c)
      {
        const int slot = WeightsPerGroup * group + c;
        if (ofClasses)
        {
          array->SetTypedComponent(p, c, owner == static_cast<std::size_t>(slot) ? 1.0f : 0.0f);
          continue;
        }
        const int material = cells.GetMember(sets.Get()[owner], slot);
        if (material >= 0)
        {
          array->SetTypedComponent(p, c, cells.GetWeight(original, material));
        }
      }
    }
    this->Base->GetPointData()->AddArray(array);
  }
}

void PartSurfaces::AddClasses(const CellMaterials& cells)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(partarrays::Class);
  const vtkIdType points = this->Input->GetNumberOfPoints();
  array->SetNumberOfTuples(this->Base->GetNumberOfPoints());
  for (vtkIdType p = 0; p < this->Base->GetNumberOfPoints(); ++p)
  {
    const vtkIdType original =
      p < points ? p : this->Originals[static_cast<std::size_t>(p - points)];
    array->SetValue(
      p, static_cast<float>(cells.GetPointClasses()[static_cast<std::size_t>(original)]));
  }
  this->Base->GetPointData()->AddArray(array);
}

void PartSurfaces::AddValues(const CellMaterials& cells)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(partarrays::Value);
  const vtkIdType points = this->Input->GetNumberOfPoints();
  array->SetNumberOfTuples(this->Base->GetNumberOfPoints());
  for (vtkIdType p = 0; p < this->Base->GetNumberOfPoints(); ++p)
  {
    const auto k = static_cast<std::size_t>(p < points ? p : p - points);
    float value = 0.0f;
    if (!cells.GetPointValues().empty())
    {
      value = cells.GetPointValues()[k];
    }
    else
    {
      const std::size_t owner = p < points ? this->FirstOwners[k] : this->Owners[k];
      value = owner == NoOwner ? 0.0f : cells.GetPolygonValues()[owner];
    }
    array->SetValue(p, value);
  }
  this->Base->GetPointData()->AddArray(array);
}

void PartSurfaces::AddCoordinates()
{
  vtkDataArray* coordinates = this->Base->GetPointData()->GetTCoords();
  const auto named = vtkSmartPointer<vtkDataArray>::Take(coordinates->NewInstance());
  named->ShallowCopy(coordinates);
  named->SetName(partarrays::Coordinates);
  this->Base->GetPointData()->AddArray(named);
}

void PartSurfaces::Distribute(const CellMaterials& cells, const PartSets& sets)
{
  this->NumberCorners(cells, sets);
  this->CopyPoints();
  if (cells.HasPointWeights())
  {
    this->AddWeights(cells, sets);
    if (sets.GetNumberOfSlots() > 0)
    {
      this->AddClasses(cells);
    }
  }
  else if (!cells.GetKnots().empty())
  {
    this->AddValues(cells);
  }
  else if (cells.HasImages())
  {
    this->AddCoordinates();
  }
  std::vector<std::vector<vtkIdType>> source(sets.Get().size()); // the input's cells
  this->PolygonsOf.resize(sets.Get().size());
  for (std::size_t k = 0; k < sets.Get().size(); ++k)
  {
    this->Surfaces.push_back(vtkSmartPointer<vtkPolyData>::New());
    this->Surfaces[k]->SetPoints(this->Base->GetPoints());
    this->Surfaces[k]->GetPointData()->ShallowCopy(this->Base->GetPointData());
    vtkNew<vtkCellArray> polygons;
    this->Surfaces[k]->SetPolys(polygons);
  }
  const vtkIdType* corner = this->Corners.data();
  for (vtkIdType k = 0; k < this->Polygons->GetNumberOfCells(); ++k)
  {
    const vtkIdType count = this->Polygons->GetCellSize(k);
    for (int place : sets.Find(cells.GetSetOfPolygon()[static_cast<std::size_t>(k)]))
    {
      const auto set = static_cast<std::size_t>(place);
      this->Surfaces[set]->GetPolys()->InsertNextCell(count, corner);
      source[set].push_back(this->Cells[static_cast<std::size_t>(k)]);
      this->PolygonsOf[set].push_back(k);
    }
    corner += count;
  }
  for (std::size_t k = 0; k < source.size(); ++k)
  {
    vtkCellData* data = this->Surfaces[k]->GetCellData();
    data->CopyAllOn();
    data->CopyAllocate(this->Input->GetCellData(), static_cast<vtkIdType>(source[k].size()));
    CopyTuples(this->Input->GetCellData(), data, source[k], 0);
    this->Surfaces[k]->GetFieldData()->ShallowCopy(this->Input->GetFieldData());
  }
}
} // namespace measuredbrdf
