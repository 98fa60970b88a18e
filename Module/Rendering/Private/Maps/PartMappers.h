// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws a surface by a material map, part by part.
 */

#ifndef PartMappers_h
#define PartMappers_h

#include "ClassesMapper.h"
#include "MaterialDrawing.h"
#include "MaterialParts.h"
#include "PartMapper.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

class vtkActor;
class vtkOpenGLPolyDataMapper;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkWindow;

namespace measuredbrdf
{
/// Whether colors are those of an array that chooses materials.
bool AreColorsOfMap(const ScalarStyle& colors, vtkPolyData* input, vtkMaterialMap* map);

class PartMappers
{
public:
  explicit PartMappers(std::shared_ptr<MaterialDrawing> drawing);
  ~PartMappers();
  PartMappers(const PartMappers&) = delete;
  void operator=(const PartMappers&) = delete;

  /// Say before Divide how host will draw the surface: whether borders between classes of points
  /// may be cut depends on it. scalars: that color it; hasOwnAttributes: vertices have what a
  /// program adds. If it is never said, they are not cut.
  void Expect(vtkPolyData* input, vtkActor* actor, vtkOpenGLPolyDataMapper* host,
    const ScalarStyle& scalars, bool hasOwnAttributes);

  /// Divide the surface by the map of the drawing's settings. Returns whether it can be drawn by
  /// parts; else a warning has said why not, once.
  bool Divide(vtkPolyData* input);

  /// Draw the parts as host would draw the whole, apart from the material. time: when host was last
  /// modified; prepare: called with each mapper that was brought up to date with host.
  void Render(vtkRenderer* renderer, vtkActor* actor, vtkOpenGLPolyDataMapper* host,
    vtkMTimeType time, const std::function<void(vtkPolyDataMapper*)>& prepare);

  /// Of the block that the surface is; default: there are no blocks.
  void SetStyle(const BlockStyle& style);

  ///@{
  /// There is no map; nothing is drawn by parts for now.
  void Clear();
  void DropMappers();
  ///@}

  /// As each part's mapper last measured it.
  double GetTimeToDraw() const;

  /// What is drawn next, after Divide.
  std::vector<MaterialUse> GetUses() const;

  /// The error of the whole that the plans of the last frame predict, relative L1: that of each
  /// material by its share of the surface and its albedo. Negative: there are no plans.
  double PredictError(const DrawnMaterials& materials) const;

  const MaterialParts& GetParts() const { return this->Parts; }

  /// Of the images of weights on the graphics card.
  vtkIdType GetImageBytes() const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Synchronize(
    vtkOpenGLPolyDataMapper* host, const std::function<void(vtkPolyDataMapper*)>& prepare);
  void SetUp(PartMapper* mapper, vtkOpenGLPolyDataMapper* host, bool colored,
    const std::function<void(vtkPolyDataMapper*)>& prepare);
  void ForEachMapper(const std::function<void(PartMapper*)>& visit) const;
  void RenderHighlight(vtkRenderer* renderer, vtkActor* actor, vtkOpenGLPolyDataMapper* host);

  std::shared_ptr<MaterialDrawing> Drawing;
  MaterialParts Parts;
  vtkNew<vtkCallbackCommand> ForwardEvents;
  vtkSmartPointer<ClassesMapper> Classes;           // of all single parts; null: each has its own
  std::vector<vtkSmartPointer<PartMapper>> Mappers; // of each other part
  bool Together = false;                            // whether single parts have one, where possible
  vtkSmartPointer<vtkOpenGLPolyDataMapper> Highlight; // null: nothing was ever selected
  vtkMTimeType HighlightTime = 0;                     // of its input
  vtkSmartPointer<vtkPolyData> Input;
  std::unique_ptr<BlockStyle> Style;
  unsigned long Revision = 0;
  vtkMTimeType HostTime = 0;
  const void* Host = nullptr; // only compared
  bool OverridesColor = false;
  bool IsExpected = false; // whether Expect was called
  bool MayCut = false;
  ScalarStyle Scalars; // of the block
};
} // namespace measuredbrdf

#endif
