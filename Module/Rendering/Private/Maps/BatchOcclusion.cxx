// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BatchOcclusion.h"

#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <string>

namespace measuredbrdf
{
void BatchOcclusion::Clear()
{
  this->Any = false;
  this->Sides = {};
  this->Kept.clear();
}

void BatchOcclusion::Announce(const std::shared_ptr<OcclusionArrays>& arrays)
{
  this->Any = this->Any || arrays;
  this->Sides.IsOtherClosed = this->Sides.IsOtherClosed && arrays;
  if (arrays)
  {
    this->Sides.Add(*arrays);
  }
}

void BatchOcclusion::Append(vtkOpenGLVertexBufferObjectGroup* buffers, vtkIdType points,
  const std::shared_ptr<OcclusionArrays>& arrays)
{
  if (!this->Any)
  {
    return;
  }
  const bool whole = arrays && (arrays->HasBack || !this->Sides.Both);
  const std::shared_ptr<OcclusionArrays> open = whole ? nullptr : OcclusionArrays::MakeOpen(points);
  this->Kept.push_back(arrays);
  this->Kept.push_back(open);
  if (this->Sides.Bounced)
  {
    const bool has = arrays && arrays->HasBounce;
    const std::shared_ptr<OcclusionArrays> dark =
      open || (has && whole) ? open : OcclusionArrays::MakeOpen(points);
    this->Kept.push_back(dark);
    buffers->AppendDataArray(
      "brdfBounce", has ? arrays->BounceFront : dark->BounceFront, VTK_FLOAT);
    if (this->Sides.Both)
    {
      buffers->AppendDataArray("brdfBounceBack",
        has && arrays->HasBack ? arrays->BounceBack : dark->BounceFront, VTK_FLOAT);
    }
  }
  const OcclusionArrays::Side& front = arrays ? arrays->Front : open->Front;
  for (std::size_t k = 0; k < OcclusionArrays::Attributes; ++k)
  {
    const std::string number = std::to_string(k);
    buffers->AppendDataArray(("brdfSky" + number).c_str(), front[k], VTK_FLOAT);
    if (this->Sides.Both)
    {
      buffers->AppendDataArray(("brdfSkyBack" + number).c_str(),
        arrays && arrays->HasBack ? arrays->Back[k] : open->Front[k], VTK_FLOAT);
    }
  }
}

vtkIdType BatchOcclusion::CountVertices(
  vtkOpenGLVertexBufferObjectGroup* buffers, vtkPolyData* surface)
{
  vtkIdType place = 0;
  vtkIdType count = 0;
  if (surface && surface->GetPoints())
  {
    buffers->ArrayExists("vertexMC", surface->GetPoints()->GetData(), place, count);
  }
  return count;
}
} // namespace measuredbrdf
