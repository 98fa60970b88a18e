// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef Ranks_h
#define Ranks_h

#include "vtkMultiProcessController.h"

namespace measuredmaterials
{
/// The processes of a parallel server; null with one process. With more, what they draw must agree.
inline vtkMultiProcessController* GetController()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}
} // namespace measuredmaterials

#endif
