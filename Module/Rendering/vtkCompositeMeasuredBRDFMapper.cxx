// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCompositeMeasuredBRDFMapper.h"

#include "vtkMeasuredBRDFMapperMixin.txx"

#include "BatchBase.h"
#include "BatchOcclusion.h"
#include "BlockMaterials.h"
#include "BlockParts.h"
#include "MapperProperties.h"
#include "vtkObjectFactory.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkPolyData.h"
#include "vtkRadiancePlanner.h"

#include <functional>
#include <set>
#include <unordered_map>
#include <utility>

using namespace measuredbrdf;

namespace
{
using BatchDrawing = vtkMeasuredBRDFMapperInternals;
}

struct vtkCompositeMeasuredBRDFMapper::Internals
{
  std::shared_ptr<MaterialSettings> Settings = std::make_shared<MaterialSettings>();
  std::shared_ptr<BatchDrawing> Drawing; // shared with the batches
  BlockMaterials Blocks;
  std::unique_ptr<BlockParts> Parts; // of blocks of several materials

  // Each material once; which blocks have it shows while they are drawn, and plans for a view with
  // that.
  std::vector<MaterialUse> GetUsesToCome() const
  {
    std::set<vtkBRDF*> brdfs;
    if (!this->Settings->PlanForView)
    {
      brdfs.insert(this->Settings->BRDF);
      for (const auto& [index, brdf] : this->Settings->BlocksByIndex)
      {
        brdfs.insert(brdf);
      }
      for (const auto& [name, brdf] : this->Settings->BlocksByName)
      {
        brdfs.insert(brdf);
      }
    }
    std::vector<MaterialUse> uses;
    for (vtkBRDF* brdf : brdfs)
    {
      uses.push_back({ brdf, {} });
    }
    for (const MaterialUse& use : this->Parts->GetUses())
    {
      if (brdfs.insert(use.first).second)
      {
        uses.push_back(use);
      }
    }
    return uses;
  }

  // Brought up to date while the composite mapper renders, when its input is.
  void UpdateBlocks(vtkAlgorithm* mapper)
  {
    const std::string missing =
      this->Blocks.Update(mapper->GetInputDataObject(0, 0), *this->Settings);
    if (!missing.empty() && this->Drawing->WarnOnce("blocks: " + missing))
    {
      vtkWarningWithObjectMacro(
        mapper, << "Materials are set for blocks that the data do not have: " << missing << ".");
    }
    this->Parts->Update(this->Blocks);
  }
};

namespace
{
// One of the superclass's batches: blocks that are drawn from common buffers. Those of one material
// are drawn while the others are invisible.
class Batch : public vtkMeasuredBRDFMapperMixin<BatchBase>
{
public:
  static Batch* New();
  vtkTypeMacro(Batch, vtkMeasuredBRDFMapperMixin<BatchBase>);

  // update: what brings the blocks' materials up to date.
  void Initialize(std::shared_ptr<BatchDrawing> drawing, const BlockMaterials* materials,
    BlockParts* parts, std::function<void()> update)
  {
    this->Drawing = std::move(drawing);
    this->Materials = materials;
    this->Parts = parts;
    this->UpdateBlocks = std::move(update);
  }

protected:
  Batch() = default;
  ~Batch() override = default;

  std::vector<MaterialUse> GetMaterialUses() override
  {
    this->UpdateBlocks();
    // The superclass may have moved its records of blocks: they are looked up in each frame.
    std::size_t count = 0;
    const unsigned long revision =
      this->Materials->GetRevision() + this->Parts->GetRevision(); // neither ever falls
    bool same = this->Revision == revision;
    this->ForEachBlock(
      [this, &count, &same](vtkPolyData* surface, bool* visible, const BlockStyle& style)
      {
        if (this->Parts->IsDivided(surface))
        {
          this->Parts->Announce(surface, style);
        }
        same = same && count < this->Blocks.size() && this->Blocks[count].Surface == surface;
        if (same)
        {
          this->Blocks[count].Visible = visible;
        }
        ++count;
      });
    if (!same || count != this->Blocks.size())
    {
      this->Revision = revision;
      this->Sort();
    }
    return this->Uses;
  }

