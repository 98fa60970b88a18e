// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockBatch.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper.h"
#else
#include "vtkCompositePolyDataMapper2.h"
#endif

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace measuredbrdf
{
vtkStandardNewMacro(BlockBatch);

namespace
{
// Vertices that are in the buffers so far.
vtkIdType CountVertices(vtkOpenGLVertexBufferObjectGroup* buffers, vtkPolyData* surface)
{
  vtkIdType place = 0;
  vtkIdType count = 0;
  if (surface && surface->GetPoints())
  {
    buffers->ArrayExists("vertexMC", surface->GetPoints()->GetData(), place, count);
  }
  return count;
}
}

void BlockBatch::Initialize(std::shared_ptr<MaterialDrawing> drawing, CompositeBlocks* blocks)
{
  this->Drawing = std::move(drawing);
  this->All = blocks;
}

// With all that the data set says of the block. Since VTK 9.3 each may have its own scalars.
template <typename Record>
void BlockBatch::Announce(vtkPolyData* surface, const Record& block)
{
  BlockStyle style;
  style.IsVisible = block.Visibility;
  style.IsOpaque = block.IsOpaque;
  style.Opacity = block.Opacity;
  style.OverridesColor = block.OverridesColor;
  std::copy_n(block.AmbientColor.GetData(), 3, style.AmbientColor);
  std::copy_n(block.DiffuseColor.GetData(), 3, style.DiffuseColor);
  vtkOpenGLPolyDataMapper* host = this->All->Announce(surface, style);
  // Their own times: the lookup table that both share may be newer. Without a comparison the host
  // would go back and forth between both.
  if (host->vtkObject::GetMTime() < this->vtkObject::GetMTime())
  {
    host->vtkMapper::ShallowCopy(this);
  }
  host->SetSeamlessU(this->GetSeamlessU());
  host->SetSeamlessV(this->GetSeamlessV());
  host->SetVBOShiftScaleMethod(this->GetVBOShiftScaleMethod());
  host->SetSelection(this->GetSelection());
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  host->SetScalarVisibility(block.ScalarVisibility);
  host->SetUseLookupTableScalarRange(block.UseLookupTableScalarRange);
  host->SetInterpolateScalarsBeforeMapping(block.InterpolateScalarsBeforeMapping);
  host->SetColorMode(block.ColorMode);
  host->SetScalarMode(block.ScalarMode);
  host->SetArrayAccessMode(block.ArrayAccessMode);
  host->SetArrayComponent(block.ArrayComponent);
  host->SetArrayId(block.ArrayId);
  host->SetArrayName(std::string(block.ArrayName).c_str());
  host->SetFieldDataTupleId(block.FieldDataTupleId);
  host->SetScalarRange(block.ScalarRange[0], block.ScalarRange[1]);
  host->SetLookupTable(block.LookupTable);
#endif
}

template <typename Visit>
void BlockBatch::ForEachBlock(const Visit& visit)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  for (auto& element : this->VTKPolyDataToGLBatchElement)
  {
    visit(element.second->Parent.PolyData, element.second->Parent);
  }
#else
  for (auto& element : this->Data)
  {
    visit(element.first, *element.second);
  }
#endif
}

std::vector<vtkBRDF*> BlockBatch::GetBRDFs()
{
  this->All->Update();
  // The superclass may have moved its records of blocks: they are looked up in each frame.
  std::size_t count = 0;
  bool same = this->Revision == this->All->GetRevision();
  this->ForEachBlock(
    [&](vtkPolyData* surface, auto& record)
    {
      if (this->All->IsDivided(surface))
      {
        this->Announce(surface, record);
      }
      same = same && count < this->Blocks.size() && this->Blocks[count].Surface == surface;
      if (same)
      {
        this->Blocks[count].Visible = &record.Visibility;
      }
      ++count;
    });
  if (!same || count != this->Blocks.size())
  {
    this->Revision = this->All->GetRevision();
    this->Sort();
  }
  return this->BRDFs;
}

void BlockBatch::AddOcclusion(vtkRenderer*)
{
  this->Sides = {};
  this->Announced.clear();
  this->Occlusion.clear();
  bool any = false;
  this->ForEachBlock(
    [this, &any](vtkPolyData* surface, const auto&)
    {
      this->CheckVertices(surface);
      const auto arrays = this->Drawing->FindOcclusion(surface, this, false);
      this->Announced[surface] = arrays;
      this->Sides.Add(arrays.get());
      any = any || arrays;
    });
  if (!any)
  {
    this->Announced.clear();
  }
}

void BlockBatch::AppendOneBufferObject(vtkRenderer* ren, vtkActor* actor, BlockRecord* record,
  vtkIdType& offset, std::vector<unsigned char>& colors, std::vector<float>& normals)
{
  vtkPolyData* surface = GetSurface(record);
  const vtkIdType before = CountVertices(this->VBOs, surface);
  this->ShadedMapper<BatchBase>::AppendOneBufferObject(ren, actor, record, offset, colors, normals);
  if (!this->Announced.empty() && CountVertices(this->VBOs, surface) != before)
  {
    this->Occlusion.push_back(OcclusionArrays::Complete(this->Announced[surface].get(),
      surface->GetNumberOfPoints(), this->Sides.Both, this->Sides.Bounced));
    this->Occlusion.back().ForEachAttribute(
      [this](const std::string& name, vtkDataArray* values)
      {
        if (values)
        {
          this->VBOs->AppendDataArray(name.c_str(), values, VTK_FLOAT);
        }
      });
  }
}

void BlockBatch::ShowOnly(int material)
{
  if (this->BRDFs.size() < 2 && !this->HasDivided)
  {
    return;
  }
  for (Block& block : this->Blocks)
  {
    block.IsVisible = this->Shown < 0 ? *block.Visible : block.IsVisible;
    *block.Visible = block.IsVisible && (material < 0 || block.Use == material);
  }
  this->Shown = material;
}

void BlockBatch::Sort()
{
  this->Blocks.clear();
  this->BRDFs.clear();
  this->HasDivided = false;
  std::map<vtkBRDF*, int> places;
  this->ForEachBlock(
    [&](vtkPolyData* surface, auto& record)
    {
      if (this->All->IsDivided(surface)) // never shown
      {
        this->HasDivided = true;
        this->Blocks.push_back({ surface, &record.Visibility, true, -1 });
        return;
      }
      vtkBRDF* brdf = this->All->GetBRDF(surface);
      const auto [place, isNew] = places.try_emplace(brdf, static_cast<int>(this->BRDFs.size()));
      if (isNew)
      {
        this->BRDFs.push_back(brdf);
      }
      this->Blocks.push_back({ surface, &record.Visibility, true, place->second });
    });
  if (this->BRDFs.empty()) // nothing is left to show
  {
    this->BRDFs.push_back(nullptr);
  }
}
} // namespace measuredbrdf
