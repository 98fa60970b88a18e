// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshNormals.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataNormals.h"
#include "vtkStaticPointLocator.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace
{
//------------------------------------------------------------------------------
// For each point the first one at its place.
std::vector<vtkIdType> FindPlaces(vtkPolyData* mesh)
{
  std::vector<vtkIdType> places(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();
  locator->MergePoints(0.0, places.data());
  return places;
}

//------------------------------------------------------------------------------
// The polygons over the places, with normals of points.
vtkSmartPointer<vtkPolyData> MakeNormals(
  vtkPolyData* mesh, const std::vector<vtkIdType>& places, vtkPolyDataNormals* normals)
{
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> ids;
  for (vtkIdType k = 0; k < mesh->GetNumberOfPolys(); ++k)
  {
    mesh->GetPolys()->GetCellAtId(k, ids);
    for (vtkIdType n = 0; n < ids->GetNumberOfIds(); ++n)
    {
      ids->SetId(n, places[static_cast<std::size_t>(ids->GetId(n))]);
    }
    polygons->InsertNextCell(ids);
  }
  vtkNew<vtkPolyData> welded;
  welded->SetPoints(mesh->GetPoints());
  welded->SetPolys(polygons);
  normals->SetInputData(welded);
  normals->Update();
  return normals->GetOutput();
}

//------------------------------------------------------------------------------
bool IsDirection(const double n[3])
{
  const double length = vtkMath::Norm(n);
  return std::isfinite(length) && length > 0.0;
}
}

namespace tool
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> AddNormals(vtkPolyData* mesh, double featureAngle)
{
  const std::vector<vtkIdType> places = FindPlaces(mesh);
  vtkNew<vtkPolyDataNormals> filter;
  filter->SetFeatureAngle(featureAngle);
  const vtkSmartPointer<vtkPolyData> smooth = MakeNormals(mesh, places, filter);
  vtkDataArray* normals = smooth->GetPointData()->GetNormals();
  if (!normals || smooth->GetNumberOfPolys() != mesh->GetNumberOfPolys())
  {
    return mesh;
  }

  // A corner has its point's data and its place's normal: a point for each pair of these.
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(mesh->GetPoints()->GetDataType());
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkFloatArray> directions;
  directions->SetName("Normals");
  directions->SetNumberOfComponents(3);
  vtkPointData* data = result->GetPointData();
  data->CopyAllocate(mesh->GetPointData(), mesh->GetNumberOfPoints());
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> made;
  vtkNew<vtkIdList> before;
  vtkNew<vtkIdList> after;
  for (vtkIdType k = 0; k < mesh->GetNumberOfPolys(); ++k)
  {
    mesh->GetPolys()->GetCellAtId(k, before);
    smooth->GetPolys()->GetCellAtId(k, after); // may be turned around
    for (vtkIdType n = 0; n < after->GetNumberOfIds(); ++n)
    {
      const vtkIdType split = after->GetId(n);
      double place[3];
      smooth->GetPoint(split, place);
      vtkIdType own = before->GetId(n);
      for (vtkIdType m = 0; m < before->GetNumberOfIds(); ++m)
      {
        double p[3];
        mesh->GetPoint(before->GetId(m), p);
        own = p[0] == place[0] && p[1] == place[1] && p[2] == place[2] ? before->GetId(m) : own;
      }
      const auto [it, isNew] =
        made.emplace(std::make_pair(own, split), points->GetNumberOfPoints());
      if (isNew)
      {
        points->InsertNextPoint(place);
        directions->InsertNextTuple(normals->GetTuple(split));
        data->CopyData(mesh->GetPointData(), own, it->second);
      }
      after->SetId(n, it->second);
    }
    polygons->InsertNextCell(after);
  }
  result->SetPoints(points);
  result->SetPolys(polygons);
  result->GetCellData()->ShallowCopy(mesh->GetCellData());
  data->SetNormals(directions);
  return result;
}

//------------------------------------------------------------------------------
vtkIdType RepairNormals(vtkPolyData* mesh)
{
  vtkDataArray* given = mesh->GetPointData()->GetNormals();
  std::vector<vtkIdType> bad;
  for (vtkIdType k = 0; given && k < mesh->GetNumberOfPoints(); ++k)
  {
    double n[3];
    given->GetTuple(k, n);
    if (!IsDirection(n))
    {
      bad.push_back(k);
    }
  }
  if (bad.empty())
  {
    return 0;
  }
  const std::vector<vtkIdType> places = FindPlaces(mesh);
  vtkNew<vtkPolyDataNormals> filter;
  filter->SplittingOff();
  filter->ConsistencyOff();
  const vtkSmartPointer<vtkPolyData> smooth = MakeNormals(mesh, places, filter);
  vtkDataArray* computed = smooth->GetPointData()->GetNormals();
  const auto compute = [&](vtkIdType point, double n[3])
  {
    computed->GetTuple(places[static_cast<std::size_t>(point)], n);
    return IsDirection(n);
  };
  double agreement = 0.0; // below 0: the file's normals turn to the other side
  for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k)
  {
    double n[3];
    double m[3];
    given->GetTuple(k, n);
    agreement += IsDirection(n) && compute(k, m) ? (vtkMath::Dot(n, m) > 0.0 ? 1.0 : -1.0) : 0.0;
  }
  vtkNew<vtkFloatArray> repaired;
  repaired->DeepCopy(given);
  repaired->SetName(given->GetName());
  for (const vtkIdType k : bad)
  {
    double n[3] = { 0.0, 0.0, 1.0 };
    if (compute(k, n))
    {
      vtkMath::MultiplyScalar(n, agreement < 0.0 ? -1.0 : 1.0);
    }
    else
    {
      n[0] = n[1] = 0.0; // of no polygon with an area
      n[2] = 1.0;
    }
    repaired->SetTuple(k, n);
  }
  mesh->GetPointData()->SetNormals(repaired);
  return static_cast<vtkIdType>(bad.size());
}
} // namespace tool
