// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RenderPasses.h"

#include "vtkActor.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkRenderer.h"
#include "vtkShadowMapBakerPass.h"

namespace measuredbrdf
{
bool TakesColor(vtkRenderer* renderer, vtkActor* actor)
{
  if (renderer->GetSelector())
  {
    return false;
  }
  vtkInformation* keys = actor->GetPropertyKeys();
  vtkInformationObjectBaseVectorKey* passes = vtkOpenGLRenderPass::RenderPasses();
  for (int k = 0; keys && keys->Has(passes) && k < keys->Length(passes); ++k)
  {
    if (vtkShadowMapBakerPass::SafeDownCast(keys->Get(passes, k)))
    {
      return false;
    }
  }
  return true;
}
} // namespace measuredbrdf
