// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCompositeMeasuredBRDFMapper.h"

#include "BlockBatch.h"
#include "CompositeBlocks.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkPolyData.h"
#include "vtkRadiancePlanner.h"
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkOpenGLCompositePolyDataMapperDelegator.h"
#endif

#include <set>
#include <utility>

using namespace measuredbrdf;

struct vtkCompositeMeasuredBRDFMapper::Internals
{
  explicit Internals(vtkMapper* self)
    : Drawing(std::make_shared<MaterialDrawing>(self, [this]() { return this->Blocks.GetBRDFs(); }))
    , Settings(Drawing->GetSettings())
    , Blocks(Drawing)
  {
  }

  std::shared_ptr<MaterialDrawing> Drawing; // shared with the batches
  MaterialSettings& Settings;
  CompositeBlocks Blocks;
  int RenderDepth = 0; // greater than 0 inside of Render
};

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
namespace
{
// Hands blocks to a batch of ours instead of VTK's.
class Delegator : public vtkOpenGLCompositePolyDataMapperDelegator
{
public:
  static Delegator* New();
  vtkTypeMacro(Delegator, vtkOpenGLCompositePolyDataMapperDelegator);

  void SetBatch(BlockBatch* batch)
  {
    this->GLDelegate = batch;
    this->Delegate = batch;
  }
};

vtkStandardNewMacro(Delegator);
}
#endif

vtkStandardNewMacro(vtkCompositeMeasuredBRDFMapper);

//------------------------------------------------------------------------------
vtkCompositeMeasuredBRDFMapper::vtkCompositeMeasuredBRDFMapper()
  : Impl(std::make_unique<Internals>(this))
{
}

//------------------------------------------------------------------------------
vtkCompositeMeasuredBRDFMapper::~vtkCompositeMeasuredBRDFMapper() = default;

//------------------------------------------------------------------------------
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
vtkCompositePolyDataMapperDelegator* vtkCompositeMeasuredBRDFMapper::CreateADelegator()
{
  vtkNew<BlockBatch> batch;
  batch->Initialize(this->Impl->Drawing, &this->Impl->Blocks);
  Delegator* delegator = Delegator::New();
  delegator->SetBatch(batch);
  return delegator;
}
#else
vtkCompositeMapperHelper2* vtkCompositeMeasuredBRDFMapper::CreateHelper()
{
  BlockBatch* batch = BlockBatch::New();
  batch->Initialize(this->Impl->Drawing, &this->Impl->Blocks);
  return batch;
}
#endif

//------------------------------------------------------------------------------
measuredbrdfAllSettingsMacro(vtkCompositeMeasuredBRDFMapper);
measuredbrdfDrawingMacro(vtkCompositeMeasuredBRDFMapper);

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::SetBlockBRDF(unsigned int flatIndex, vtkBRDF* brdf)
{
  this->Impl->Settings.BlocksByIndex[flatIndex] = brdf;
  this->Impl->Settings.Time.Modified();
}

//------------------------------------------------------------------------------
vtkBRDF* vtkCompositeMeasuredBRDFMapper::GetBlockBRDF(unsigned int flatIndex)
{
  const auto found = this->Impl->Settings.BlocksByIndex.find(flatIndex);
  return found == this->Impl->Settings.BlocksByIndex.end() ? nullptr : found->second.Get();
}

//------------------------------------------------------------------------------
bool vtkCompositeMeasuredBRDFMapper::HasBlockBRDF(unsigned int flatIndex)
{
  return this->Impl->Settings.BlocksByIndex.count(flatIndex) > 0;
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::RemoveBlockBRDF(unsigned int flatIndex)
{
  this->Impl->Settings.BlocksByIndex.erase(flatIndex);
  this->Impl->Settings.Time.Modified();
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::SetBlockBRDFByName(const std::string& name, vtkBRDF* brdf)
{
  this->Impl->Settings.BlocksByName[name] = brdf;
  this->Impl->Settings.Time.Modified();
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::RemoveBlockBRDFs()
{
  this->Impl->Settings.BlocksByIndex.clear();
  this->Impl->Settings.BlocksByName.clear();
  this->Impl->Settings.Time.Modified();
}

//------------------------------------------------------------------------------
std::string vtkCompositeMeasuredBRDFMapper::GetPlan()
{
  return DescribePlans(this->Impl->Drawing->GetLastFrame()) +
         this->Impl->Drawing->DescribeOcclusion();
}

//------------------------------------------------------------------------------
vtkIdType vtkCompositeMeasuredBRDFMapper::GetTextureBytes()
{
  std::set<const vtkTextureObject*> counted;
  return CountTextureBytes(this->Impl->Drawing->GetLastFrame(), counted) +
         this->Impl->Blocks.GetImageBytes();
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (!mapper)
  {
    return; // the superclass wants one
  }
  if (auto* other = vtkCompositeMeasuredBRDFMapper::SafeDownCast(mapper))
  {
    this->Impl->Settings.Copy(other->Impl->Settings);
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::Render(vtkRenderer* renderer, vtkActor* actor)
{
  if (!renderer || !actor)
  {
    return; // the superclass wants both
  }
  const Restored inside(this->Impl->RenderDepth);
  ++this->Impl->RenderDepth;
  this->Impl->Blocks.Begin();
  vtkObject* style = this->GetCompositeDataDisplayAttributes();
  this->Impl->Drawing->Render(
    renderer, actor,
    [&]()
    {
      this->Superclass::Render(renderer, actor);
      this->Impl->Blocks.Render(renderer, actor);
    },
    style ? style->GetMTime() : 0);
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Impl->RenderDepth == 0)
  {
    this->Impl->Blocks.ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkCompositeMeasuredBRDFMapper::GetMTime()
{
  // While drawing, the superclass asks whether its batches are out of date.
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->Impl->RenderDepth > 0 ? time
                                     : std::max(time, this->Impl->Drawing->GetAppearanceMTime());
}

//------------------------------------------------------------------------------
void vtkCompositeMeasuredBRDFMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Impl->Settings.Print(os, indent);
  for (const auto& [index, brdf] : this->Impl->Settings.BlocksByIndex)
  {
    os << indent << "BlockBRDF " << index << ": " << brdf.Get() << "\n";
  }
  for (const auto& [name, brdf] : this->Impl->Settings.BlocksByName)
  {
    os << indent << "BlockBRDF \"" << name << "\": " << brdf.Get() << "\n";
  }
  os << indent << "Plan: " << this->GetPlan() << "\n";
}
