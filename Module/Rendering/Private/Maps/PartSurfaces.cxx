// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartSurfaces.h"

#include "ClassBorders.h"
#include "MaterialPartition.h"
#include "PolygonMaterials.h"
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
#include <numeric>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t NoOwner = std::numeric_limits<std::size_t>::max();
using partarrays::WeightsPerGroup;

double GetArea(vtkPoints* points, vtkIdList* corners)
{
  glm::dvec3 first;
  glm::dvec3 last;
  glm::dvec3 next;
  glm::dvec3 normal(0.0);
  for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
  {
    points->GetPoint(corners->GetId(k), &next.x);
    if (k == 0)
    {
      first = next;
    }
    normal += k > 1 ? glm::cross(last - first, next - first) : glm::dvec3(0.0);
    last = next;
  }
  return 0.5 * glm::length(normal);
}

// Copies these rows of all arrays, also of those that VTK leaves out by default.
template <typename Attributes>
void CopyTuples(Attributes* from, Attributes* to, const std::vector<vtkIdType>& tuples)
{
  const auto count = static_cast<vtkIdType>(tuples.size());
  vtkNew<vtkIdList> source;
  vtkNew<vtkIdList> target;
  source->SetNumberOfIds(count);
  target->SetNumberOfIds(count);
  std::copy(tuples.begin(), tuples.end(), source->begin());
  std::iota(target->begin(), target->end(), 0);
  to->CopyAllOn();
  to->CopyAllocate(from, count);
  to->CopyData(from, source, target);
}
}

PartSurfaces::PartSurfaces(vtkPolyData* input)
  : Input(input)
{
  this->Polygons->DeepCopy(input->GetPolys());
  vtkIdType cell = input->GetNumberOfVerts() + input->GetNumberOfLines();
  this->Cells.resize(static_cast<std::size_t>(input->GetNumberOfPolys()));
  std::iota(this->Cells.begin(), this->Cells.end(), cell);
  cell += input->GetNumberOfPolys();
  vtkNew<vtkIdList> strip;
  for (vtkIdType k = 0; k < input->GetNumberOfStrips(); ++k)
  {
    input->GetStrips()->GetCellAtId(k, strip);
    for (vtkIdType c = 0; c + 2 < strip->GetNumberOfIds(); ++c) // none of fewer than 3 ids
    {
      this->Polygons->InsertNextCell(
        { strip->GetId(c), strip->GetId(c + 1 + c % 2), strip->GetId(c + 2 - c % 2) });
      this->Cells.push_back(cell + k);
    }
  }
}

PartSurfaces::~PartSurfaces() = default;

vtkSmartPointer<vtkPolyData> PartSurfaces::MakeVerticesAndLines() const
{
  const vtkIdType count = this->Input->GetNumberOfVerts() + this->Input->GetNumberOfLines();
  if (count == 0)
  {
    return nullptr;
  }
  auto others = vtkSmartPointer<vtkPolyData>::New();
  others->SetPoints(this->Input->GetPoints());
  others->GetPointData()->ShallowCopy(this->Input->GetPointData());
  others->SetVerts(this->Input->GetVerts());
  others->SetLines(this->Input->GetLines());
  std::vector<vtkIdType> cells(static_cast<std::size_t>(count));
  std::iota(cells.begin(), cells.end(), 0);
  CopyTuples(this->Input->GetCellData(), others->GetCellData(), cells);
  return others;
}

void PartSurfaces::CutBorders(PolygonMaterials& materials)
{
  ClassBorders borders(this->Input, this->Polygons, this->Cells, materials.PointClasses);
  this->Polygons->ShallowCopy(borders.Polygons);
  this->Cells = std::move(borders.Cells);
  this->Input = borders.MakeSurface(this->Input);
  materials.SetClasses(borders.ClassOfPolygon);
}

