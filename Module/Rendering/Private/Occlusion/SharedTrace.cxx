// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedTrace.h"

#include "ContentHash.h"
#include "SurfaceBlocks.h"
#include "SurfacePoints.h"
#include "TakenError.h"
#include "vtkCommand.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <chrono>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>

namespace measuredbrdf
{
namespace
{
constexpr std::chrono::milliseconds Patience(20); // until goesOn is asked again

using Traces = std::map<std::string, std::weak_ptr<SharedTrace>>;

// Never destroyed: VTK may be gone when statics are.
Traces& GetTraces()
{
  static Traces& traces = *new Traces;
  return traces;
}

std::string GetContent(vtkDataObject* input)
{
  ContentHash hash;
  for (vtkPolyData* surface : GetBlocks(input))
  {
    hash.AddText(GetSurfaceKey(surface));
  }
  return hash.GetText();
}

// The filter's arrays in place of those of another surface that may be there.
void MoveArrays(vtkPolyData* from, vtkPolyData* to)
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

vtkSmartPointer<vtkPolyData> ShallowCopy(vtkPolyData* surface)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(surface);
  return copy;
}

// What the filter reads, so that nothing else is held.
vtkSmartPointer<vtkPolyData> CopyGeometry(vtkPolyData* surface)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->SetPoints(surface->GetPoints());
  copy->SetPolys(surface->GetPolys());
  copy->SetStrips(surface->GetStrips());
  copy->GetPointData()->SetNormals(surface->GetPointData()->GetNormals());
  return copy;
}
}

// A trace's stop is asked for by the filter's own thread: a request from another one could come
// before it begins. Whatever happens, the filter has neither observer nor input afterwards.
class SharedTrace::Run
{
public:
  Run(vtkSurfaceVisibilityFilter* filter, vtkDataObject* input, const std::function<bool()>& goesOn)
    : Filter(filter)
    , GoesOn(goesOn)
  {
    this->Tag = filter->AddObserver(vtkCommand::ProgressEvent, this, &Run::Follow);
    filter->SetAbortExecute(0); // VTK 9.3 and later keep an earlier stop
    filter->SetInputDataObject(input);
  }
  ~Run()
  {
    this->Filter->RemoveObserver(this->Tag);
    this->Filter->SetInputDataObject(nullptr);
  }
  Run(const Run&) = delete;
  void operator=(const Run&) = delete;

private:
  void Follow(vtkObject*, unsigned long, void*)
  {
    if (!this->GoesOn())
    {
      this->Filter->SetAbortExecute(1);
    }
  }

  vtkSurfaceVisibilityFilter* Filter;
  const std::function<bool()>& GoesOn;
  unsigned long Tag;
};

// This thread makes what others wait for, until it is gone.
class SharedTrace::Making
{
public:
  Making(SharedTrace& trace, std::unique_lock<std::mutex>& lock)
    : Trace(trace)
    , Lock(lock)
  {
    this->Trace.Maker = std::this_thread::get_id();
    this->Lock.unlock();
  }
  ~Making()
  {
    this->Lock.lock();
    this->Trace.Maker = std::thread::id();
    this->Trace.Changed.notify_all();
  }
  Making(const Making&) = delete;
  void operator=(const Making&) = delete;

private:
  SharedTrace& Trace;
  std::unique_lock<std::mutex>& Lock;
};

SharedTrace::SharedTrace() = default;

SharedTrace::~SharedTrace() = default;

std::shared_ptr<SharedTrace> SharedTrace::Find(vtkDataObject* input)
{
  const std::string content = GetContent(input);
  static std::mutex& mutex = *new std::mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  Traces& traces = GetTraces();
  for (auto it = traces.begin(); it != traces.end();)
  {
    it = it->second.expired() ? traces.erase(it) : std::next(it);
  }
  std::shared_ptr<SharedTrace> found = traces[content].lock();
  if (!found)
  {
    found = std::make_shared<SharedTrace>();
    traces[content] = found;
  }
  return found;
}

vtkSmartPointer<vtkDataObject> SharedTrace::Attach(
  vtkDataObject* input, bool withBounce, const std::function<bool()>& goesOn)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  if (this->Maker == std::this_thread::get_id())
  {
    // The filter's progress has led back to here: waiting would never end.
    lock.unlock();
    return SharedTrace().Attach(input, withBounce, goesOn);
  }
  while (this->Maker != std::thread::id())
  {
    if (!goesOn())
    {
      return nullptr;
    }
    this->Changed.wait_for(lock, Patience);
  }
  const bool any = !GetBlocks(input).empty();
  if (any && !this->Has(withBounce))
  {
    const Making making(*this, lock);
    this->Trace(input, withBounce, goesOn);
  }
  if (any && !this->Has(withBounce))
  {
    return nullptr;
  }
  std::size_t number = 0;
  return CopyBlocks(input,
    [this, &number](vtkPolyData* surface)
    {
      auto copy = ShallowCopy(surface);
      MoveArrays(this->Arrays[number++], copy);
      return copy;
    });
}

// Without the lock: whoever reads what is written here waits.
void SharedTrace::Trace(vtkDataObject* input, bool withBounce, const std::function<bool()>& goesOn)
{
  if (!this->Filter)
  {
    this->Filter = vtkSmartPointer<vtkSurfaceVisibilityFilter>::New();
    this->Filter->BothSidesOn(); // whichever way the normals point
  }
  vtkSmartPointer<vtkSurfaceVisibilityFilter> filter =
    std::move(this->Filter); // back if all goes well
  const Run run(filter, CopyBlocks(input, CopyGeometry), goesOn);
  filter->SetBounce(withBounce);
  const int before = filter->GetNumberOfTraces();
  const TakenError error(filter);
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
      MoveArrays(surface, this->Arrays.back());
    }
  }
  filter->GetOutputDataObject(0)->Initialize(); // the arrays are enough
  this->Filter = std::move(filter);
}
} // namespace measuredbrdf
