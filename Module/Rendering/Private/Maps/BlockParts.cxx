// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockParts.h"

#include "RenderPassQueries.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// Whether one material, or none, is all there is.
bool IsWhole(const MaterialParts& parts)
{
  return parts.Get().empty() ||
         (parts.Get().size() == 1 && parts.Get()[0].Kind == MixtureKind::Single);
}
}

void BlockParts::Update(const BlockMaterials& blocks)
{
  const bool hasMap = this->Drawing->GetSettings().MaterialMap != nullptr;
  for (auto it = this->Blocks.begin(); it != this->Blocks.end();)
  {
    const auto known = blocks.GetAll().find(it->first);
    const bool stays = hasMap && known != blocks.GetAll().end() && !known->second.IsOwn;
    this->Revision += stays ? 0 : 1;
    it = stays ? std::next(it) : this->Blocks.erase(it);
  }
  for (const auto& [surface, material] : blocks.GetAll())
  {
    if (!hasMap || material.IsOwn)
    {
      continue;
    }
    Block& block = this->Blocks[surface];
    if (!block.Parts)
    {
      block.Parts = std::make_unique<PartMappers>(this->Drawing);
    }
    const bool used = block.Parts->Divide(surface);
    const unsigned long revision = block.Parts->GetParts().GetRevision();
    if (used != block.IsUsed || revision != block.Revision)
    {
      block.IsUsed = used;
      block.Revision = revision;
      ++this->Revision;
      if (!used || IsWhole(block.Parts->GetParts()))
      {
        block.Parts->DropMappers();
      }
    }
  }
}

bool BlockParts::IsDivided(vtkPolyData* block) const
{
  const auto found = this->Blocks.find(block);
  return found != this->Blocks.end() && found->second.IsUsed &&
         !IsWhole(found->second.Parts->GetParts());
}

vtkBRDF* BlockParts::GetBRDF(vtkPolyData* block, const BlockMaterials& blocks) const
{
  const auto found = this->Blocks.find(block);
  if (found == this->Blocks.end() || !found->second.IsUsed)
  {
    return blocks.Get(block).BRDF;
  }
  const std::vector<vtkBRDF*> brdfs = found->second.Parts->GetParts().GetBRDFs();
  return brdfs.empty() ? nullptr : brdfs.front();
}

bool BlockParts::AreColorsOfMap(vtkPolyData* block, const ScalarStyle& colors) const
{
  const auto found = this->Blocks.find(block);
  return found != this->Blocks.end() && found->second.IsUsed &&
         measuredbrdf::AreColorsOfMap(colors, block, this->Drawing->GetSettings().MaterialMap);
}

void BlockParts::Render(vtkRenderer* renderer, vtkActor* actor)
{
  if (!DrawsColor(renderer, actor) || !IsShaded(actor))
  {
    return; // the superclass has drawn all blocks
  }
  // As the superclass decides for its own blocks.
  const bool translucentPass = actor->IsRenderingTranslucentPolygonalGeometry();
  for (const auto& [surface, style, batch] : this->Announced)
  {
    const bool inPass =
      translucentPass
        ? (!style.IsOpaque || actor->GetForceTranslucent()) && !actor->GetForceOpaque()
        : (style.IsOpaque || actor->GetForceOpaque()) && !actor->GetForceTranslucent();
    const auto found = this->Blocks.find(surface);
    if (style.IsVisible && inPass && found != this->Blocks.end())
    {
      found->second.Parts->SetStyle(style);
      found->second.Parts->Render(
        renderer, actor, batch, batch->GetMTime(), [](vtkPolyDataMapper*) {});
    }
  }
}

std::vector<MaterialUse> BlockParts::GetUses() const
{
  std::map<vtkBRDF*, std::vector<vtkPolyData*>> surfaces;
  for (const auto& [surface, block] : this->Blocks)
  {
    for (const MaterialUse& use : block.Parts->GetUses())
    {
      std::vector<vtkPolyData*>& all = surfaces[use.first];
      all.insert(all.end(), use.second.begin(), use.second.end());
    }
  }
  return { surfaces.begin(), surfaces.end() };
}

// All blocks share them.
vtkIdType BlockParts::GetImageBytes() const
{
  vtkIdType bytes = 0;
  for (const auto& [surface, block] : this->Blocks)
  {
    bytes = std::max(bytes, block.Parts->GetImageBytes());
  }
  return bytes;
}

void BlockParts::ReleaseGraphicsResources(vtkWindow* window)
{
  for (const auto& [surface, block] : this->Blocks)
  {
    block.Parts->ReleaseGraphicsResources(window);
  }
}
} // namespace measuredbrdf
