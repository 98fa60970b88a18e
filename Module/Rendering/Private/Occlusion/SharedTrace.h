// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What surfaces hide from themselves, traced once for all mappers that show them.
 */

#ifndef SharedTrace_h
#define SharedTrace_h

#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

class vtkPolyData;
class vtkSurfaceVisibilityFilter;

namespace measuredbrdf
{
/// What tells the points, point normals and cells of all polydata of an input from others.
std::string GetContentKey(vtkDataObject* input);

/// What rays meet and where they begin, in arrays that the copy shares; nothing else of the data.
vtkSmartPointer<vtkPolyData> CopyGeometry(vtkPolyData* surface);

/// Its arrays in place of those of another surface that may be there.
void CopyTraced(vtkPolyData* from, vtkPolyData* to);

/// vtkSurfaceVisibilityFilter's arrays, of both sides and without occluders, of surfaces of one
/// content. They stay for as long as anybody holds this.
class SharedTrace
{
public:
  SharedTrace();
  ~SharedTrace();
  SharedTrace(const SharedTrace&) = delete;
  void operator=(const SharedTrace&) = delete;

  /// The one of all surfaces with these points, point normals and cells: polydata, or composite
  /// data. Whatever thread asks, it is the same while somebody holds it.
  static std::shared_ptr<SharedTrace> Find(vtkDataObject* input);

  /// A shallow copy of such surfaces with the arrays. They are traced now where nobody has done it;
  /// where another thread does, this one waits. Null where goesOn has answered false meanwhile.
  vtkSmartPointer<vtkDataObject> Attach(
    vtkDataObject* input, bool withBounce, const std::function<bool()>& goesOn);

  /// How many times this was traced; a bounce that was added later counts again.
  int GetNumberOfTraces() const { return this->NumberOfTraces; }

private:
  bool Has(bool withBounce) const
  {
    return !this->Arrays.empty() && (!withBounce || this->HasBounce);
  }
  void Follow(vtkObject* filter, unsigned long event, void* data);
  void Trace(vtkDataObject* input, bool withBounce, const std::function<bool()>& goesOn);

  std::recursive_timed_mutex Mutex; // held by the thread that traces
  std::function<bool()> GoesOn;     // of the trace that runs now
  // Of each surface, without points: whoever has these may change them.
  std::vector<vtkSmartPointer<vtkPolyData>> Arrays;
  bool HasBounce = false;
  int NumberOfTraces = 0;
  vtkSmartPointer<vtkSurfaceVisibilityFilter> Filter; // knows the sky when a bounce is to follow
};
} // namespace measuredbrdf

#endif
