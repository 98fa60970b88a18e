// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What each part of a mapper was last drawn with in each view.
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
#include <utility>
#include <vector>

class vtkOpenGLRenderWindow;

namespace measuredbrdf
{
/// What the materials of a frame follow from, where plans are not for the view and none is in the
/// making. Modification times are never used twice: a recycled address does no harm.
struct FrameStamp
{
  vtkMTimeType SettingsTime = 0; // of the mapper's materials, too
  vtkEnvironment* Environment = nullptr;
  vtkMTimeType EnvironmentTime = 0;
  bool HasLight = false;
  bool Hurries = false;
  std::vector<std::pair<vtkBRDF*, double>> Uses; // with tolerances

  bool operator==(const FrameStamp& other) const
  {
    return this->SettingsTime == other.SettingsTime && this->Environment == other.Environment &&
           this->EnvironmentTime == other.EnvironmentTime && this->HasLight == other.HasLight &&
           this->Hurries == other.Hurries && this->Uses == other.Uses;
  }
};

struct ViewFrame
{
  const void* Part = nullptr;
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkWeakPointer<vtkActor> Actor; // null but where plans are for the view
  bool ForActor = false;
  std::vector<DrawnMaterial> Materials;
  FrameStamp Stamp; // of these; empty: they have to be looked up

  /// Whether the materials would be the same again, with all their textures.
  bool Stays(const FrameStamp& stamp, vtkOpenGLRenderWindow* window) const;

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
