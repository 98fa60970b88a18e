// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a renderer draws an actor for, and with which lights.
 */

#ifndef RenderPassQueries_h
#define RenderPassQueries_h

class vtkActor;
class vtkRenderer;

namespace measuredbrdf
{
/// Whether what the actor is being drawn for shows its color: not so where something is selected
/// (vtkHardwareSelector), where depths are drawn from a light (vtkShadowMapBakerPass) or to hide
/// lines, nor where arrays or single terms of the light are drawn (vtkValuePass,
/// vtkLightingMapPass). Neither plans nor textures are of use there.
bool DrawsColor(vtkRenderer* renderer, vtkActor* actor);

/// Whether an actor is one that materials shade: a lit surface. Else the superclass draws it.
bool IsShaded(vtkActor* actor);

/// The light that VTK created because the scene had none (vtkRenderer::AutomaticLightCreation), by
/// its number among the lights that are on: the one by which shaders know it. It stands for the
/// light that a scene lacks. A surface that is lit, by an environment or by an integrator that the
/// program gave, leaves it out. -1: it is off, it was removed, or the surface is not lit.
int FindSuperfluousLight(vtkRenderer* renderer, bool isLit);

/// Whether any light of the scene is on that shines on a surface, which is lit besides or not.
bool HasLight(vtkRenderer* renderer, bool isLit);
} // namespace measuredbrdf

#endif
