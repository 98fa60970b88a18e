// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What each part of a mapper was last drawn with in each view. Private to the rendering room.
 */

#ifndef ViewFrames_h
#define ViewFrames_h

#include "DrawnMaterial.h"
#include "vtkActor.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

namespace measuredbrdf
{
struct ViewFrame
{
  const void* Part = nullptr;
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkWeakPointer<vtkActor> Actor; // null but where plans are for the view
  bool ForActor = false;
  std::vector<DrawnMaterial> Materials;

  bool IsGone() const { return !this->Renderer || (this->ForActor && !this->Actor); }
};

class ViewFrames
{
public:
  /// The frame of a part, made if there is none. actor: null but where plans are for the view.
  ViewFrame& Find(vtkRenderer* renderer, vtkActor* actor, const void* part);

  /// Those of a part go.
  void Forget(const void* part);

  /// In the order in which they were first drawn.
  const std::vector<std::unique_ptr<ViewFrame>>& GetAll() const { return this->Frames; }

private:
  using Key = std::tuple<const void*, vtkRenderer*, vtkActor*>;
  template <typename IsWanted>
  void Remove(const IsWanted& isWanted);

  std::vector<std::unique_ptr<ViewFrame>> Frames;
  std::map<Key, ViewFrame*> ByKey; // a surface may have hundreds of parts
  std::size_t Lookups = 0;         // since those that are gone were removed
};
} // namespace measuredbrdf

#endif
