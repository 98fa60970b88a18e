// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the tests of shading with hidden skies share.
 */

#ifndef OcclusionTools_h
#define OcclusionTools_h

#include "TraceSurface.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <string>
#include <vector>

// Small tables: their own errors cancel.
template <typename Integrator>
void MakeSmall(Integrator* integrator)
{
  integrator->SetNumberOfRows(17);
  integrator->SetNumberOfViewAngles(6);
  integrator->SetNumberOfAzimuths(4);
}

// Collects a mapper's warnings instead of printing them.
struct WarningTexts
{
  explicit WarningTexts(vtkObject* object)
    : Object(object)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* text)
      { static_cast<WarningTexts*>(self)->Texts.emplace_back(static_cast<const char*>(text)); });
    this->Tag = object->AddObserver(vtkCommand::WarningEvent, this->Command);
  }
  ~WarningTexts() { this->Object->RemoveObserver(this->Tag); }
  WarningTexts(const WarningTexts&) = delete;
  WarningTexts& operator=(const WarningTexts&) = delete;

  std::vector<std::string> Texts;

private:
  vtkNew<vtkCallbackCommand> Command;
  vtkObject* Object;
  unsigned long Tag;
};

#endif
