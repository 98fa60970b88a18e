// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The surfaces of a mapper's input: itself, or its blocks.
 */

#ifndef SurfaceBlocks_h
#define SurfaceBlocks_h

#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <unordered_map>
#include <vector>

namespace measuredbrdf
{
/// In the order of its iterator.
inline std::vector<vtkPolyData*> GetBlocks(vtkDataObject* data)
{
  return vtkCompositeDataSet::GetDataSets<vtkPolyData>(data);
}

/// The same structure with a copy of each surface, and without what is none.
vtkSmartPointer<vtkDataObject> CopyBlocks(
  vtkDataObject* data, const std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData*)>& copy);

/// Of data of the same structure, what stands for a surface. Both are listed once, however many
/// surfaces are asked for.
class BlockPairs
{
public:
  /// Null: there is none.
  vtkPolyData* Find(vtkDataObject* other, vtkDataObject* data, vtkPolyData* surface);

private:
  vtkDataObject* Other = nullptr; // only compared, with the time of both: others come later
  vtkDataObject* Data = nullptr;
  vtkMTimeType Time = 0;
  std::unordered_map<vtkPolyData*, vtkPolyData*> Pairs;
};
} // namespace measuredbrdf

#endif
