// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedTrace.h"

#include "ContentHash.h"
#include "ScopedErrorCapture.h"
#include "SharedObjects.h"
#include "SurfaceBlocks.h"
#include "SurfacePoints.h"
#include "vtkCommand.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace measuredbrdf
{
namespace
{
constexpr std::chrono::milliseconds Patience(20); // until goesOn is asked again
}

void CopyTraced(vtkPolyData* from, vtkPolyData* to)
{
  for (const std::string name : { vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName(),
         vtkSurfaceVisibilityFilter::GetHiddenLightArrayName(),
         vtkSurfaceVisibilityFilter::GetBouncedLightArrayName() })
  {
    for (const std::string& full : { name, name + "Back" })
    {
      to->GetPointData()->RemoveArray(full.c_str());
      if (vtkAbstractArray* array = from->GetPointData()->GetAbstractArray(full.c_str()))
      {
        to->GetPointData()->AddArray(array);
      }
    }
  }
  vtkNew<vtkFieldData> fields; // the surface's own is shared
  fields->ShallowCopy(to->GetFieldData());
  fields->AddArray(
    from->GetFieldData()->GetAbstractArray(vtkSurfaceVisibilityFilter::GetKeyArrayName()));
  to->SetFieldData(fields);
}

std::string GetContentKey(vtkDataObject* input)
{
  ContentHash hash;
  for (vtkPolyData* surface : GetBlocks(input))
  {
    hash.AddText(GetSurfaceKey(surface));
  }
  return hash.GetText();
}

vtkSmartPointer<vtkPolyData> CopyGeometry(vtkPolyData* surface)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->SetPoints(surface->GetPoints());
  copy->SetPolys(surface->GetPolys());
  copy->SetStrips(surface->GetStrips());
  copy->GetPointData()->SetNormals(surface->GetPointData()->GetNormals());
  return copy;
}

SharedTrace::SharedTrace() = default;

SharedTrace::~SharedTrace() = default;

std::shared_ptr<SharedTrace> SharedTrace::Find(vtkDataObject* input)
{
  const std::string content = GetContentKey(input);
  // Never destroyed: VTK may be gone when statics are.
  static auto& traces = *new HeldObjects<std::string, SharedTrace>;
  return traces.FindOrMake(content, []() { return std::make_shared<SharedTrace>(); });
}

vtkSmartPointer<vtkDataObject> SharedTrace::Attach(
  vtkDataObject* input, bool withBounce, const std::function<bool()>& goesOn)
{
  std::unique_lock<std::recursive_timed_mutex> lock(this->Mutex, std::defer_lock);
  while (!lock.try_lock_for(Patience))
  {
    if (!goesOn())
    {
      return nullptr;
    }
  }
  if (this->GoesOn)
  {
    // The filter's progress has led back to here, on the thread that traces.
    return SharedTrace().Attach(input, withBounce, goesOn);
  }
  if (!GetBlocks(input).empty() && !this->Has(withBounce))
  {
    this->Trace(input, withBounce, goesOn);
    if (!this->Has(withBounce))
    {
      return nullptr;
    }
  }
  std::size_t number = 0;
  return CopyBlocks(input,
    [this, &number](vtkPolyData* surface)
    {
      auto copy = vtkSmartPointer<vtkPolyData>::New();
      copy->ShallowCopy(surface);
      CopyTraced(this->Arrays[number++], copy);
      return copy;
    });
}

void SharedTrace::Trace(vtkDataObject* input, bool withBounce, const std::function<bool()>& goesOn)
{
  if (!this->Filter)
  {
    this->Filter = vtkSmartPointer<vtkSurfaceVisibilityFilter>::New();
    this->Filter->BothSidesOn(); // whichever way the normals point
  }
  vtkSmartPointer<vtkSurfaceVisibilityFilter> filter =
    std::move(this->Filter); // back if all goes well
  this->GoesOn = goesOn;
  const unsigned long tag =
    filter->AddObserver(vtkCommand::ProgressEvent, this, &SharedTrace::Follow);
  // Whatever happens, the filter has neither observer nor input afterwards.
  const std::shared_ptr<vtkSurfaceVisibilityFilter> end(filter.Get(),
    [this, tag](vtkSurfaceVisibilityFilter* traced)
    {
      traced->RemoveObserver(tag);
      traced->SetInputDataObject(nullptr);
      this->GoesOn = nullptr;
    });
  filter->SetAbortExecute(0); // VTK 9.3 and later keep an earlier stop
  filter->SetInputDataObject(CopyBlocks(input, CopyGeometry));
  filter->SetBounce(withBounce);
  const int before = filter->GetNumberOfTraces();
  const ScopedErrorCapture error(filter);
  filter->Update();
  if (!error.GetText().empty()) // no memory, say
  {
    throw std::runtime_error(error.GetText());
  }
  if (filter->GetNumberOfTraces() > before)
  {
    ++this->NumberOfTraces;
    this->HasBounce = withBounce;
    this->Arrays.clear();
    for (vtkPolyData* surface : GetBlocks(filter->GetOutputDataObject(0)))
    {
      this->Arrays.push_back(vtkSmartPointer<vtkPolyData>::New());
      CopyTraced(surface, this->Arrays.back());
    }
  }
  filter->GetOutputDataObject(0)->Initialize(); // the arrays are enough
  this->Filter = filter;
}

// A stop is asked for by the filter's own thread: a request from another one could come before it
// begins.
void SharedTrace::Follow(vtkObject* filter, unsigned long, void*)
{
  if (!this->GoesOn())
  {
    vtkSurfaceVisibilityFilter::SafeDownCast(filter)->SetAbortExecute(1);
  }
}
} // namespace measuredbrdf
