// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws blocks of composite data that VTK's composite mapper draws from common buffers. Private to
 * the rendering room.
 */

#ifndef BlockBatch_h
#define BlockBatch_h

#include "vtkColor.h" // which VTK's header takes for included

#include "BatchBase.h"
#include "BatchOcclusion.h"
#include "BlockMaterials.h"
#include "BlockParts.h"
#include "BlockStyle.h"
#include "ShadedMapper.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace measuredbrdf
{
/// Those of one material are drawn while the others are invisible.
class BlockBatch : public ShadedMapper<BatchBase>
{
public:
  static BlockBatch* New();
  vtkTypeMacro(BlockBatch, ShadedMapper<BatchBase>);

  /// update: what brings the blocks' materials up to date.
  void Initialize(std::shared_ptr<MaterialDrawing> drawing, const BlockMaterials* materials,
    BlockParts* parts, std::function<void()> update);

protected:
  BlockBatch() = default;
  ~BlockBatch() override = default;

  std::vector<MaterialUse> GetMaterialUses() override;
  bool IgnoresScalars() override;
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
  BatchOcclusion Occlusion;
};
} // namespace measuredbrdf

#endif