  void AddOcclusion(vtkRenderer*) override
  {
    this->Occlusion.Clear();
    this->ForEachBlock([this](vtkPolyData* surface, bool*, const BlockStyle&)
      { this->Occlusion.Announce(this->Drawing->FindOcclusion(surface, false)); });
  }

  void AppendOneBufferObject(vtkRenderer* ren, vtkActor* actor, BlockRecord* record,
    vtkIdType& offset, std::vector<unsigned char>& colors, std::vector<float>& normals) override
  {
    vtkPolyData* surface = GetSurface(record);
    const vtkIdType before = BatchOcclusion::CountVertices(this->VBOs, surface);
    this->vtkMeasuredBRDFMapperMixin<BatchBase>::AppendOneBufferObject(
      ren, actor, record, offset, colors, normals);
    if (BatchOcclusion::CountVertices(this->VBOs, surface) != before)
    {
      this->Occlusion.Append(
        this->VBOs, surface->GetNumberOfPoints(), this->Drawing->FindOcclusion(surface, false));
    }
  }

  void ShowOnly(int material) override
  {
    if (this->Uses.size() < 2 && !this->HasDivided)
    {
      return;
    }
    if (material < 0)
    {
      for (Block& block : this->Blocks)
      {
        *block.Visible = block.IsVisible;
      }
    }
    else if (this->Shown < 0)
    {
      for (Block& block : this->Blocks)
      {
        block.IsVisible = *block.Visible;
        *block.Visible = false;
      }
    }
    else
    {
      for (std::size_t k : this->BlocksOf[static_cast<std::size_t>(this->Shown)])
      {
        *this->Blocks[k].Visible = false;
      }
    }
    this->Shown = material;
    for (std::size_t k = 0;
         material >= 0 && k < this->BlocksOf[static_cast<std::size_t>(material)].size(); ++k)
    {
      Block& block = this->Blocks[this->BlocksOf[static_cast<std::size_t>(material)][k]];
      *block.Visible = block.IsVisible;
    }
  }

private:
  struct Block
  {
    vtkPolyData* Surface;
    bool* Visible;  // the superclass's record
    bool IsVisible; // what it says while others are hidden
  };

  template <typename Record>
  static BlockStyle GetStyle(const Record& block)
  {
    BlockStyle style;
    style.IsVisible = block.Visibility;
    style.IsOpaque = block.IsOpaque;
    style.Opacity = block.Opacity;
    style.OverridesColor = block.OverridesColor;
    std::copy_n(block.AmbientColor.GetData(), 3, style.AmbientColor);
    std::copy_n(block.DiffuseColor.GetData(), 3, style.DiffuseColor);
    return style;
  }

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  template <typename Visit>
  void ForEachBlock(const Visit& visit)
  {
    for (auto& element : this->VTKPolyDataToGLBatchElement)
    {
      auto& block = element.second->Parent;
      visit(block.PolyData, &block.Visibility, GetStyle(block));
    }
  }
#else
  template <typename Visit>
  void ForEachBlock(const Visit& visit)
  {
    for (auto& element : this->Data)
    {
      visit(element.first, &element.second->Visibility, GetStyle(*element.second));
    }
  }
#endif

  void Sort()
  {
    this->Blocks.clear();
    this->Uses.clear();
    this->BlocksOf.clear();
    this->HasDivided = false;
    std::unordered_map<vtkBRDF*, std::size_t> places;
    this->ForEachBlock(
      [this, &places](vtkPolyData* surface, bool* visible, const BlockStyle&)
      {
        if (this->Parts->IsDivided(surface)) // never shown
        {
          this->HasDivided = true;
          this->Blocks.push_back({ surface, visible, true });
          return;
        }
        vtkBRDF* brdf = this->Parts->GetBRDF(surface, *this->Materials);
        const auto [place, isNew] = places.try_emplace(brdf, this->Uses.size());
        if (isNew)
        {
          this->Uses.push_back({ brdf, {} });
          this->BlocksOf.emplace_back();
        }
        this->Uses[place->second].second.push_back(surface);
        this->BlocksOf[place->second].push_back(this->Blocks.size());
        this->Blocks.push_back({ surface, visible, true });
      });
    if (this->Uses.empty()) // nothing is left to show
    {
      this->Uses.push_back({ nullptr, {} });
      this->BlocksOf.emplace_back();
    }
  }

