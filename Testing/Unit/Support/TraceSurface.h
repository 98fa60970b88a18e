// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Surfaces with the arrays of vtkSurfaceVisibilityFilter, and what these hold.
 */

#ifndef TraceSurface_h
#define TraceSurface_h

#include "HorizonCode.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkUnsignedCharArray.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <string>
#include <vector>

inline vtkSmartPointer<vtkPolyData> MakeSurface(
  const std::vector<glm::dvec3>& points, const std::vector<std::vector<vtkIdType>>& polygons)
{
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  for (const glm::dvec3& p : points)
  {
    positions->InsertNextPoint(&p.x);
  }
  vtkNew<vtkCellArray> cells;
  for (const std::vector<vtkIdType>& polygon : polygons)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(polygon.size()), polygon.data());
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(positions);
  surface->SetPolys(cells);
  return surface;
}

/// nullptr where the filter refuses or gives blocks.
inline vtkPolyData* Trace(vtkSurfaceVisibilityFilter* filter, vtkDataObject* input)
{
  filter->SetInputDataObject(input);
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

inline vtkUnsignedCharArray* GetBytes(vtkPolyData* surface, const std::string& name)
{
  return vtkUnsignedCharArray::SafeDownCast(surface->GetPointData()->GetArray(name.c_str()));
}

inline measuredbrdf::HorizonCode::Code GetCode(
  vtkPolyData* surface, vtkIdType point, const std::string& suffix = "")
{
  using measuredbrdf::HorizonCode;
  HorizonCode::Code code;
  std::copy_n(GetBytes(surface, vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName() + suffix)
                ->GetPointer(point * HorizonCode::SectorBytes),
    HorizonCode::SectorBytes, code.begin());
  std::copy_n(GetBytes(surface, vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() + suffix)
                ->GetPointer(point * HorizonCode::TransferBytes),
    HorizonCode::TransferBytes, code.begin() + HorizonCode::SectorBytes);
  return code;
}

#endif
