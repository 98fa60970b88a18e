// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Materials, environments and images of weights by name or file. Each process of a parallel server
 * reads the file, as ParaView's own readers do.
 */

#ifndef MaterialFiles_h
#define MaterialFiles_h

#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkSmartPointer.h"

#include <string>

namespace measuredmaterials
{
/// The processes of a parallel server; null with one process. With more, what they draw must agree.
inline vtkMultiProcessController* GetController()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

/// What a name gives. Null without an error: there is none, or another process has the error.
template <typename T>
struct Found
{
  vtkSmartPointer<T> Object;
  std::string Error;
};

///@{
/**
 * The built-in object of that name, or else the file's. An empty name gives null. Objects in use
 * are shared: a name is read again only where its file has changed. With a controller of several
 * processes the call is collective. Then all processes have the object, of files of one length, or
 * none has it and the first one has the error.
 */
Found<vtkBRDF> FindMaterial(const std::string& name, vtkMultiProcessController* controller);
Found<vtkEnvironment> FindEnvironment(
  const std::string& name, vtkMultiProcessController* controller);
Found<vtkImageData> FindWeightImage(const std::string& path, vtkMultiProcessController* controller);
///@}
} // namespace measuredmaterials

#endif
