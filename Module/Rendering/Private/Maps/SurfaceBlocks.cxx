// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceBlocks.h"

#include "vtkCompositeDataIterator.h"

#include <algorithm>

namespace measuredbrdf
{
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
  const auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    if (auto* surface = vtkPolyData::SafeDownCast(it->GetCurrentDataObject()))
    {
      result->SetDataSet(it, copy(surface));
    }
  }
  return result;
}

vtkPolyData* BlockPairs::Find(vtkDataObject* other, vtkDataObject* data, vtkPolyData* surface)
{
  if (!other || !data)
  {
    return nullptr;
  }
  const vtkMTimeType time = std::max(other->GetMTime(), data->GetMTime());
  if (this->Other != other || this->Data != data || this->Time != time)
  {
    this->Other = other;
    this->Data = data;
    this->Time = time;
    this->Pairs.clear();
    const std::vector<vtkPolyData*> surfaces = GetBlocks(data);
    const std::vector<vtkPolyData*> others = GetBlocks(other);
    for (std::size_t k = 0; k < surfaces.size() && others.size() == surfaces.size(); ++k)
    {
      this->Pairs.emplace(surfaces[k], others[k]);
    }
  }
  const auto found = this->Pairs.find(surface);
  return found == this->Pairs.end() ? nullptr : found->second;
}
} // namespace measuredbrdf
