// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The blocks of a composite data set that a material map divides.
 */

#ifndef BlockParts_h
#define BlockParts_h

#include "BlockMaterials.h"
#include "PartMappers.h"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

class vtkActor;
class vtkOpenGLPolyDataMapper;
class vtkPolyData;
class vtkRenderer;
class vtkWindow;

namespace measuredbrdf
{
class BlockParts
{
public:
  explicit BlockParts(std::shared_ptr<MaterialDrawing> drawing)
    : Drawing(std::move(drawing))
  {
  }

  /// Divide the blocks that have no material of their own, if there is a map.
  void Update(const BlockMaterials& blocks);

  /// Whether a block is of several materials, and drawn by Render.
  bool IsDivided(vtkPolyData* block) const;

  /// The material of a block that is not.
  vtkBRDF* GetBRDF(vtkPolyData* block, const BlockMaterials& blocks) const;

  /// Whether a block's colors are those of an array that chooses its material.
  bool AreColorsOfMap(vtkPolyData* block, const ScalarStyle& colors) const;

  /// Rises with each change.
  unsigned long GetRevision() const { return this->Revision; }

  ///@{
  /// Draw the divided blocks that were announced since the last Begin, as the superclass is about
  /// to draw the others.
  void Begin() { this->Announced.clear(); }
  void Announce(vtkPolyData* block, const BlockStyle& style, vtkOpenGLPolyDataMapper* batch)
  {
    this->Announced.push_back({ block, style, batch });
  }
  void Render(vtkRenderer* renderer, vtkActor* actor);
  ///@}

  std::vector<MaterialUse> GetUses() const;

  /// Of the images of weights on the graphics card.
  vtkIdType GetImageBytes() const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  struct Block
  {
    std::unique_ptr<PartMappers> Parts;
    bool IsUsed = false; // the map fits
    unsigned long Revision = 0;
  };

  struct Announcement
  {
    vtkPolyData* Surface;
    BlockStyle Style;
    vtkOpenGLPolyDataMapper* Batch; // that would have drawn it
  };

  std::shared_ptr<MaterialDrawing> Drawing;
  std::map<vtkPolyData*, Block> Blocks;
  std::vector<Announcement> Announced;
  unsigned long Revision = 0;
};
} // namespace measuredbrdf

#endif
