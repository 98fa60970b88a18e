// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <algorithm>
#include <charconv>
#include <cstddef>

namespace measuredmaterials
{
namespace
{
// Of the message with what rays meet, at most: vtkCommunicator sends VTK's binary file format.
vtkIdType CountBytes(const std::vector<vtkPolyData*>& surfaces)
{
  constexpr vtkIdType header = 4096;
  constexpr vtkIdType id = 8;
  vtkIdType points = 0;
  vtkIdType numbers = 0;
  vtkIdType coordinate = 0;
  for (vtkPolyData* surface : surfaces)
  {
    points += surface->GetNumberOfPoints();
    if (surface->GetPoints())
    {
      coordinate = std::max<vtkIdType>(
        coordinate, surface->GetPoints()->GetData()->GetDataTypeSize()); // one for all
    }
    for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
    {
      numbers += cells->GetNumberOfConnectivityIds() + cells->GetNumberOfOffsets();
    }
  }
  return header + 3 * coordinate * points + id * numbers;
}

std::string ToMebibytes(vtkIdType bytes)
{
  char text[32]; // not by snprintf, which follows the host's locale
  const auto end = std::to_chars(text, text + sizeof(text), static_cast<double>(bytes) / 1048576.0,
    std::chars_format::general, 4);
  return std::string(text, end.ptr) + " MiB";
}
}

vtkMultiProcessController* GetController()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

GatheredSurfaces GatherOthers(
  const std::vector<vtkPolyData*>& own, vtkIdType mostBytes, vtkMultiProcessController* controller)
{
  const vtkIdType bytes = CountBytes(own);
  vtkIdType all = 0;
  controller->AllReduce(&bytes, &all, 1, vtkCommunicator::SUM_OP);
  if (all > mostBytes)
  {
    return { {}, "the parts of the surface take " + ToMebibytes(all) +
                   " on all processes together, expected at most " + ToMebibytes(mostBytes) +
                   " (Gather Limit)" };
  }
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
  GatheredSurfaces gathered;
  for (std::size_t rank = 0; rank < received.size(); ++rank)
  {
    auto* surface = vtkPolyData::SafeDownCast(received[rank]);
    const bool isOwn = static_cast<int>(rank) == controller->GetLocalProcessId();
    if (surface && !isOwn && surface->GetNumberOfCells() > 0)
    {
      gathered.Others.emplace_back(surface);
    }
  }
  return gathered;
}
} // namespace measuredmaterials