bool PartSurfaces::SplitPolygons(const PolygonMaterials& materials, std::size_t most)
{
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> cells;
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < this->Polygons->GetNumberOfCells(); ++k)
  {
    this->Polygons->GetCellAtId(k, corners);
    if (materials.GetSet(k).size() <= most)
    {
      polygons->InsertNextCell(corners);
    }
    else
    {
      for (vtkIdType c = 2; c < corners->GetNumberOfIds(); ++c) // as VTK draws it
      {
        polygons->InsertNextCell({ corners->GetId(0), corners->GetId(c - 1), corners->GetId(c) });
      }
    }
    cells.resize(static_cast<std::size_t>(polygons->GetNumberOfCells()),
      this->Cells[static_cast<std::size_t>(k)]);
  }
  const bool any = polygons->GetNumberOfCells() > this->Polygons->GetNumberOfCells();
  if (any)
  {
    this->Polygons->ShallowCopy(polygons);
    this->Cells = std::move(cells);
  }
  return any;
}

std::map<vtkBRDF*, double> PartSurfaces::GetAreas(const PolygonMaterials& materials) const
{
  std::map<vtkBRDF*, double> areas;
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < this->Polygons->GetNumberOfCells(); ++k)
  {
    this->Polygons->GetCellAtId(k, corners);
    const double area = GetArea(this->Input->GetPoints(), corners);
    for (int material : materials.GetSet(k))
    {
      areas[materials.BRDFs[static_cast<std::size_t>(material)]] +=
        area * materials.GetShare(k, corners->GetNumberOfIds(), corners->GetPointer(0), material);
    }
  }
  return areas;
}

// Weights of a part are in the order of its own materials, so that a few of them suffice whatever
// the number of materials: a point has weights for one part. On a border between classes it has one
// weight, in a slot that may differ from polygon to polygon. A polygon's own value is that of its
// own corners.
void PartSurfaces::NumberCorners(
  const PolygonMaterials& materials, const MaterialPartition& partition)
{
  const auto points = static_cast<std::size_t>(this->Input->GetNumberOfPoints());
  this->Originals.resize(points);
  std::iota(this->Originals.begin(), this->Originals.end(), 0);
  this->Owners.assign(points, NoOwner);
  const bool ofPolygon = !materials.PolygonValues.empty();
  std::map<std::pair<vtkIdType, std::size_t>, vtkIdType> added; // of a point and an owner
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < this->Polygons->GetNumberOfCells(); ++k)
  {
    this->Polygons->GetCellAtId(k, corners);
    const auto set = static_cast<std::size_t>(materials.SetOfPolygon[static_cast<std::size_t>(k)]);
    // Bands do not differ in what they need.
    const auto place = static_cast<std::size_t>(partition.GroupsOf[set].front());
    const MaterialPartition::Group& group = partition.Groups[place];
    const bool ofBorder = group.Slot >= 0;
    const bool mixed =
      ofBorder || (group.Materials.size() > 1 && (ofPolygon || materials.HasPointWeights()));
    for (vtkIdType point : *corners)
    {
      std::size_t owner = ofPolygon ? static_cast<std::size_t>(k) : place;
      if (ofBorder)
      {
        const int cls = materials.PointClasses[static_cast<std::size_t>(point)];
        owner = static_cast<std::size_t>(partition.SlotOfClass[set].at(cls));
      }
      std::size_t& first = this->Owners[static_cast<std::size_t>(point)];
      if (mixed && first == NoOwner)
      {
        first = owner;
      }
      vtkIdType number = point;
      if (mixed && first != owner)
      {
        const auto next = static_cast<vtkIdType>(this->Originals.size());
        number = ofPolygon ? next : added.try_emplace({ point, owner }, next).first->second;
        if (number == next)
        {
          this->Originals.push_back(point);
          this->Owners.push_back(owner);
        }
      }
      this->Corners.push_back(number);
    }
  }
}

