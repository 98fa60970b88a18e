// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceBlocks.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
template <typename Visit>
void ForEachBlock(vtkCompositeDataSet* composite, const Visit& visit)
{
  auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    if (auto* surface = vtkPolyData::SafeDownCast(it->GetCurrentDataObject()))
    {
      visit(surface, it.Get());
    }
  }
}
}

std::vector<vtkPolyData*> GetBlocks(vtkDataObject* data)
{
  std::vector<vtkPolyData*> surfaces;
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    surfaces.push_back(surface);
  }
  else if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    ForEachBlock(composite,
      [&surfaces](vtkPolyData* block, vtkCompositeDataIterator*) { surfaces.push_back(block); });
  }
  return surfaces;
}

vtkSmartPointer<vtkDataObject> CopyBlocks(
  vtkDataObject* data, const std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData*)>& copy)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    auto* surface = vtkPolyData::SafeDownCast(data);
    return surface ? copy(surface) : nullptr;
  }
  auto result = vtkSmartPointer<vtkCompositeDataSet>::Take(composite->NewInstance());
  result->CopyStructure(composite);
  ForEachBlock(composite, [&](vtkPolyData* surface, vtkCompositeDataIterator* at)
    { result->SetDataSet(at, copy(surface)); });
  return result;
}

vtkPolyData* FindBlock(vtkDataObject* other, vtkDataObject* data, vtkPolyData* surface)
{
  const std::vector<vtkPolyData*> surfaces = GetBlocks(data);
  const std::vector<vtkPolyData*> others = GetBlocks(other);
  const auto at = std::find(surfaces.begin(), surfaces.end(), surface);
  return at != surfaces.end() && others.size() == surfaces.size() ? others[at - surfaces.begin()]
                                                                  : nullptr;
}
} // namespace measuredbrdf
