// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Collects an object's errors, or its warnings, instead of printing them.
 */

#ifndef ErrorCatcher_h
#define ErrorCatcher_h

#include "vtkCommand.h"
#include "vtkObject.h"

#include <string>
#include <utility>

class ErrorCatcher
{
public:
  explicit ErrorCatcher(vtkObject* object, unsigned long event = vtkCommand::ErrorEvent)
    : Object(object)
    , Tag(object->AddObserver(event, this, &ErrorCatcher::Catch))
  {
  }
  ~ErrorCatcher() { this->Object->RemoveObserver(this->Tag); }
  ErrorCatcher(const ErrorCatcher&) = delete;
  ErrorCatcher& operator=(const ErrorCatcher&) = delete;

  /// Events since the last call.
  int Take() { return std::exchange(this->Count, 0); }
  const std::string& GetText() const { return this->Text; }

private:
  void Catch(vtkObject*, unsigned long, void* text)
  {
    ++this->Count;
    this->Text = static_cast<const char*>(text);
  }

  vtkObject* Object;
  unsigned long Tag;
  int Count = 0;
  std::string Text;
};

#endif
