// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Work that trusts a file, in a process of its own.
 */

#ifndef ReadApart_h
#define ReadApart_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>

namespace tool
{
/**
 * What read returns, made in a child process. A crash there is an Error here that names the file,
 * and Ctrl-C, or the stop of this thread's BackgroundWork, ends the child whatever it does. Errors
 * that read throws and notes that it prints pass through. Where there is no fork() (Windows), read
 * runs in this process.
 */
vtkSmartPointer<vtkPolyData> ReadApart(
  const std::string& path, const std::function<vtkSmartPointer<vtkPolyData>()>& read);
} // namespace tool

#endif
