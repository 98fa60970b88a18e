// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceVisibilityFilter.h"

#include "ContentHash.h"
#include "ParallelFor.h"
#include "Setters.h"
#include "SurfacePoints.h"
#include "SurfaceTracer.h"
#include "VisibilityTask.h"
#include "vtkActor.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace measuredbrdf;

namespace
{
// In place of all that an earlier run left there: the key speaks for all of them.
void AddArrays(vtkPolyData* surface, const SurfaceArrays& arrays, bool bounce)
{
  vtkPointData* data = surface->GetPointData();
  const auto replace = [data](const std::string& name, vtkUnsignedCharArray* array)
  {
    data->RemoveArray(name.c_str());
    if (array)
    {
      array->SetName(name.c_str());
      data->AddArray(array);
    }
  };
  for (std::size_t k = 0; k < 2; ++k)
  {
    const std::string suffix = k == 0 ? "" : "Back";
    const SideArrays side = k < arrays.Sides.size() ? arrays.Sides[k] : SideArrays();
    replace(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName() + suffix, side.Sky);
    replace(vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() + suffix, side.Light);
    replace(vtkSurfaceVisibilityFilter::GetBouncedLightArrayName() + suffix,
      bounce ? side.Bounced : nullptr);
  }
  vtkNew<vtkStringArray> key;
  key->SetName(vtkSurfaceVisibilityFilter::GetKeyArrayName());
  key->InsertNextValue(SurfaceKeyVersion + arrays.Key);
  vtkNew<vtkFieldData> fields; // the input's own is shared
  fields->ShallowCopy(surface->GetFieldData());
  fields->AddArray(key);
  surface->SetFieldData(fields);
}
}

struct vtkSurfaceVisibilityFilter::Internals
{
  struct Occluder
  {
    vtkSmartPointer<vtkPolyData> Surface;
    vtkSmartPointer<vtkMatrix4x4> Matrix; // null: none
  };
  std::vector<Occluder> Occluders;

  // What was traced last.
  std::string Key;
  bool HasBounce = false;
  std::vector<SurfaceArrays> Arrays;

  std::string MakeKey(
    vtkSurfaceVisibilityFilter* self, const std::vector<vtkPolyData*>& surfaces) const
  {
    ContentHash hash;
    hash.AddValue(self->NumberOfRays);
    hash.AddValue(self->MaximumDistance);
    hash.AddValue(self->BothSides);
    hash.AddValue(self->SelfOcclusion);
    for (vtkPolyData* surface : surfaces)
    {
      hash.AddText(GetSurfaceKey(surface));
    }
    for (const Occluder& occluder : this->Occluders)
    {
      hash.AddText(GetSurfaceKey(occluder.Surface));
      if (occluder.Matrix)
      {
        hash.Add(occluder.Matrix->GetData(), 16 * sizeof(double));
      }
    }
    return hash.GetText();
  }

  // Traces what is asked for and not there; what was there stays until it is. Returns whether there
  // is all: tracing may be aborted.
  bool Update(vtkSurfaceVisibilityFilter* self, vtkDataObject* input)
  {
    const auto surfaces = vtkCompositeDataSet::GetDataSets<vtkPolyData>(input);
    const std::string key = this->MakeKey(self, surfaces);
    const bool isKnown = key == this->Key;
    if (isKnown && (!self->Bounce || this->HasBounce))
    {
      return true;
    }
    SurfaceTracer tracer; // of the surfaces first, in their order
    for (vtkPolyData* surface : surfaces)
    {
      if (self->SelfOcclusion)
      {
        tracer.AddSurface(surface);
      }
    }
    for (const Occluder& occluder : this->Occluders)
    {
      tracer.AddSurface(occluder.Surface, occluder.Matrix ? occluder.Matrix->GetData() : nullptr);
    }
    tracer.Build();
    const double farthest =
      self->MaximumDistance > 0.0 ? self->MaximumDistance : std::numeric_limits<double>::infinity();
    std::vector<SurfaceArrays> traced = isKnown ? this->Arrays : std::vector<SurfaceArrays>();
    const auto report = [self](double progress)
    {
      self->UpdateProgress(progress);
      return !self->GetAbortExecute();
    };
    if (!TraceVisibility(tracer, surfaces,
          { self->NumberOfRays, self->BothSides, self->SelfOcclusion, farthest, !isKnown,
            self->Bounce },
          report, traced))
    {
      return false;
    }
    this->Arrays = std::move(traced);
    this->HasBounce = self->Bounce;
    this->Key = key;
    ++self->NumberOfTraces;
    return true;
  }

