// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws blocks of composite data that VTK's composite mapper draws from common buffers. Private to
 * the rendering room.
 */

#ifndef BlockBatch_h
#define BlockBatch_h

#include "BlockMaterials.h"
#include "BlockParts.h"
#include "BlockStyle.h"
#include "vtkColor.h" // which VTK's header takes for included
#include "vtkMeasuredBRDFMapperMixin.h"
#include "vtkVersionMacros.h"
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkOpenGLBatchedPolyDataMapper.h"
#else
using GLenum = unsigned int; // which the next header takes for declared
#include "vtkCompositeMapperHelper2.h"
#endif

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace measuredbrdf
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
using BatchBase = vtkOpenGLBatchedPolyDataMapper;
#else
using BatchBase = vtkCompositeMapperHelper2;
#endif

/// Those of one material are drawn while the others are invisible.
class BlockBatch : public vtkMeasuredBRDFMapperMixin<BatchBase>
{
public:
  static BlockBatch* New();
  vtkTypeMacro(BlockBatch, vtkMeasuredBRDFMapperMixin<BatchBase>);

  /// update: what brings the blocks' materials up to date.
  void Initialize(std::shared_ptr<vtkMeasuredBRDFMapperInternals> drawing,
    const BlockMaterials* materials, BlockParts* parts, std::function<void()> update);

protected:
  BlockBatch() = default;
  ~BlockBatch() override = default;

  std::vector<MaterialUse> GetMaterialUses() override;
  bool IgnoresScalars() override;
  void ShowOnly(int material) override;

private:
  BlockBatch(const BlockBatch&) = delete;
  void operator=(const BlockBatch&) = delete;

  struct Block
  {
    vtkPolyData* Surface;
    bool* Visible;  // the superclass's record
    bool IsVisible; // what it says while others are hidden
  };

  template <typename Record>
  BlockStyle GetStyle(const Record& block);
  template <typename Visit>
  void ForEachBlock(const Visit& visit);
  void Sort();

  const BlockMaterials* Materials = nullptr;
  BlockParts* Parts = nullptr;
  std::function<void()> UpdateBlocks;
  std::vector<Block> Blocks; // in the superclass's order
  std::vector<MaterialUse> Uses;
  std::vector<std::vector<std::size_t>> BlocksOf; // of each use
  std::vector<bool> AreColorsOfMap;               // of each use
  unsigned long Revision = 0;
  vtkMTimeType SortTime = 0;
  int Shown = -1;
  bool HasDivided = false;
};
} // namespace measuredbrdf

#endif
