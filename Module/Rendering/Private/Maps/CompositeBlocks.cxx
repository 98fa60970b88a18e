// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CompositeBlocks.h"

#include "MaterialSettings.h"
#include "RenderPassQueries.h"
#include "vtkActor.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkInformation.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <set>

namespace measuredbrdf
{
// Down the tree as VTK counts: the root is 0, missing children count.
struct CompositeBlocks::Walk
{
  void Visit(vtkDataObject* data, const char* name, Material material)
  {
    const unsigned int index = this->Next++;
    const auto byName =
      name ? this->Settings.BlocksByName.find(name) : this->Settings.BlocksByName.end();
    if (byName != this->Settings.BlocksByName.end())
    {
      material = { byName->second, true };
      this->Found.insert(name);
    }
    const auto byIndex = this->Settings.BlocksByIndex.find(index);
    if (byIndex != this->Settings.BlocksByIndex.end())
    {
      material = { byIndex->second, true };
    }
    if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
    {
      for (const auto child : vtk::Range(tree, vtk::DataObjectTreeOptions::None))
      {
        const char* childName =
          child.HasMetaData() ? child.GetMetaData()->Get(vtkCompositeDataSet::NAME()) : nullptr;
        this->Visit(child.GetDataObject(), childName, material);
      }
    }
    else if (auto* surface = vtkPolyData::SafeDownCast(data))
    {
      this->Materials[surface] = material;
    }
  }

  // What the settings name and the data do not have.
  std::string GetMissing() const
  {
    std::string missing;
    const auto add = [&missing](const std::string& text)
    { missing += (missing.empty() ? "" : ", ") + text; };
    for (const auto& [index, brdf] : this->Settings.BlocksByIndex)
    {
      if (index >= this->Next)
      {
        add("index " + std::to_string(index));
      }
    }
    for (const auto& [name, brdf] : this->Settings.BlocksByName)
    {
      if (this->Found.count(name) == 0)
      {
        add("name \"" + name + "\"");
      }
    }
    return missing;
  }

  const MaterialSettings& Settings;
  std::unordered_map<vtkPolyData*, Material>& Materials;
  std::set<std::string> Found;
  unsigned int Next;
};

CompositeBlocks::CompositeBlocks(std::shared_ptr<MaterialDrawing> drawing)
  : Drawing(std::move(drawing))
{
}

CompositeBlocks::~CompositeBlocks() = default;

void CompositeBlocks::Update()
{
  const MaterialSettings& settings = this->Drawing->GetSettings();
  vtkDataObject* data = this->Drawing->GetOwner()->GetInputDataObject(0, 0);
  if (data != this->Data || data->GetMTime() != this->DataTime ||
      settings.Time.GetMTime() != this->SettingsTime)
  {
    this->Data = data;
    this->DataTime = data->GetMTime();
    this->SettingsTime = settings.Time.GetMTime();
    ++this->Revision;
    this->Materials.clear();
    Walk walk{ settings, this->Materials, {}, 0 };
    walk.Visit(data, nullptr, { settings.BRDF, false });
    const std::string missing = walk.GetMissing();
    if (!missing.empty())
    {
      this->Drawing->WarnOnce("blocks: " + missing,
        "Materials are set for blocks that the data do not have: " + missing + ".");
    }
  }
  const auto isMapped = [&](const Material& material)
  { return settings.MaterialMap && !material.IsOwn; };
  for (auto it = this->DividedBlocks.begin(); it != this->DividedBlocks.end();)
  {
    const auto known = this->Materials.find(it->first);
    const bool stays = known != this->Materials.end() && isMapped(known->second);
    this->Revision += stays ? 0 : 1;
    it = stays ? std::next(it) : this->DividedBlocks.erase(it);
  }
  for (const auto& [surface, material] : this->Materials)
  {
    if (!isMapped(material))
    {
      continue;
    }
    Divided& block = this->DividedBlocks[surface];
    if (!block.Surface)
    {
      block.Surface = std::make_unique<DividedSurface>(this->Drawing);
    }
    const bool used = block.Surface->Divide(surface);
    const unsigned long revision = block.Surface->GetRevision();
    this->Revision += used != block.IsUsed || revision != block.Revision ? 1 : 0;
    block.IsUsed = used;
    block.Revision = revision;
  }
}

vtkBRDF* CompositeBlocks::GetBRDF(vtkPolyData* block) const
{
  const auto found = this->Materials.find(block);
  return found == this->Materials.end() ? nullptr : found->second.BRDF;
}

bool CompositeBlocks::IsDivided(vtkPolyData* block) const
{
  const auto found = this->DividedBlocks.find(block);
  return found != this->DividedBlocks.end() && found->second.IsUsed;
}

void CompositeBlocks::Begin()
{
  for (auto& [surface, block] : this->DividedBlocks)
  {
    block.IsAnnounced = false;
  }
}

vtkOpenGLPolyDataMapper* CompositeBlocks::Announce(vtkPolyData* surface, const BlockStyle& style)
{
  Divided& block = this->DividedBlocks[surface];
  block.IsAnnounced = true;
  block.Style = style;
  if (!block.Host)
  {
    block.Host = vtkSmartPointer<vtkOpenGLPolyDataMapper>::New();
  }
  return block.Host;
}

void CompositeBlocks::Render(vtkRenderer* renderer, vtkActor* actor)
{
  if (!DrawsColor(renderer, actor) || !IsShaded(actor))
  {
    return; // VTK's class has drawn all blocks
  }
  // As VTK's class decides for its own blocks.
  const bool translucentPass = actor->IsRenderingTranslucentPolygonalGeometry();
  for (const auto& [surface, block] : this->DividedBlocks)
  {
    const BlockStyle& style = block.Style;
    const bool inPass =
      translucentPass
        ? (!style.IsOpaque || actor->GetForceTranslucent()) && !actor->GetForceOpaque()
        : (style.IsOpaque || actor->GetForceOpaque()) && !actor->GetForceTranslucent();
    if (block.IsAnnounced && block.IsUsed && style.IsVisible && inPass)
    {
      block.Surface->Render(
        renderer, actor, block.Host, block.Host->GetMTime(), [](vtkPolyDataMapper*) {}, &style);
    }
  }
}

std::vector<vtkBRDF*> CompositeBlocks::GetBRDFs() const
{
  std::set<vtkBRDF*> brdfs;
  for (const auto& [surface, block] : this->DividedBlocks)
  {
    brdfs.insert(block.Surface->GetBRDFs().begin(), block.Surface->GetBRDFs().end());
  }
  return { brdfs.begin(), brdfs.end() };
}

// All blocks share them.
vtkIdType CompositeBlocks::GetImageBytes() const
{
  vtkIdType bytes = 0;
  for (const auto& [surface, block] : this->DividedBlocks)
  {
    bytes = std::max(bytes, block.Surface->GetImageBytes());
  }
  return bytes;
}

void CompositeBlocks::ReleaseGraphicsResources(vtkWindow* window)
{
  for (const auto& [surface, block] : this->DividedBlocks)
  {
    block.Surface->ReleaseGraphicsResources(window);
  }
}
} // namespace measuredbrdf
