// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The surfaces of a mapper's input: itself, or its blocks. Private to the rendering room.
 */

#ifndef SurfaceBlocks_h
#define SurfaceBlocks_h

#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <vector>

class vtkPolyData;

namespace measuredbrdf
{
/// In the order of its iterator.
std::vector<vtkPolyData*> GetBlocks(vtkDataObject* data);

/// The same structure with a copy of each surface, and without what is none.
vtkSmartPointer<vtkDataObject> CopyBlocks(
  vtkDataObject* data, const std::function<vtkSmartPointer<vtkPolyData>(vtkPolyData*)>& copy);

/// Of data of the same structure, what stands for a surface; null: there is none.
vtkPolyData* FindBlock(vtkDataObject* other, vtkDataObject* data, vtkPolyData* surface);
} // namespace measuredbrdf

#endif
