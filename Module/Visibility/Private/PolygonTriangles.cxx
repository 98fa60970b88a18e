// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonTriangles.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolygon.h"

#include <glm/glm.hpp>

namespace measuredbrdf
{
namespace
{
glm::dvec3 GetPosition(vtkPolyData* surface, vtkIdType point)
{
  glm::dvec3 p;
  surface->GetPoint(point, &p.x);
  return p;
}
}

void TriangulatePolygon(
  vtkPolyData* surface, vtkIdType count, const vtkIdType* corners, std::vector<vtkIdType>& result)
{
  result.clear();
  if (count == 3)
  {
    result.assign(corners, corners + 3);
    return;
  }
  if (count == 4)
  {
    glm::dvec3 p[4];
    for (int k = 0; k < 4; ++k)
    {
      p[k] = GetPosition(surface, corners[k]);
    }
    for (int k = 0; k < 2; ++k) // the cut from k to k + 2
    {
      const glm::dvec3 cut = p[k + 2] - p[k];
      const glm::dvec3 one = glm::cross(p[k + 1] - p[k], cut);
      const glm::dvec3 other = glm::cross(cut, p[(k + 3) % 4] - p[k]);
      if (glm::dot(one, other) >= 0.0)
      {
        result = { corners[k], corners[k + 1], corners[k + 2], corners[k], corners[k + 2],
          corners[(k + 3) % 4] };
        return;
      }
    }
  }
  vtkNew<vtkPolygon> polygon;
  polygon->GetPoints()->SetDataTypeToDouble();
  polygon->GetPoints()->SetNumberOfPoints(count);
  polygon->GetPointIds()->SetNumberOfIds(count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    const glm::dvec3 position = GetPosition(surface, corners[k]);
    polygon->GetPoints()->SetPoint(k, &position.x);
    polygon->GetPointIds()->SetId(k, corners[k]);
  }
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  vtkCell* cell = polygon;
  if (cell->Triangulate(0, ids, points) && ids->GetNumberOfIds() % 3 == 0)
  {
    result.assign(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds());
  }
  if (result.empty()) // a polygon that crosses itself, or has no plane
  {
    for (vtkIdType k = 2; k < count; ++k)
    {
      result.insert(result.end(), { corners[0], corners[k - 1], corners[k] });
    }
  }
}
} // namespace measuredbrdf
