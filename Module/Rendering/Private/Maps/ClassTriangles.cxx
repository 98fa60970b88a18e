// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassTriangles.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstddef>

namespace measuredbrdf
{
vtkSmartPointer<vtkPolyData> JoinCells(const std::vector<vtkPolyData*>& surfaces)
{
  auto whole = vtkSmartPointer<vtkPolyData>::New();
  whole->SetPoints(surfaces.front()->GetPoints());
  whole->GetPointData()->ShallowCopy(surfaces.front()->GetPointData());
  whole->GetFieldData()->ShallowCopy(surfaces.front()->GetFieldData());
  vtkIdType count = 0;
  for (vtkPolyData* surface : surfaces)
  {
    count += surface->GetNumberOfCells();
  }
  vtkNew<vtkCellArray> polygons;
  vtkCellData* data = whole->GetCellData();
  data->CopyAllOn();
  data->CopyAllocate(surfaces.front()->GetCellData(), count);
  for (vtkPolyData* surface : surfaces)
  {
    data->CopyData(
      surface->GetCellData(), polygons->GetNumberOfCells(), surface->GetNumberOfCells(), 0);
    polygons->Append(surface->GetPolys(), 0);
  }
  whole->SetPolys(polygons);
  return whole;
}

//------------------------------------------------------------------------------
std::vector<unsigned int> GetTriangles(vtkPolyData* surface, const PolygonChoice& isDrawn)
{
  vtkNew<vtkCellArray> drawn;
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < surface->GetNumberOfPolys(); ++k)
  {
    if (isDrawn(k))
    {
      surface->GetPolys()->GetCellAtId(k, corners);
      drawn->InsertNextCell(corners);
    }
  }
  std::vector<unsigned int> triangles;
  vtkOpenGLIndexBufferObject::AppendTriangleIndexBuffer(
    triangles, drawn, surface->GetPoints(), 0, nullptr, nullptr);
  return triangles;
}

//------------------------------------------------------------------------------
std::vector<unsigned int> GetNumberedTriangles(vtkPolyData* surface, const PolygonChoice& isDrawn)
{
  std::vector<unsigned int> triangles;
  vtkOpenGLIndexBufferObject::AppendTriangleIndexBuffer(
    triangles, surface->GetPolys(), surface->GetPoints(), 0, nullptr, nullptr);
  std::size_t next = 0;
  std::size_t end = 0; // of those that are drawn
  for (vtkIdType k = 0; k < surface->GetNumberOfPolys(); ++k)
  {
    const std::size_t first = next;
    next += 3 * static_cast<std::size_t>(surface->GetPolys()->GetCellSize(k) - 2);
    if (isDrawn(k))
    {
      end = next;
      continue;
    }
    std::fill(triangles.begin() + static_cast<std::ptrdiff_t>(first),
      triangles.begin() + static_cast<std::ptrdiff_t>(next), 0u);
  }
  triangles.resize(end);
  return triangles;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkOpenGLIndexBufferObject> MakeIndices(std::vector<unsigned int> triangles)
{
  auto indices = vtkSmartPointer<vtkOpenGLIndexBufferObject>::New();
  indices->IndexCount = triangles.size();
  if (!triangles.empty())
  {
    indices->Upload(triangles, vtkOpenGLIndexBufferObject::ElementArrayBuffer);
  }
  return indices;
}

//------------------------------------------------------------------------------
int CountTriangles(vtkPolyData* surface)
{
  std::vector<unsigned int> triangles;
  vtkOpenGLIndexBufferObject::AppendTriangleIndexBuffer(
    triangles, surface->GetPolys(), surface->GetPoints(), 0, nullptr, nullptr);
  return static_cast<int>(triangles.size() / 3);
}
} // namespace measuredbrdf
