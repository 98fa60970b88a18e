// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassBorders.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
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
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < polygons->GetNumberOfCells(); ++k)
  {
    polygons->GetCellAtId(k, corners);
    const std::vector<vtkIdType> polygon(corners->begin(), corners->end());
    const vtkIdType cell = cells[static_cast<std::size_t>(k)];
    const int cls = polygon.empty() ? 0 : this->GetClass(polygon.front());
    if (std::all_of(polygon.begin(), polygon.end(),
          [&](vtkIdType point) { return this->GetClass(point) == cls; }))
    {
      this->AddPiece(cell, polygon, cls);
      continue;
    }
    for (std::size_t c = 2; c < polygon.size(); ++c)
    {
      this->Cut(cell, { polygon[0], polygon[c - 1], polygon[c] });
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

void ClassBorders::AddPiece(vtkIdType cell, const std::vector<vtkIdType>& corners, int cls)
{
  this->Polygons->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  this->Cells.push_back(cell);
  this->ClassOfPolygon.push_back(cls);
}

void ClassBorders::Cut(vtkIdType cell, const Parents& triangle)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    const vtkIdType a = triangle[k];
    const vtkIdType b = triangle[(k + 1) % 3];
    const vtkIdType other = triangle[(k + 2) % 3];
    const int cls = this->GetClass(a);
    if (this->GetClass(b) == cls)
    {
      if (this->GetClass(other) == cls)
      {
        this->AddPiece(cell, { a, b, other }, cls);
        return;
      }
      const vtkIdType toB = this->FindMiddle(b, other);
      const vtkIdType toA = this->FindMiddle(other, a);
      this->AddPiece(cell, { other, toA, toB }, this->GetClass(other));
      this->AddPiece(cell, { a, b, toB, toA }, cls);
      return;
    }
  }
  const vtkIdType center = this->AddPoint(triangle);
  for (std::size_t k = 0; k < 3; ++k)
  {
    const vtkIdType corner = triangle[k];
    const vtkIdType next = this->FindMiddle(corner, triangle[(k + 1) % 3]);
    const vtkIdType last = this->FindMiddle(triangle[(k + 2) % 3], corner);
    this->AddPiece(cell, { corner, next, center, last }, this->GetClass(corner));
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
