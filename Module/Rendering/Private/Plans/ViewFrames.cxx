// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFrames.h"

#include <algorithm>
#include <iterator>

namespace measuredbrdf
{
bool ViewFrame::Stays(const FrameStamp& stamp, vtkOpenGLRenderWindow* window) const
{
  const auto isThere = [window](const std::shared_ptr<ShaderTextures>& textures)
  { return !textures || textures->IsIn(window); };
  return !stamp.Uses.empty() && this->Stamp == stamp &&
         std::all_of(this->Materials.begin(), this->Materials.end(),
           [&isThere](const DrawnMaterial& drawn)
           { return drawn.IsReady && isThere(drawn.Material) && isThere(drawn.Radiance); });
}

template <typename IsWanted>
void ViewFrames::Remove(const IsWanted& isWanted)
{
  for (auto it = this->ByKey.begin(); it != this->ByKey.end();)
  {
    it = isWanted(*it->second) ? this->ByKey.erase(it) : std::next(it);
  }
  this->Frames.erase(
    std::remove_if(this->Frames.begin(), this->Frames.end(),
      [&isWanted](const std::unique_ptr<ViewFrame>& frame) { return isWanted(*frame); }),
    this->Frames.end());
}

ViewFrame& ViewFrames::Find(vtkRenderer* renderer, vtkActor* actor, const void* part)
{
  if (++this->Lookups > this->Frames.size())
  {
    this->Lookups = 0;
    this->Remove([](const ViewFrame& frame) { return frame.IsGone(); });
  }
  const Key key(part, renderer, actor);
  const auto known = this->ByKey.find(key);
  if (known != this->ByKey.end() && !known->second->IsGone())
  {
    return *known->second;
  }
  if (known != this->ByKey.end()) // an address used again
  {
    this->Remove([](const ViewFrame& frame) { return frame.IsGone(); });
  }
  this->Frames.push_back(std::make_unique<ViewFrame>());
  ViewFrame& frame = *this->Frames.back();
  frame.Part = part;
  frame.Renderer = renderer;
  frame.ForActor = actor != nullptr;
  frame.Actor = actor;
  this->ByKey[key] = &frame;
  return frame;
}

void ViewFrames::Forget(const void* part)
{
  const auto first = this->ByKey.lower_bound(Key(part, nullptr, nullptr));
  if (first != this->ByKey.end() && std::get<0>(first->first) == part)
  {
    this->Remove([part](const ViewFrame& frame) { return frame.Part == part; });
  }
}
} // namespace measuredbrdf
