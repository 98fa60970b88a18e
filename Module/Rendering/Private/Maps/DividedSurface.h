// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws a surface by a material map, part by part.
 */

#ifndef DividedSurface_h
#define DividedSurface_h

#include "MaterialDrawing.h"
#include "MaterialParts.h"
#include "PartsMapper.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <vector>

class vtkActor;
class vtkOpenGLPolyDataMapper;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkWindow;

namespace measuredbrdf
{
class DividedSurface
{
public:
  explicit DividedSurface(std::shared_ptr<MaterialDrawing> drawing);
  ~DividedSurface();
  DividedSurface(const DividedSurface&) = delete;
  void operator=(const DividedSurface&) = delete;

  /// Divide the surface by the map of the drawing's settings. Returns whether it can be drawn by
  /// parts; else a warning has said why not, once.
  bool Divide(vtkPolyData* input);

  /// Draw the parts as host would draw the whole, apart from the material. time: when host was last
  /// modified; prepare: called with the mapper of the parts when it was brought up to date with
  /// host; style: of the block that the surface is, or null.
  void Render(vtkRenderer* renderer, vtkActor* actor, vtkOpenGLPolyDataMapper* host,
    vtkMTimeType time, const std::function<void(vtkPolyDataMapper*)>& prepare,
    const BlockStyle* style);

  /// There is no map.
  void Clear();

  /// In seconds, as the parts' mapper last measured it.
  double GetTimeToDraw() const { return this->Mapper ? this->Mapper->GetTimeToDraw() : 0.0; }

  /// What is drawn next, after Divide.
  const std::vector<vtkBRDF*>& GetBRDFs() const { return this->Parts.GetBRDFs(); }

  /// The error of the whole that the plans of the last frame predict, relative L1: that of each
  /// material by its share of the surface and its albedo. Negative: there are no plans.
  double PredictError(const DrawnMaterials& materials) const;

  /// Rises with each division.
  unsigned long GetRevision() const { return this->Parts.GetRevision(); }

  /// Of the images of weights on the graphics card.
  vtkIdType GetImageBytes() const { return this->Mapper ? this->Mapper->GetImageBytes() : 0; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void RenderHighlight(vtkRenderer* renderer, vtkActor* actor, vtkOpenGLPolyDataMapper* host);
  void DropMappers();

  std::shared_ptr<MaterialDrawing> Drawing;
  MaterialDrawing::WholeSurface Whole;
  MaterialParts Parts;
  vtkNew<vtkCallbackCommand> ForwardEvents;
  vtkSmartPointer<PartsMapper> Mapper;                // null: nothing is drawn by parts
  vtkSmartPointer<vtkOpenGLPolyDataMapper> Highlight; // null: nothing was ever selected
  vtkMTimeType HighlightTime = 0;                     // of its input
  vtkSmartPointer<vtkPolyData> Input;
  unsigned long Revision = 0;
  vtkMTimeType HostTime = 0;
  const void* Host = nullptr; // only compared
  bool OverridesColor = false;
};
} // namespace measuredbrdf

#endif
