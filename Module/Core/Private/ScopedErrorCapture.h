// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An object's errors or warnings, taken off its hands: whoever uses it reports them.
 */

#ifndef ScopedErrorCapture_h
#define ScopedErrorCapture_h

#include "vtkCommand.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <string>

namespace measuredbrdf
{
class ScopedErrorCapture
{
public:
  explicit ScopedErrorCapture(vtkObject* source, unsigned long event = vtkCommand::ErrorEvent)
    : Source(source)
    , Tag(source->AddObserver(event, this, &ScopedErrorCapture::Take))
  {
  }
  ~ScopedErrorCapture() { this->Source->RemoveObserver(this->Tag); }
  ScopedErrorCapture(const ScopedErrorCapture&) = delete;
  void operator=(const ScopedErrorCapture&) = delete;

  /// The last one, without the place in the source and the function's name; "" if there was none.
  std::string GetText() const
  {
    // "ERROR: In FILE, line N\nCLASS (ADDRESS): FUNCTION: TEXT"
    std::size_t begin = 0;
    for (const char* end : { "): ", ": " })
    {
      const std::size_t found = this->Text.find(end, begin);
      begin = found == std::string::npos ? begin : found + std::string(end).size();
    }
    const std::size_t last = this->Text.find_last_not_of(" \n.");
    return last == std::string::npos || last < begin ? ""
                                                     : this->Text.substr(begin, last + 1 - begin);
  }

private:
  void Take(vtkObject*, unsigned long, void* text)
  {
    this->Text = text ? static_cast<const char*>(text) : "";
  }

  vtkSmartPointer<vtkObject> Source;
  unsigned long Tag;
  std::string Text;
};
} // namespace measuredbrdf

#endif
