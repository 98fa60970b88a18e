// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a mapper says of its renders: each warning once, and each failure once until a render goes
 * without it.
 */

#ifndef RenderReports_h
#define RenderReports_h

#include "vtkMapper.h"

#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

class vtkActor;
class vtkRenderer;

namespace measuredbrdf
{
class RenderReports
{
public:
  /// owner: the mapper that users know, which warns and reports errors.
  explicit RenderReports(vtkMapper* owner)
    : Owner(owner)
  {
  }

  vtkMapper* GetOwner() const { return this->Owner; }

  /// Whether this is the first warning for that cause.
  bool WarnOnce(const std::string& cause) { return this->Warned.insert(cause).second; }

  /// Report at the end of this Render what can't be drawn as it should be.
  void AddFailure(const std::string& text) { this->Failures.insert(text); }

protected:
  void BeginReports() { this->Failures.clear(); }

  /// Report the failures of a Render that were not reported before. Those that this view was the
  /// last to have, and has no more, are forgotten. takesColor: whether the Render tried to draw
  /// with materials.
  void EndReports(vtkRenderer* renderer, vtkActor* actor, bool takesColor)
  {
    const std::pair<vtkRenderer*, vtkActor*> view(renderer, actor);
    for (const std::string& failure : this->Failures)
    {
      if (this->Said.insert_or_assign(failure, view).second)
      {
        vtkErrorWithObjectMacro(this->Owner, << failure);
      }
    }
    for (auto it = this->Said.begin(); it != this->Said.end() && takesColor;)
    {
      const bool isOver = it->second == view && this->Failures.count(it->first) == 0;
      it = isOver ? this->Said.erase(it) : std::next(it);
    }
  }

  vtkMapper* const Owner;

private:
  std::set<std::string> Warned;
  std::set<std::string> Failures;                                 // of this Render
  std::map<std::string, std::pair<vtkRenderer*, vtkActor*>> Said; // and whose Render had it last
};
} // namespace measuredbrdf

#endif
