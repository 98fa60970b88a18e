// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws blocks of composite data that VTK's composite mapper draws from common buffers.
 */

#ifndef BlockBatch_h
#define BlockBatch_h

#include "vtkColor.h" // which VTK's header takes for included

#include "CompositeBlocks.h"
#include "OcclusionArrays.h"
#include "OcclusionShader.h"
#include "ShadedMapper.h"
#include "vtkVersionMacros.h"

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkOpenGLBatchedPolyDataMapper.h"
#include "vtkOpenGLCompositePolyDataMapperDelegator.h"
#else
using GLenum = unsigned int; // which the next header takes for declared
#include "vtkCompositeMapperHelper2.h"
#endif

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

class vtkOpenGLVertexBufferObjectGroup;

namespace measuredbrdf
{
// What VTK calls the mapper of a batch of blocks, and its record of a block.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
using BatchBase = vtkOpenGLBatchedPolyDataMapper;
using BlockRecord = vtkOpenGLBatchedPolyDataMapper::GLBatchElement;
inline vtkPolyData* GetSurface(BlockRecord* record) { return record->Parent.PolyData; }
#else
using BatchBase = vtkCompositeMapperHelper2;
using BlockRecord = vtkCompositeMapperHelperData;
inline vtkPolyData* GetSurface(BlockRecord* record) { return record->Data; }
#endif

/// Those of one material are drawn while the others are invisible.
class BlockBatch : public ShadedMapper<BatchBase>
{
public:
  static BlockBatch* New();
  vtkTypeMacro(BlockBatch, ShadedMapper<BatchBase>);

  void Initialize(std::shared_ptr<MaterialDrawing> drawing, CompositeBlocks* blocks);

protected:
  BlockBatch() = default;
  ~BlockBatch() override = default;

  std::vector<vtkBRDF*> GetBRDFs() override;
  void AddOcclusion(vtkRenderer* ren) override;
  void AppendOneBufferObject(vtkRenderer* ren, vtkActor* actor, BlockRecord* record,
    vtkIdType& offset, std::vector<unsigned char>& colors, std::vector<float>& normals) override;
  void ShowOnly(int material) override;

private:
  BlockBatch(const BlockBatch&) = delete;
  void operator=(const BlockBatch&) = delete;

  struct Block
  {
    vtkPolyData* Surface;
    bool* Visible;  // the superclass's record
    bool IsVisible; // what it says while others are hidden
    int Use;        // of its material; -1: it is divided, and never shown
  };

  template <typename Record>
  void Announce(vtkPolyData* surface, const Record& block);
  template <typename Visit>
  void ForEachBlock(const Visit& visit);
  void Sort();

  CompositeBlocks* All = nullptr;
  std::vector<Block> Blocks;   // in the superclass's order
  std::vector<vtkBRDF*> BRDFs; // of the blocks that it shows
  unsigned long Revision = 0;
  int Shown = -1;
  bool HasDivided = false;
  // What blocks hide from themselves. Where one has arrays, all get attributes of the buffers that
  // they share; none: no block has any.
  std::map<vtkPolyData*, std::shared_ptr<OcclusionArrays>> Announced;
};
} // namespace measuredbrdf

#endif
