// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Counts an object's events of one kind, and keeps the last one's text.
 */

#ifndef EventCounter_h
#define EventCounter_h

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <string>

struct EventCounter
{
  EventCounter(vtkObject* object, unsigned long event)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* text)
      {
        auto* counter = static_cast<EventCounter*>(self);
        ++counter->Count;
        counter->Text = text ? static_cast<const char*>(text) : "";
      });
    object->AddObserver(event, this->Command);
  }
  vtkNew<vtkCallbackCommand> Command;
  int Count = 0;
  std::string Text;
};

#endif
