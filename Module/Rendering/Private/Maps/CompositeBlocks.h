// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The blocks of a composite data set: which material each has, and those that a material map
 * divides.
 */

#ifndef CompositeBlocks_h
#define CompositeBlocks_h

#include "DividedSurface.h"
#include "MaterialDrawing.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

class vtkActor;
class vtkBRDF;
class vtkDataObject;
class vtkPolyData;
class vtkRenderer;
class vtkWindow;

namespace measuredbrdf
{
class CompositeBlocks
{
public:
  explicit CompositeBlocks(std::shared_ptr<MaterialDrawing> drawing);
  ~CompositeBlocks();
  CompositeBlocks(const CompositeBlocks&) = delete;
  void operator=(const CompositeBlocks&) = delete;

  /// Look at the data and the settings, if they changed, and divide the blocks that have no
  /// material of their own, if there is a map. Warns of blocks that the data do not have.
  void Update();

  /// The material of a block that is not divided; null: none.
  vtkBRDF* GetBRDF(vtkPolyData* block) const;

  /// Whether a block is drawn by Render.
  bool IsDivided(vtkPolyData* block) const;

  /// Rises with each change.
  unsigned long GetRevision() const { return this->Revision; }

  ///@{
  /// Draw the divided blocks that were announced since the last Begin, as VTK's class is about to
  /// draw the others. Announce returns a mapper for the block's own settings.
  void Begin();
  vtkOpenGLPolyDataMapper* Announce(vtkPolyData* block, const BlockStyle& style);
  void Render(vtkRenderer* renderer, vtkActor* actor);
  ///@}

  /// Of the divided blocks.
  std::vector<vtkBRDF*> GetBRDFs() const;

  /// Of the images of weights on the graphics card.
  vtkIdType GetImageBytes() const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  struct Material
  {
    vtkBRDF* BRDF = nullptr;
    bool IsOwn = false; // of the block or one above it, not the mapper's
  };
  struct Walk;

  struct Divided
  {
    std::unique_ptr<DividedSurface> Surface;
    bool IsUsed = false; // the map fits
    unsigned long Revision = 0;
    bool IsAnnounced = false;
    BlockStyle Style;
    vtkSmartPointer<vtkOpenGLPolyDataMapper> Host; // as which it is drawn
  };

  std::shared_ptr<MaterialDrawing> Drawing;
  std::unordered_map<vtkPolyData*, Material> Materials;
  std::map<vtkPolyData*, Divided> DividedBlocks;
  vtkDataObject* Data = nullptr;
  vtkMTimeType DataTime = 0;
  vtkMTimeType SettingsTime = 0;
  unsigned long Revision = 0;
};
} // namespace measuredbrdf

#endif
