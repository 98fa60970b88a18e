// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderPassQueries.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkImageProcessingPass.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkLightingMapPass.h"
#include "vtkMapperCollection.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkProperty.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRendererCollection.h"
#include "vtkSSAAPass.h"
#include "vtkSequencePass.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkShadowMapPass.h"
#include "vtkSmartPointer.h"
#include "vtkValuePass.h"
#if VTK_MODULE_ENABLE_VTK_RenderingLOD // ParaView's VTK has no such actors
#include "vtkLODActor.h"
#endif

#include <algorithm>
#include <vector>

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

bool IsCameraOf(vtkShadowMapBakerPass* baker, vtkCamera* camera)
{
  const std::vector<vtkSmartPointer<vtkCamera>>* lights = baker->GetLightCameras();
  return lights && std::find(lights->begin(), lights->end(), camera) != lights->end();
}

// Whether a pass, or one that it delegates to, bakes shadows with this camera now.
bool Bakes(vtkRenderPass* pass, vtkCamera* camera)
{
  if (auto* baker = vtkShadowMapBakerPass::SafeDownCast(pass))
  {
    return IsCameraOf(baker, camera);
  }
  if (auto* shadows = vtkShadowMapPass::SafeDownCast(pass))
  {
    return Bakes(shadows->GetShadowMapBakerPass(), camera);
  }
  if (auto* cameraPass = vtkCameraPass::SafeDownCast(pass))
  {
    return Bakes(cameraPass->GetDelegatePass(), camera);
  }
  if (auto* image = vtkImageProcessingPass::SafeDownCast(pass))
  {
    return Bakes(image->GetDelegatePass(), camera);
  }
  if (auto* finer = vtkSSAAPass::SafeDownCast(pass))
  {
    return Bakes(finer->GetDelegatePass(), camera);
  }
  if (auto* steps = vtkRenderStepsPass::SafeDownCast(pass))
  {
    return Bakes(steps->GetOpaquePass(), camera) || Bakes(steps->GetLightsPass(), camera);
  }
  auto* sequence = vtkSequencePass::SafeDownCast(pass);
  vtkRenderPassCollection* passes = sequence ? sequence->GetPasses() : nullptr;
  if (!passes)
  {
    return false;
  }
  vtkCollectionSimpleIterator it;
  passes->InitTraversal(it);
  while (vtkRenderPass* next = passes->GetNextRenderPass(it))
  {
    if (Bakes(next, camera))
    {
      return true;
    }
  }
  return false;
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
  // What the renderer's own camera does not see bears no sign of the baker.
  if (renderer->GetPass() && Bakes(renderer->GetPass(), renderer->GetActiveCamera()))
  {
    return false;
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

const char* FindStockLevels(vtkRenderer* renderer, vtkActor* actor, vtkMapper* mapper)
{
  // Both draw through an actor of their own, which has no mapper.
  if (actor->GetMapper() == mapper || actor->GetProperty()->GetInterpolation() == VTK_PBR)
  {
    return nullptr;
  }
  vtkActorCollection* actors = renderer->GetActors();
  vtkCollectionSimpleIterator next;
  actors->InitTraversal(next);
  while (vtkActor* other = actors->GetNextActor(next))
  {
    if (other->GetMapper() == mapper && other->IsA("vtkQuadricLODActor"))
    {
      return "vtkQuadricLODActor";
    }
#if VTK_MODULE_ENABLE_VTK_RenderingLOD
    auto* levels = vtkLODActor::SafeDownCast(other);
    if (!levels || levels->GetMapper() != mapper)
    {
      continue;
    }
    vtkCollectionSimpleIterator each;
    levels->GetLODMappers()->InitTraversal(each);
    while (vtkMapper* level = levels->GetLODMappers()->GetNextMapper(each))
    {
      if (!level->IsA("vtkMeasuredBRDFMapper") && !level->IsA("vtkCompositeMeasuredBRDFMapper"))
      {
        return "vtkLODActor";
      }
    }
#endif
  }
  return nullptr;
}
} // namespace measuredbrdf
