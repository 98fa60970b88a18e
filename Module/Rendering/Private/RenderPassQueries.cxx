// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderPassQueries.h"

#include "vtkActor.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkLightingMapPass.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRendererCollection.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkValuePass.h"

namespace measuredbrdf
{
namespace
{
constexpr unsigned int ColorWriteMask = 0x0C23; // GL_COLOR_WRITEMASK, from the OpenGL registry

// VTK tells its own light from a program's only in a member that its subclasses see.
struct CreatedLightOf : vtkRenderer
{
  static vtkLight* Get(vtkRenderer* renderer) { return renderer->*(&CreatedLightOf::CreatedLight); }
};

// Renderers of a window may share their lights, of which VTK created one for the first of them.
bool IsCreated(vtkLight* light, vtkRenderer* renderer)
{
  vtkRendererCollection* renderers = renderer->GetRenderWindow()->GetRenderers();
  bool created = CreatedLightOf::Get(renderer) == light;
  vtkCollectionSimpleIterator it;
  renderers->InitTraversal(it);
  while (vtkRenderer* other = created ? nullptr : renderers->GetNextRenderer(it))
  {
    created = other->GetLights() == renderer->GetLights() && CreatedLightOf::Get(other) == light;
  }
  return created;
}
}

bool DrawsColor(vtkRenderer* renderer, vtkActor* actor)
{
  if (renderer->GetSelector())
  {
    return false;
  }
  vtkInformation* keys = actor->GetPropertyKeys();
  if (keys && (keys->Has(vtkLightingMapPass::RENDER_NORMALS()) ||
                keys->Has(vtkLightingMapPass::RENDER_LUMINANCE())))
  {
    return false;
  }
  vtkInformationObjectBaseVectorKey* passes = vtkOpenGLRenderPass::RenderPasses();
  for (int k = 0; keys && keys->Has(passes) && k < keys->Length(passes); ++k)
  {
    vtkObjectBase* pass = keys->Get(passes, k);
    if (vtkShadowMapBakerPass::SafeDownCast(pass) || vtkValuePass::SafeDownCast(pass))
    {
      return false;
    }
  }
  auto* openGL = vtkOpenGLRenderer::SafeDownCast(renderer);
  if (openGL && openGL->GetUseHiddenLineRemoval())
  {
    unsigned char mask[4] = { 1, 1, 1, 1 };
    openGL->GetState()->vtkglGetBooleanv(ColorWriteMask, mask);
    return mask[0] || mask[1] || mask[2];
  }
  return true;
}

bool IsShaded(vtkActor* actor)
{
  return actor->GetProperty()->GetLighting() &&
         actor->GetProperty()->GetRepresentation() == VTK_SURFACE;
}

int FindSuperfluousLight(vtkRenderer* renderer, bool isLit)
{
  int number = 0;
  vtkLightCollection* lights = renderer->GetLights();
  vtkCollectionSimpleIterator it;
  lights->InitTraversal(it);
  while (vtkLight* light = isLit ? lights->GetNextLight(it) : nullptr)
  {
    if (light->GetSwitch() && IsCreated(light, renderer))
    {
      return number;
    }
    number += light->GetSwitch() ? 1 : 0;
  }
  return -1;
}

bool HasLight(vtkRenderer* renderer, bool isLit)
{
  int on = FindSuperfluousLight(renderer, isLit) >= 0 ? -1 : 0;
  vtkLightCollection* lights = renderer->GetLights();
  vtkCollectionSimpleIterator it;
  lights->InitTraversal(it);
  while (vtkLight* light = lights->GetNextLight(it))
  {
    on += light->GetSwitch() ? 1 : 0;
  }
  return on > 0;
}
} // namespace measuredbrdf
