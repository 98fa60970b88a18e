// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Collects an object's error events instead of printing them.
 */

#ifndef ErrorCatcher_h
#define ErrorCatcher_h

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <string>

class ErrorCatcher
{
public:
  explicit ErrorCatcher(vtkObject* object)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* text)
      {
        auto* catcher = static_cast<ErrorCatcher*>(self);
        ++catcher->Count;
        catcher->Text = static_cast<const char*>(text);
      });
    this->Object = object;
    this->Tag = object->AddObserver(vtkCommand::ErrorEvent, this->Command);
  }
  ~ErrorCatcher() { this->Object->RemoveObserver(this->Tag); }
  ErrorCatcher(const ErrorCatcher&) = delete;
  ErrorCatcher& operator=(const ErrorCatcher&) = delete;

  /// Events since the last call.
  int Take()
  {
    const int count = this->Count;
    this->Count = 0;
    return count;
  }
  const std::string& GetText() const { return this->Text; }

private:
  vtkNew<vtkCallbackCommand> Command;
  vtkObject* Object;
  unsigned long Tag = 0;
  int Count = 0;
  std::string Text;
};

#endif
