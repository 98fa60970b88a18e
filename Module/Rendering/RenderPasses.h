// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which of VTK's render passes take colour from a material. Private to the rendering room.
 */

#ifndef RenderPasses_h
#define RenderPasses_h

class vtkActor;
class vtkRenderer;

namespace measuredbrdf
{
/// Whether the colours now drawn are seen: not while picking, nor in a shadow map.
bool TakesColor(vtkRenderer* renderer, vtkActor* actor);
} // namespace measuredbrdf

#endif
