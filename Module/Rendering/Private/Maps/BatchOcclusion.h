// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Hidden skies of blocks that share buffers: where one block has some, all get attributes. Private
 * to the rendering room.
 */

#ifndef BatchOcclusion_h
#define BatchOcclusion_h

#include "OcclusionArrays.h"
#include "OcclusionShader.h"
#include "vtkType.h"

#include <memory>
#include <vector>

class vtkOpenGLVertexBufferObjectGroup;
class vtkPolyData;

namespace measuredbrdf
{
class BatchOcclusion
{
public:
  void Clear();

  /// What one of the blocks has, all of them before the first Append; null: it is all open.
  void Announce(const std::shared_ptr<OcclusionArrays>& arrays);

  const OcclusionSides& GetSides() const { return this->Sides; }

  /// Beside a block's other attributes.
  void Append(vtkOpenGLVertexBufferObjectGroup* buffers, vtkIdType points,
    const std::shared_ptr<OcclusionArrays>& arrays);

  /// Vertices that are in the buffers so far.
  static vtkIdType CountVertices(vtkOpenGLVertexBufferObjectGroup* buffers, vtkPolyData* surface);

private:
  bool Any = false;
  OcclusionSides Sides;
  std::vector<std::shared_ptr<OcclusionArrays>> Kept; // until the buffers are built
};
} // namespace measuredbrdf

#endif