void PartSurfaces::CopyPoints()
{
  vtkPointData* data = this->Base->GetPointData();
  if (static_cast<vtkIdType>(this->Originals.size()) == this->Input->GetNumberOfPoints())
  {
    this->Base->SetPoints(this->Input->GetPoints());
    data->ShallowCopy(this->Input->GetPointData());
    return;
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(this->Input->GetPoints()->GetDataType());
  points->Allocate(static_cast<vtkIdType>(this->Originals.size()));
  for (vtkIdType original : this->Originals)
  {
    points->InsertNextPoint(this->Input->GetPoint(original));
  }
  this->Base->SetPoints(points);
  CopyTuples(this->Input->GetPointData(), data, this->Originals);
}

void PartSurfaces::AddWeights(const PolygonMaterials& materials, const MaterialPartition& partition)
{
  const bool ofClasses = !materials.PointClasses.empty();
  auto most = static_cast<std::size_t>(partition.NumberOfSlots);
  for (const MaterialPartition::Group& group : partition.Groups)
  {
    most = std::max(most, group.Materials.size());
  }
  const std::size_t groupSize = WeightsPerGroup;
  for (std::size_t begin = 0; begin < most && most > 1; begin += groupSize)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(partarrays::GetWeights(static_cast<int>(begin / groupSize)).c_str());
    array->SetNumberOfComponents(WeightsPerGroup);
    array->SetNumberOfTuples(this->Base->GetNumberOfPoints());
    array->FillValue(0.0f);
    for (std::size_t p = 0; p < this->Owners.size(); ++p)
    {
      const std::size_t owner = this->Owners[p];
      for (std::size_t slot = begin; owner != NoOwner && slot < begin + groupSize; ++slot)
      {
        float weight = ofClasses && owner == slot ? 1.0f : 0.0f;
        if (!ofClasses && slot < partition.Groups[owner].Materials.size())
        {
          weight = materials.GetWeight(this->Originals[p], partition.Groups[owner].Materials[slot]);
        }
        array->SetTypedComponent(static_cast<vtkIdType>(p), static_cast<int>(slot - begin), weight);
      }
    }
    this->Base->GetPointData()->AddArray(array);
  }
}

void PartSurfaces::AddValues(const PolygonMaterials& materials)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(partarrays::Value);
  for (std::size_t p = 0; p < this->Owners.size(); ++p)
  {
    const std::size_t owner = this->Owners[p];
    array->InsertNextValue(!materials.PointValues.empty()
                             ? materials.PointValues[static_cast<std::size_t>(this->Originals[p])]
                             : (owner == NoOwner ? 0.0f : materials.PolygonValues[owner]));
  }
  this->Base->GetPointData()->AddArray(array);
}

std::vector<vtkSmartPointer<vtkPolyData>> PartSurfaces::Distribute(
  const PolygonMaterials& materials, const MaterialPartition& partition)
{
  this->NumberCorners(materials, partition);
  this->CopyPoints();
  if (materials.HasPointWeights())
  {
    this->AddWeights(materials, partition);
  }
  else if (!materials.Knots.empty())
  {
    this->AddValues(materials);
  }
  else if (!materials.ImageShares.empty())
  {
    vtkDataArray* coordinates = this->Base->GetPointData()->GetTCoords();
    const auto named = vtkSmartPointer<vtkDataArray>::Take(coordinates->NewInstance());
    named->ShallowCopy(coordinates);
    named->SetName(partarrays::Coordinates);
    this->Base->GetPointData()->AddArray(named);
  }
  const std::size_t groups = partition.Groups.size();
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  for (std::size_t k = 0; k < groups; ++k)
  {
    surfaces.push_back(vtkSmartPointer<vtkPolyData>::New());
    surfaces[k]->SetPoints(this->Base->GetPoints());
    surfaces[k]->GetPointData()->ShallowCopy(this->Base->GetPointData());
    surfaces[k]->SetPolys(vtkNew<vtkCellArray>());
  }
  std::vector<std::vector<vtkIdType>> source(groups); // the input's cells
  const vtkIdType* corner = this->Corners.data();
  for (std::size_t k = 0; k < this->Cells.size(); ++k)
  {
    const vtkIdType count = this->Polygons->GetCellSize(static_cast<vtkIdType>(k));
    const auto set = static_cast<std::size_t>(materials.SetOfPolygon[k]);
    for (int group : partition.GroupsOf[set])
    {
      const auto place = static_cast<std::size_t>(group);
      surfaces[place]->GetPolys()->InsertNextCell(count, corner);
      source[place].push_back(this->Cells[k]);
    }
    corner += count;
  }
  for (std::size_t k = 0; k < groups; ++k)
  {
    CopyTuples(this->Input->GetCellData(), surfaces[k]->GetCellData(), source[k]);
    surfaces[k]->GetFieldData()->ShallowCopy(this->Input->GetFieldData());
  }
  return surfaces;
}
} // namespace measuredbrdf
