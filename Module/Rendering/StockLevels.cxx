// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StockLevels.h"

#include "vtkActor.h"
#include "vtkActorCollection.h"
#include "vtkLODActor.h"
#include "vtkMapperCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

namespace measuredbrdf
{
//------------------------------------------------------------------------------
const char* FindStockLevels(vtkRenderer* renderer, vtkActor* actor, vtkMapper* mapper)
{
  if (actor->GetProperty()->GetInterpolation() == VTK_PBR)
  {
    return nullptr;
  }
  if (actor->GetMapper() == mapper)
  {
    return actor->IsA("vtkQuadricLODActor") ? "vtkQuadricLODActor" : nullptr;
  }
  // vtkLODActor draws through an actor of its own, which has no mapper.
  vtkActorCollection* actors = renderer->GetActors();
  vtkCollectionSimpleIterator next;
  actors->InitTraversal(next);
  while (vtkActor* other = actors->GetNextActor(next))
  {
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
  }
  return nullptr;
}
} // namespace measuredbrdf
