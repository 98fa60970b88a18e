// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StockLevels.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkMapperCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#if VTK_MODULE_ENABLE_VTK_RenderingLOD // ParaView's VTK has no such actors
#include "vtkLODActor.h"
#endif

namespace measuredbrdf
{
//------------------------------------------------------------------------------
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
