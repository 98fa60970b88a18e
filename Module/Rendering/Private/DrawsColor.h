// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which passes of a frame show colors. Private to the rendering room.
 */

#ifndef DrawsColor_h
#define DrawsColor_h

class vtkActor;
class vtkRenderer;

namespace measuredbrdf
{
/// Whether what the actor is being drawn for shows its color: not so where something is selected
/// (vtkHardwareSelector), where depths are drawn from a light (vtkShadowMapBakerPass) or to hide
/// lines, nor where arrays or single terms of the light are drawn (vtkValuePass,
/// vtkLightingMapPass). Neither plans nor textures are of use there, and the camera may be another
/// one.
bool DrawsColor(vtkRenderer* renderer, vtkActor* actor);

/// Whether an actor is one that materials shade: a lit surface. Else the superclass draws it.
bool IsShaded(vtkActor* actor);

/// Whether any light of the scene is on.
bool HasLight(vtkRenderer* renderer);
} // namespace measuredbrdf

#endif
