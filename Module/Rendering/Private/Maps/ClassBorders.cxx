// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassBorders.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// What drawing reads of points, besides their positions.
constexpr int Drawn[] = { vtkDataSetAttributes::NORMALS, vtkDataSetAttributes::TANGENTS,
  vtkDataSetAttributes::TCOORDS };

bool IsReal(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

// Its tuples, then the mean of each new point's parents.
vtkSmartPointer<vtkDataArray> Extend(
  vtkDataArray* from, const std::vector<std::array<vtkIdType, 3>>& newPoints)
{
  const auto to = vtkSmartPointer<vtkDataArray>::Take(from->NewInstance());
  const vtkIdType first = from->GetNumberOfTuples();
  const int components = from->GetNumberOfComponents();
  to->SetName(from->GetName());
  to->SetNumberOfComponents(components);
  to->SetNumberOfTuples(first + static_cast<vtkIdType>(newPoints.size()));
  to->InsertTuples(0, first, 0, from);
  for (std::size_t k = 0; k < newPoints.size(); ++k)
  {
    const auto& [a, b, c] = newPoints[k];
    for (int j = 0; j < components; ++j)
    {
      const double sum = from->GetComponent(a, j) + from->GetComponent(b, j);
      to->SetComponent(first + static_cast<vtkIdType>(k), j,
        c < 0 ? 0.5 * sum : (sum + from->GetComponent(c, j)) / 3.0);
    }
  }
  return to;
}
}

bool ClassBorders::CanInterpolate(vtkPolyData* surface)
{
  return IsReal(surface->GetPoints()->GetData()) &&
         std::all_of(std::begin(Drawn), std::end(Drawn),
           [surface](int attribute)
           {
             vtkAbstractArray* array = surface->GetPointData()->GetAbstractAttribute(attribute);
             auto* numbers = vtkDataArray::SafeDownCast(array);
             return !array || (numbers && IsReal(numbers) &&
                                numbers->GetNumberOfTuples() == surface->GetNumberOfPoints());
           });
}

ClassBorders::ClassBorders(vtkPolyData* surface, vtkCellArray* polygons,
  const std::vector<vtkIdType>& cells, const std::vector<int>& classes)
  : Classes(classes)
  , FirstNew(surface->GetNumberOfPoints())
{
  const auto it = vtkSmartPointer<vtkCellArrayIterator>::Take(polygons->NewIterator());
  for (it->GoToFirstCell(); !it->IsDoneWithTraversal(); it->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    it->GetCurrentCell(count, corners);
    this->Cell = cells[static_cast<std::size_t>(it->GetCurrentCellId())];
    const int cls = count > 0 ? this->GetClass(corners[0]) : 0;
    const bool whole = std::all_of(
      corners, corners + count, [&](vtkIdType point) { return this->GetClass(point) == cls; });
    if (whole)
    {
      this->AddPiece(count, corners, cls);
    }
    for (vtkIdType c = 2; c < count && !whole; ++c)
    {
      this->Cut({ corners[0], corners[c - 1], corners[c] });
    }
  }
}

ClassBorders::~ClassBorders() = default;

vtkIdType ClassBorders::AddPoint(const Parents& parents)
{
  this->NewPoints.push_back(parents);
  return this->FirstNew + static_cast<vtkIdType>(this->NewPoints.size()) - 1;
}

vtkIdType ClassBorders::FindMiddle(vtkIdType a, vtkIdType b)
{
  const long long edge = static_cast<long long>(std::min(a, b)) * this->FirstNew + std::max(a, b);
  const auto [place, isNew] = this->Middles.try_emplace(edge, 0);
  if (isNew)
  {
    place->second = this->AddPoint({ a, b, -1 });
  }
  return place->second;
}

void ClassBorders::AddPiece(vtkIdType count, const vtkIdType* corners, int cls)
{
  this->Polygons->InsertNextCell(count, corners);
  this->Cells.push_back(this->Cell);
  this->ClassOfPolygon.push_back(cls);
}

void ClassBorders::Cut(const Parents& triangle)
{
  bool differs[3]; // a corner from the next one
  std::size_t last = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    differs[k] = this->GetClass(triangle[k]) != this->GetClass(triangle[(k + 1) % 3]);
    last = differs[k] ? last : k;
  }
  const auto count = std::count(differs, differs + 3, true);
  if (count == 0)
  {
    this->AddPiece(3, triangle.data(), this->GetClass(triangle[0]));
    return;
  }
  if (count == 2) // one corner is alone: the one that is not on the edge of one class
  {
    const vtkIdType a = triangle[last];
    const vtkIdType b = triangle[(last + 1) % 3];
    const vtkIdType alone = triangle[(last + 2) % 3];
    const vtkIdType toB = this->FindMiddle(b, alone);
    const vtkIdType toA = this->FindMiddle(alone, a);
    const vtkIdType tip[3] = { alone, toA, toB };
    const vtkIdType rest[4] = { a, b, toB, toA };
    this->AddPiece(3, tip, this->GetClass(alone));
    this->AddPiece(4, rest, this->GetClass(a));
    return;
  }
  const vtkIdType center = this->AddPoint(triangle);
  for (std::size_t k = 0; k < 3; ++k)
  {
    const vtkIdType corner = triangle[k];
    const vtkIdType piece[4] = { corner, this->FindMiddle(corner, triangle[(k + 1) % 3]), center,
      this->FindMiddle(triangle[(k + 2) % 3], corner) };
    this->AddPiece(4, piece, this->GetClass(corner));
  }
}

vtkSmartPointer<vtkPolyData> ClassBorders::MakeSurface(vtkPolyData* surface) const
{
  auto cut = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(Extend(surface->GetPoints()->GetData(), this->NewPoints));
  cut->SetPoints(points);
  for (int attribute : Drawn)
  {
    if (vtkDataArray* array = surface->GetPointData()->GetAttribute(attribute))
    {
      cut->GetPointData()->SetAttribute(Extend(array, this->NewPoints), attribute);
    }
  }
  cut->GetCellData()->ShallowCopy(surface->GetCellData());
  cut->GetFieldData()->ShallowCopy(surface->GetFieldData());
  return cut;
}
} // namespace measuredbrdf