  // whole: with arrays.
  void PassOn(
    vtkSurfaceVisibilityFilter* self, vtkDataObject* input, vtkDataObject* output, bool whole) const
  {
    auto* composite = vtkCompositeDataSet::SafeDownCast(input);
    if (!composite)
    {
      output->ShallowCopy(input);
      if (whole && !this->Arrays.empty())
      {
        AddArrays(vtkPolyData::SafeDownCast(output), this->Arrays[0], self->Bounce);
      }
      return;
    }
    auto* blocks = vtkCompositeDataSet::SafeDownCast(output);
    blocks->CopyStructure(composite);
    blocks->GetFieldData()->ShallowCopy(composite->GetFieldData());
    auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    std::size_t number = 0;
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      vtkDataObject* block = it->GetCurrentDataObject();
      auto copy = vtkSmartPointer<vtkDataObject>::Take(block->NewInstance());
      copy->ShallowCopy(block);
      auto* surface = vtkPolyData::SafeDownCast(copy);
      if (surface && whole)
      {
        AddArrays(surface, this->Arrays[number++], self->Bounce);
      }
      blocks->SetDataSet(it, copy);
    }
  }
};

vtkStandardNewMacro(vtkSurfaceVisibilityFilter);

//------------------------------------------------------------------------------
vtkSurfaceVisibilityFilter::vtkSurfaceVisibilityFilter()
  : Impl(new Internals)
{
}

//------------------------------------------------------------------------------
vtkSurfaceVisibilityFilter::~vtkSurfaceVisibilityFilter() = default;

//------------------------------------------------------------------------------
void vtkSurfaceVisibilityFilter::SetNumberOfRays(int numberOfRays)
{
  const int clamped = std::clamp(numberOfRays, 64, 4096);
  if (clamped != numberOfRays)
  {
    vtkWarningMacro("SetNumberOfRays: " << numberOfRays << " is not from 64 to 4096; " << clamped
                                        << " is taken.");
  }
  const int rounded = clamped / HorizonCode::Sectors * HorizonCode::Sectors;
  measuredbrdfAssignMacro(NumberOfRays, rounded);
}

measuredbrdfSetClampedMacro(
  vtkSurfaceVisibilityFilter, MaximumDistance, double, 0.0, VTK_DOUBLE_MAX);

//------------------------------------------------------------------------------
void vtkSurfaceVisibilityFilter::AddOccluder(vtkPolyData* surface, vtkMatrix4x4* matrix)
{
  if (!surface)
  {
    vtkErrorMacro("AddOccluder: there is no surface.");
    return;
  }
  Internals::Occluder occluder;
  occluder.Surface = surface;
  occluder.Matrix = matrix;
  this->Impl->Occluders.push_back(occluder);
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkSurfaceVisibilityFilter::AddOccluder(vtkActor* actor, vtkActor* self)
{
  vtkMapper* mapper = actor ? actor->GetMapper() : nullptr;
  if (mapper && mapper->GetNumberOfInputConnections(0) > 0)
  {
    mapper->Update();
  }
  const std::vector<vtkPolyData*> surfaces = vtkCompositeDataSet::GetDataSets<vtkPolyData>(
    mapper ? mapper->GetInputDataObject(0, 0) : nullptr);
  vtkNew<vtkMatrix4x4> matrix;
  if (self)
  {
    vtkMatrix4x4::Invert(self->GetMatrix(), matrix);
  }
  if (surfaces.empty() || (self && self->GetMatrix()->Determinant() == 0.0))
  {
    vtkErrorMacro("AddOccluder: " << (surfaces.empty() ? "the actor shows no polydata."
                                                       : "the matrix of self has no inverse."));
    return false;
  }
  vtkMatrix4x4::Multiply4x4(matrix, actor->GetMatrix(), matrix);
  for (vtkPolyData* surface : surfaces)
  {
    this->AddOccluder(surface, matrix);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkSurfaceVisibilityFilter::RemoveAllOccluders()
{
  if (!this->Impl->Occluders.empty())
  {
    this->Impl->Occluders.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkSurfaceVisibilityFilter::GetNumberOfOccluders()
{
  return static_cast<int>(this->Impl->Occluders.size());
}

//------------------------------------------------------------------------------
vtkMTimeType vtkSurfaceVisibilityFilter::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (const Internals::Occluder& occluder : this->Impl->Occluders)
  {
    time = std::max(time, occluder.Surface->GetMTime());
    time = std::max(time, occluder.Matrix ? occluder.Matrix->GetMTime() : 0);
  }
  return time;
}

//------------------------------------------------------------------------------
int vtkSurfaceVisibilityFilter::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkSurfaceVisibilityFilter::RequestData(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  if (!input || !output)
  {
    return 0;
  }
  bool whole = false; // where memory runs out, say, the surface is passed on without arrays
  RunGuarded(this, "RequestData", [&]() { whole = this->Impl->Update(this, input); });
  const bool passed =
    RunGuarded(this, "RequestData", [&]() { this->Impl->PassOn(this, input, output, whole); });
  return passed ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkSurfaceVisibilityFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRays: " << this->NumberOfRays << "\n";
  os << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
  os << indent << "BothSides: " << (this->BothSides ? "On" : "Off") << "\n";
  os << indent << "Bounce: " << (this->Bounce ? "On" : "Off") << "\n";
  os << indent << "SelfOcclusion: " << (this->SelfOcclusion ? "On" : "Off") << "\n";
  os << indent << "NumberOfOccluders: " << this->GetNumberOfOccluders() << "\n";
  os << indent << "NumberOfTraces: " << this->NumberOfTraces << "\n";
}