  const BlockMaterials* Materials = nullptr;
  BlockParts* Parts = nullptr;
  std::function<void()> UpdateBlocks;
  std::vector<Block> Blocks; // in the superclass's order
  std::vector<MaterialUse> Uses;
  std::vector<std::vector<std::size_t>> BlocksOf; // of each use
  unsigned long Revision = 0;
  int Shown = -1;
  bool HasDivided = false;
  BatchOcclusion Occlusion;
};

vtkStandardNewMacro(Batch);

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
// Hands blocks to a batch of ours instead of VTK's.
class Delegator : public vtkOpenGLCompositePolyDataMapperDelegator
{
public:
  static Delegator* New();
  vtkTypeMacro(Delegator, vtkOpenGLCompositePolyDataMapperDelegator);

  void SetBatch(Batch* batch)
  {
    this->GLDelegate = batch;
    this->Delegate = batch;
  }
};

vtkStandardNewMacro(Delegator);
#endif
}

template class vtkMeasuredBRDFMapperMixin<BatchBase>;

vtkStandardNewMacro(vtkCompositeMeasuredBRDFMapper);

//------------------------------------------------------------------------------
vtkCompositeMeasuredBRDFMapper::vtkCompositeMeasuredBRDFMapper()
  : Impl(new Internals)
{
  this->Impl->Drawing = std::make_shared<BatchDrawing>(
    this, this->Impl->Settings, [this]() { return this->Impl->GetUsesToCome(); });
  this->Impl->Drawing->SetPlansMapsForView(false); // blocks would plan one after the other
  this->Impl->Parts = std::make_unique<BlockParts>(this->Impl->Drawing);
}

//------------------------------------------------------------------------------
vtkCompositeMeasuredBRDFMapper::~vtkCompositeMeasuredBRDFMapper() = default;

//------------------------------------------------------------------------------
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
vtkCompositePolyDataMapperDelegator* vtkCompositeMeasuredBRDFMapper::CreateADelegator()
{
  vtkNew<Batch> batch;
  batch->Initialize(this->Impl->Drawing, &this->Impl->Blocks, this->Impl->Parts.get(),
    [this]() { this->Impl->UpdateBlocks(this); });
  Delegator* delegator = Delegator::New();
  delegator->SetBatch(batch);
  return delegator;
}
#else
vtkCompositeMapperHelper2* vtkCompositeMeasuredBRDFMapper::CreateHelper()
{
  Batch* batch = Batch::New();
  batch->Initialize(this->Impl->Drawing, &this->Impl->Blocks, this->Impl->Parts.get(),
    [this]() { this->Impl->UpdateBlocks(this); });
  return batch;
}
#endif

// Strings come by value, as VTK's macros take them:
// NOLINTNEXTLINE(performance-unnecessary-value-param)
MEASUREDBRDF_MAPPER_PROPERTIES(vtkCompositeMeasuredBRDFMapper, *this->Impl->Settings)

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::SetBlockBRDF(unsigned int flatIndex, vtkBRDF* brdf)
{
  this->Impl->Settings->BlocksByIndex[flatIndex] = brdf;
  this->Impl->Settings->Time.Modified();
}

//------------------------------------------------------------------------------
vtkBRDF* vtkCompositeMeasuredBRDFMapper::GetBlockBRDF(unsigned int flatIndex)
{
  const auto found = this->Impl->Settings->BlocksByIndex.find(flatIndex);
  return found == this->Impl->Settings->BlocksByIndex.end() ? nullptr : found->second.Get();
}

