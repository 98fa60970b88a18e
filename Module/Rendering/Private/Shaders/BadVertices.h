// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a surface's points have that can't be drawn. Private to the rendering room.
 */

#ifndef BadVertices_h
#define BadVertices_h

#include "vtkType.h"

#include <string>

class vtkPolyData;

namespace measuredbrdf
{
struct BadVertices
{
  explicit BadVertices(vtkPolyData* surface);

  /// What was found and what is done about it, in words; "": nothing.
  std::string GetText() const;

  vtkIdType Normals = 0; // not finite, or without a length; of points or cells
  vtkIdType Tangents = 0;
  vtkIdType TextureCoordinates = 0;
  vtkIdType Points = 0;
};
} // namespace measuredbrdf

#endif
