// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HighlightMapper.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLIndexBufferObject.h"

namespace measuredbrdf
{
vtkStandardNewMacro(HighlightMapper);

// The superclass leaves out primitives without indices; what is selected has indices of its own.
void HighlightMapper::BuildBufferObjects(vtkRenderer* ren, vtkActor* actor)
{
  this->Superclass::BuildBufferObjects(ren, actor);
  for (vtkOpenGLHelper& primitive : this->Primitives)
  {
    primitive.IBO->IndexCount = 0;
  }
}
} // namespace measuredbrdf