//------------------------------------------------------------------------------
bool vtkCompositeMeasuredBRDFMapper::HasBlockBRDF(unsigned int flatIndex)
{
  return this->Impl->Settings->BlocksByIndex.count(flatIndex) > 0;
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::RemoveBlockBRDF(unsigned int flatIndex)
{
  this->Impl->Settings->BlocksByIndex.erase(flatIndex);
  this->Impl->Settings->Time.Modified();
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::SetBlockBRDFByName(const std::string& name, vtkBRDF* brdf)
{
  this->Impl->Settings->BlocksByName[name] = brdf;
  this->Impl->Settings->Time.Modified();
}

//------------------------------------------------------------------------------
vtkBRDF* vtkCompositeMeasuredBRDFMapper::GetBlockBRDFByName(const std::string& name)
{
  const auto found = this->Impl->Settings->BlocksByName.find(name);
  return found == this->Impl->Settings->BlocksByName.end() ? nullptr : found->second.Get();
}

//------------------------------------------------------------------------------
bool vtkCompositeMeasuredBRDFMapper::HasBlockBRDFByName(const std::string& name)
{
  return this->Impl->Settings->BlocksByName.count(name) > 0;
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::RemoveBlockBRDFByName(const std::string& name)
{
  this->Impl->Settings->BlocksByName.erase(name);
  this->Impl->Settings->Time.Modified();
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::RemoveBlockBRDFs()
{
  this->Impl->Settings->BlocksByIndex.clear();
  this->Impl->Settings->BlocksByName.clear();
  this->Impl->Settings->Time.Modified();
}

//------------------------------------------------------------------------------
std::string vtkCompositeMeasuredBRDFMapper::GetPlan()
{
  return DescribePlans(this->Impl->Drawing->GetLastFrame());
}

//------------------------------------------------------------------------------
bool vtkCompositeMeasuredBRDFMapper::GetPlanPending()
{
  return this->Impl->Drawing->GetPlans().IsPending();
}

//------------------------------------------------------------------------------
bool vtkCompositeMeasuredBRDFMapper::GetPlanReady()
{
  return this->Impl->Drawing->GetPlans().IsReady();
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::SetAbortPlanning(bool abort)
{
  this->Impl->Drawing->SetAbortPlanning(abort);
}

//------------------------------------------------------------------------------
bool vtkCompositeMeasuredBRDFMapper::GetAbortPlanning()
{
  return this->Impl->Drawing->GetAbortPlanning();
}

//------------------------------------------------------------------------------
double vtkCompositeMeasuredBRDFMapper::FitProperty(vtkProperty* property)
{
  return vtkPBRPropertyFitter::Fit(this->GetBRDF(), property);
}

//------------------------------------------------------------------------------
vtkIdType vtkCompositeMeasuredBRDFMapper::GetTextureBytes()
{
  return CountTextureBytes(this->Impl->Drawing->GetLastFrame());
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkCompositeMeasuredBRDFMapper::SafeDownCast(mapper))
  {
    this->Impl->Settings->Copy(*other->Impl->Settings);
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::Render(vtkRenderer* renderer, vtkActor* actor)
{
  const Depth inside(this->RenderDepth);
  this->Impl->Parts->Begin();
  this->Superclass::Render(renderer, actor);
  this->Impl->Parts->Render(renderer, actor, this, this->Superclass::GetMTime());
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->RenderDepth == 0)
  {
    this->Impl->Parts->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkCompositeMeasuredBRDFMapper::GetMTime()
{
  // While drawing, the superclass asks whether its batches are out of date.
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->RenderDepth > 0 ? time : std::max(time, this->Impl->Drawing->GetAppearanceMTime());
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Impl->Settings->Print(os, indent);
  for (const auto& [index, brdf] : this->Impl->Settings->BlocksByIndex)
  {
    os << indent << "BlockBRDF " << index << ": " << brdf.Get() << "\n";
  }
  for (const auto& [name, brdf] : this->Impl->Settings->BlocksByName)
  {
    os << indent << "BlockBRDF \"" << name << "\": " << brdf.Get() << "\n";
  }
  os << indent << "Plan: " << this->GetPlan() << "\n";
}
