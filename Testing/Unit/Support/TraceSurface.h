// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A surface with the arrays of vtkSurfaceVisibilityFilter, nullptr where it refuses or gives
 * blocks.
 */

#ifndef TraceSurface_h
#define TraceSurface_h

#include "vtkPolyData.h"
#include "vtkSurfaceVisibilityFilter.h"

inline vtkPolyData* Trace(vtkSurfaceVisibilityFilter* filter, vtkDataObject* input)
{
  filter->SetInputDataObject(input);
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

#endif
