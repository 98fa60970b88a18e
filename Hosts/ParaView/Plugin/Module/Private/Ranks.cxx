// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks.h"

#include "vtkAppendPolyData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkNew.h"

#include <cstddef>

namespace measuredmaterials
{
vtkMultiProcessController* GetController()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

std::vector<vtkPolyData*> GetSurfaces(vtkDataObject* data)
{
  std::vector<vtkPolyData*> surfaces;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      if (auto* block = vtkPolyData::SafeDownCast(it->GetCurrentDataObject()))
      {
        surfaces.push_back(block);
      }
    }
  }
  else if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    surfaces.push_back(surface);
  }
  return surfaces;
}

std::vector<vtkSmartPointer<vtkPolyData>> GatherOthers(
  const std::vector<vtkPolyData*>& own, vtkMultiProcessController* controller)
{
  vtkNew<vtkAppendPolyData> append;
  for (vtkPolyData* surface : own)
  {
    vtkNew<vtkPolyData> polygons;
    polygons->SetPoints(surface->GetPoints());
    polygons->SetPolys(surface->GetPolys());
    polygons->SetStrips(surface->GetStrips());
    append->AddInputData(polygons);
  }
  vtkNew<vtkPolyData> sent;
  if (!own.empty())
  {
    append->Update();
    sent->ShallowCopy(append->GetOutput());
  }
  std::vector<vtkSmartPointer<vtkDataObject>> received;
  controller->AllGather(sent, received);
  std::vector<vtkSmartPointer<vtkPolyData>> others;
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    auto* surface = vtkPolyData::SafeDownCast(received[rank]);
    const bool isOwn = static_cast<int>(rank) == controller->GetLocalProcessId();
    if (surface && !isOwn && surface->GetNumberOfCells() > 0)
    {
      others.emplace_back(surface);
    }
  }
  return others;
}
} // namespace measuredmaterials
